// SPDX-License-Identifier: MIT
#pragma once

#include "transport/interface.hpp"
#include "transport/shader.hpp"

namespace abbe::transport {

/// What becomes of light at a surface, a value a lane.
struct Shares {
  double *back = nullptr, *on = nullptr;
  SplitLanes ways;                   ///< of lanes that split
  RaySet returning = 0, passing = 0; ///< rays that may; of others nothing is written
};

/// Clear, wherever the rays of a chunk are on it?
bool is_bare(Stage const& stage, Chunk const& chunk);
/// What of the chunk's light comes back from its surface and what goes on behind it.
/// @param fresnel it is of a real dielectric, which reflects unasked
/// @param splits lanes go by Shares::ways; else rays by what refract_rays() left
/// @param surface null: clear
void find_shares(Arena& arena, Chunk const& chunk, bool fresnel, bool splits,
                 SurfaceLight const* surface, Shares& shares);

} // namespace abbe::transport
