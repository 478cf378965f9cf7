// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

namespace abbe::image {

/// Light to 8-bit sRGB codes without a power for each value.
///
/// The codes are those of floor (255 srgb_encode (v) + 0.5), bit for bit: the 255 places where that
/// steps up are found among the floats, with it, once.
class Srgb8 {
public:
  /// Made on the first call.
  static Srgb8 const& instance();
  /// @param light linear; below 0 and not a number count as 0, above 1 as 1
  std::uint8_t code(float light) const {
    if (!(light > 0)) return 0;
    if (light >= 1) return 255;
    unsigned code = start_[static_cast<std::size_t>(light * cells)];
    while (light >= first_[code + 1]) ++code;
    return static_cast<std::uint8_t>(code);
  }

private:
  Srgb8();
  static constexpr int cells = 4096;
  std::array<float, 257> first_;              ///< by code: the least light that has it
  std::array<std::uint8_t, cells + 1> start_; ///< code at the beginning of each cell
};

} // namespace abbe::image
