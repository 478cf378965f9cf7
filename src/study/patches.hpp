// SPDX-License-Identifier: MIT
#pragma once

#include "render/render.hpp"

#include <span>
#include <vector>

namespace abbe::study {

/// Parts of a picture that stand for all of it.
struct Patches {
  std::vector<render::Region> regions; ///< that are looked at
  double pixels = 0;                   ///< in all
};
/// Pixels of a picture that is looked at whole.
inline constexpr int whole_pixels = 10000;
inline constexpr int patch_count = 128;
inline constexpr int patch_side = 8;
/// Squares, one in each cell of an even grid, somewhere in it (the same each time).
/// @param count about so many; the whole of a small picture, unless `parts` are wanted of it too
/// @param side of a square, pixels
Patches spread_patches(int width, int height, int count = patch_count, int side = patch_side,
                       bool parts = false);

struct Probe {
  std::vector<Vec3> colours; ///< linear sRGB, of all pixels of the patches
  std::uint64_t rays = 0;
  double cpu_s = 0, wall_s = 0;
};
/// Renders the patches as they are in the whole picture: anti-aliasing sees their neighbours.
Probe render_patches(scene::Scene const& scene, plan::Plan const& plan,
                     render::RenderOptions const& options, Patches const& patches);

/// Mean CIEDE2000 of the colours as displayed. @pre equally many
double mean_delta_e(std::span<Vec3 const> reference, std::span<Vec3 const> test);

} // namespace abbe::study
