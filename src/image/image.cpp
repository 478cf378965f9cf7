// SPDX-License-Identifier: MIT
#include "image/image.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <functional>

namespace abbe::image {
namespace {

Error malformed(std::string message) {
  return Error{"E0515", "the image does not fit together: " + std::move(message)};
}

} // namespace

Image make_image(int width, int height) {
  ABBE_ASSERT(width > 0 && height > 0);
  Image image;
  image.width = width;
  image.height = height;
  image.rgb.assign(image.pixels() * 3, 0.0F);
  return image;
}

Status validate(Image const& image) {
  if (image.width <= 0 || image.height <= 0)
    return malformed(fmt::format("its size is {} x {}", image.width, image.height));
  if (std::int64_t{image.width} * image.height > max_pixels)
    return malformed(fmt::format("{} x {} pixels are more than 2^31", image.width, image.height));
  std::size_t const n = image.pixels();
  std::size_t const n_bands = image.band_centres_nm.size();
  if (image.rgb.size() != 3 * n)
    return malformed(fmt::format("{} colour values for {} pixels", image.rgb.size(), n));
  if (!image.alpha.empty() && image.alpha.size() != n)
    return malformed(fmt::format("{} alpha values for {} pixels", image.alpha.size(), n));
  if (!image.bands.empty() && (n_bands == 0 || image.bands.size() != n_bands * n))
    return malformed(
        fmt::format("{} band values for {} pixels of {} bands", image.bands.size(), n, n_bands));
  auto const not_ascending = [](std::vector<double> const& values) {
    return std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) != values.end();
  };
  if (not_ascending(image.band_centres_nm) || not_ascending(image.band_edges_nm))
    return malformed("its wavelengths do not ascend");
  if (!image.band_edges_nm.empty() && image.band_edges_nm.size() != n_bands + 1)
    return malformed(
        fmt::format("{} band edges for {} bands", image.band_edges_nm.size(), n_bands));
  return std::monostate{};
}

} // namespace abbe::image
