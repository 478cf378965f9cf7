// SPDX-License-Identifier: MIT
#include "image/tone_map.hpp"

#include "image/colour.hpp"
#include "image/srgb8.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace abbe::image {
namespace {

Vec3 clip(Vec3 rgb) {
  return {std::clamp(rgb.x, 0.0, 1.0), std::clamp(rgb.y, 0.0, 1.0), std::clamp(rgb.z, 0.0, 1.0)};
}

/// Mixed with the grey of equal luminance until the smallest channel is 0.
Vec3 desaturate_to_positive(Vec3 rgb) {
  double const smallest = std::min({rgb.x, rgb.y, rgb.z});
  if (!(smallest < 0)) return rgb;
  double const y = luminance(rgb);
  if (!(y > 0)) return Vec3(0);
  double const saturation = y / (y - smallest);
  Vec3 const mixed = Vec3(y) + saturation * (rgb - Vec3(y));
  // Rounding may leave the smallest channel an ulp below zero.
  return {std::max(mixed.x, 0.0), std::max(mixed.y, 0.0), std::max(mixed.z, 0.0)};
}

} // namespace

Vec3 map_to_gamut(Vec3 rgb, Gamut gamut) {
  if (glm::all(glm::lessThanEqual(Vec3(0), rgb)) && glm::all(glm::lessThanEqual(rgb, Vec3(1))))
    return rgb;
  if (std::isnan(rgb.x) || std::isnan(rgb.y) || std::isnan(rgb.z)) return Vec3(0);
  // An infinity would turn into NaN in the mixtures below.
  constexpr double largest = std::numeric_limits<float>::max();
  rgb = {std::clamp(rgb.x, -largest, largest), std::clamp(rgb.y, -largest, largest),
         std::clamp(rgb.z, -largest, largest)};
  if (gamut == Gamut::Clip) return clip(rgb);
  rgb = desaturate_to_positive(rgb);
  if (gamut == Gamut::Hue) {
    double const top = std::max({rgb.x, rgb.y, rgb.z});
    if (top > 1) rgb = rgb / top;
  }
  return clip(rgb);
}

double automatic_exposure_ev(Image const& image) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    double const y = luminance(pixel(image, i));
    if (!(y > 0) || std::isinf(y)) continue;
    sum += std::log2(y);
    ++count;
  }
  if (count == 0) return 0;
  return std::log2(0.18) - sum / static_cast<double>(count);
}

Image tone_map(Image const& image, ToneOptions const& options, ToneReport* report) {
  ToneReport counts;
  counts.exposure_ev = options.exposure_ev;
  if (options.auto_exposure) counts.exposure_ev += automatic_exposure_ev(image);
  double const factor = std::exp2(counts.exposure_ev);

  Image display;
  display.width = image.width;
  display.height = image.height;
  display.alpha = image.alpha;
  display.metadata = image.metadata;
  display.rgb.resize(image.rgb.size());
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    Vec3 const rgb = factor * pixel(image, i);
    counts.not_a_number += std::isnan(rgb.x) || std::isnan(rgb.y) || std::isnan(rgb.z);
    counts.negative += rgb.x < 0 || rgb.y < 0 || rgb.z < 0;
    counts.over_range += rgb.x > 1 || rgb.y > 1 || rgb.z > 1;
    set_pixel(display, i, map_to_gamut(rgb, options.gamut));
  }
  if (report) *report = counts;
  return display;
}

std::vector<std::uint8_t> encode_srgb8(Image const& display) {
  std::vector<std::uint8_t> codes(display.rgb.size());
  Srgb8 const& srgb = Srgb8::instance();
  std::transform(display.rgb.begin(), display.rgb.end(), codes.begin(),
                 [&](float value) { return srgb.code(value); });
  return codes;
}

} // namespace abbe::image
