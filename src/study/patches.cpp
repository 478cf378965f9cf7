// SPDX-License-Identifier: MIT
#include "study/patches.hpp"

#include "base/random.hpp"
#include "base/stopwatch.hpp"
#include "image/colour.hpp"
#include "image/tone_map.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::study {
namespace {

constexpr int strip = 16; ///< rows of a picture that is looked at whole

Vec3 lab_of(Vec3 rgb) {
  return image::xyz_to_lab(
      image::linear_srgb_to_xyz(image::map_to_gamut(rgb, image::Gamut::Standard)));
}

} // namespace

Patches spread_patches(int width, int height, int count, int side, bool parts) {
  Patches out;
  double const area = static_cast<double>(width) * height;
  int const across = std::max(
      1, static_cast<int>(std::lround(std::sqrt(count * width / static_cast<double>(height)))));
  int const down = std::max(1, count / across);
  if ((area <= whole_pixels && !parts) || width < across * side || height < down * side) {
    for (int y = 0; y < height; y += strip)
      out.regions.push_back({0, y, width, std::min(y + strip, height)});
    out.pixels = area;
    return out;
  }
  for (int j = 0; j < down; ++j)
    for (int i = 0; i < across; ++i) {
      RandomKey const key = RandomKey(1).child(static_cast<std::uint64_t>(j * across + i));
      auto const place = [side](int cell, int cells, int size, double u) {
        double const lo = static_cast<double>(cell) * size / cells;
        double const room = static_cast<double>(size) / cells - side;
        return std::clamp(static_cast<int>(lo + u * room), 0, size - side);
      };
      int const x = place(i, across, width, key.uniform(0));
      int const y = place(j, down, height, key.uniform(1));
      out.regions.push_back({x, y, x + side, y + side});
      out.pixels += side * side;
    }
  return out;
}

Probe render_patches(scene::Scene const& scene, plan::Plan const& plan,
                     render::RenderOptions const& options, Patches const& patches) {
  Probe probe;
  Stopwatch const since;
  // A pixel more on each side where method 1 compares with neighbours.
  int const margin =
      options.anti_aliasing.method == 1 && options.anti_aliasing.threshold > 0 ? 1 : 0;
  std::vector<render::Region> wide;
  for (auto const& r : patches.regions)
    wide.push_back({std::max(0, r.x0 - margin), std::max(0, r.y0 - margin),
                    std::min(options.width, r.x1 + margin),
                    std::min(options.height, r.y1 + margin)});
  auto const results = render::render_regions(scene, plan, options, wide);
  double made = 0;
  for (std::size_t i = 0; i < results.size(); ++i) {
    auto const& r = patches.regions[i];
    auto const& picture = results[i].image;
    if (results[i].interrupted) return probe;
    probe.rays += results[i].counts.total();
    made += static_cast<double>(picture.pixels());
    for (int y = r.y0; y < r.y1; ++y)
      for (int x = r.x0; x < r.x1; ++x)
        probe.colours.push_back(image::pixel(
            picture,
            static_cast<std::size_t>((y - wide[i].y0) * picture.width + (x - wide[i].x0))));
  }
  probe.wall_s = since.wall_s();
  // Of the patches without their margins.
  probe.cpu_s = since.cpu_s() * patches.pixels / std::max(1.0, made);
  probe.rays = static_cast<std::uint64_t>(static_cast<double>(probe.rays) * patches.pixels
                                          / std::max(1.0, made));
  return probe;
}

double mean_delta_e(std::span<Vec3 const> reference, std::span<Vec3 const> test) {
  double sum = 0;
  for (std::size_t i = 0; i < reference.size(); ++i)
    sum += image::ciede2000(lab_of(reference[i]), lab_of(test[i]));
  return reference.empty() ? 0 : sum / static_cast<double>(reference.size());
}

} // namespace abbe::study
