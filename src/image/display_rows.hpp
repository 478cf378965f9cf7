// SPDX-License-Identifier: MIT
#pragma once

#include "image/io.hpp"
#include "image/srgb8.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace abbe::image {

/// The rows of a display-referred picture as codes, one row at a time: red, green, blue (and alpha)
/// of each pixel, 8 bits, or 16 with the high byte first. Colours are not multiplied by alpha, as
/// file formats want them.
class DisplayRows {
public:
  /// @param display as tone_map() gives it; it has to stay
  DisplayRows(Image const& display, DisplayOptions const& options);
  int channels() const { return channels_; }
  /// The codes of row y, valid until the next call.
  std::span<std::uint8_t> row(int y);

private:
  double encode(double light) const;
  std::uint8_t* put(std::uint8_t* out, double value) const;
  Image const& display_;
  Srgb8 const& srgb8_ = Srgb8::instance();
  int bytes_;
  double full_, gamma_;
  int channels_;
  std::vector<std::uint8_t> row_;
};

} // namespace abbe::image
