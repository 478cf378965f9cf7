// SPDX-License-Identifier: MIT
#pragma once

#include "plan/working_space.hpp"
#include "render/compile.hpp"
#include "render/render.hpp"

namespace abbe::render {

/// Pixels of a tile, which one thread makes.
struct TileSize {
  int across = 0, down = 0;
};
/// Pixels across and down a tile where there are many.
inline constexpr int usual_tile = 32;
/// RenderOptions::tile_size, or what suits the size of the picture (its region), whatever the
/// number of threads: checkpoints know tiles by their numbers.
TileSize tile_size(RenderOptions const& options);

/// One picture of a scene that was made ready, as RenderOptions say but for their passes.
/// @param space of the channels when they are r g b
/// @param linear false: their numbers stay as they are
/// @param pass which of them it is, for the checkpoint
RenderResult make_frame(Stage const& stage, RenderOptions const& options,
                        plan::WorkingSpace const& space, bool linear = true, int pass = 0);

/// Of pictures that were left in the numbers of the scene. @param space of r g b
void make_linear(image::Image& rows, Stage const& stage, plan::WorkingSpace const& space);

} // namespace abbe::render
