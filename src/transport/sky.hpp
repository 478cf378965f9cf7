// SPDX-License-Identifier: MIT
#pragma once

#include "base/arena.hpp"
#include "transport/stage.hpp"

namespace abbe::transport {

/// Is there light where nothing is met?
bool has_sky(Stage const& stage);
/// Light of the background and the sky sphere in a direction, for lanes of some channels.
/// @param out a value a lane
void find_sky(Stage const& stage, Arena& arena, Vec3 const& direction,
              std::uint16_t const* channels, std::size_t lanes, double* out);

} // namespace abbe::transport
