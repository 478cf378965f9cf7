// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/bounds.hpp"

#include <vector>

namespace abbe::geometry {

/// The box around what half-spaces have in common; infinite where that is, or where there are too
/// many of them to tell in a short time.
/// @param all of unit normals
Bounds bounds_of(std::vector<HalfSpace> const& all);

} // namespace abbe::geometry
