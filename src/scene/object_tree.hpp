// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/world.hpp"
#include "scene/scene.hpp"

#include <optional>

namespace abbe::scene {

/// An object as geometry alone: one solid, which a ray of any mask meets.
/// @param outer the space that the object stands in -> the space of the world
/// @return nullopt: it has no shapes
std::optional<geometry::World> world_of(Object const& object,
                                        geometry::Transform const& outer = {});

} // namespace abbe::scene
