// SPDX-License-Identifier: MIT
#include "image/display_rows.hpp"

#include "image/colour.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::image {
namespace {

double coverage(float alpha) {
  return alpha > 0 ? std::min<double>(alpha, 1) : 0;
}

} // namespace

DisplayRows::DisplayRows(Image const& display, DisplayOptions const& options)
    : display_(display),
      bytes_(options.bits / 8),
      full_((1 << options.bits) - 1),
      gamma_(options.gamma),
      channels_(display.alpha.empty() ? 3 : 4),
      row_(static_cast<std::size_t>(display.width) * static_cast<std::size_t>(channels_ * bytes_)) {
}

std::span<std::uint8_t> DisplayRows::row(int y) {
  std::uint8_t* out = row_.data();
  auto const width = static_cast<std::size_t>(display_.width);
  std::size_t const first = static_cast<std::size_t>(y) * width;
  if (bytes_ == 1 && channels_ == 3 && gamma_ <= 0) {
    float const* const light = display_.rgb.data() + 3 * first;
    for (std::size_t i = 0; i < 3 * width; ++i) *out++ = srgb8_.code(light[i]);
    return row_;
  }
  for (std::size_t i = first; i < first + width; ++i) {
    double const alpha = display_.alpha.empty() ? 1 : coverage(display_.alpha[i]);
    for (std::size_t c = 0; c < 3; ++c) {
      double const light = display_.rgb[3 * i + c];
      out = put(out, encode(alpha > 0 ? std::min(light / alpha, 1.0) : 0));
    }
    if (channels_ == 4) out = put(out, alpha);
  }
  return row_;
}

double DisplayRows::encode(double light) const {
  return gamma_ > 0 ? std::pow(std::max(light, 0.0), 1 / gamma_) : srgb_encode(light);
}

std::uint8_t* DisplayRows::put(std::uint8_t* out, double value) const {
  auto const code = static_cast<unsigned>(std::floor(full_ * value + 0.5));
  if (bytes_ == 2) *out++ = static_cast<std::uint8_t>(code >> 8);
  *out++ = static_cast<std::uint8_t>(code & 0xff);
  return out;
}

} // namespace abbe::image
