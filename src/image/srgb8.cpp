// SPDX-License-Identifier: MIT
#include "image/srgb8.hpp"

#include "image/colour.hpp"

#include <cmath>
#include <limits>

namespace abbe::image {

namespace {

double exact(float light) {
  return std::floor(255 * srgb_encode(light) + 0.5);
}

} // namespace

Srgb8::Srgb8() {
  constexpr float far = std::numeric_limits<float>::infinity();
  first_.front() = 0;
  first_.back() = far;
  for (int code = 1; code < 256; ++code) {
    auto light = static_cast<float>(srgb_decode((code - 0.5) / 255));
    while (exact(light) < code) light = std::nextafter(light, far);
    while (exact(std::nextafter(light, -far)) >= code) light = std::nextafter(light, -far);
    first_[static_cast<std::size_t>(code)] = light;
  }
  for (int cell = 0; cell <= cells; ++cell)
    start_[static_cast<std::size_t>(cell)] =
        static_cast<std::uint8_t>(exact(static_cast<float>(cell) / cells));
}

Srgb8 const& Srgb8::instance() {
  static Srgb8 const table;
  return table;
}

} // namespace abbe::image
