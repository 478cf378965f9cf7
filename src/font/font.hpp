// SPDX-License-Identifier: MIT
#pragma once

#include "base/result.hpp"
#include "base/vec.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace abbe::font {

/// A straight line (2 points) or a Bezier curve of degree two or three (3 or 4 points), in units of
/// the font.
using Segment = std::vector<Vec2>;
/// Closed: each segment begins where the one before it ends, the first where the last ends.
using Contour = std::vector<Segment>;

/// A font file in memory.
class Font {
public:
  /// @param bytes of a TrueType or OpenType file
  /// @param name for messages
  /// @error E0518 no font, damaged, or without outlines
  static Result<std::shared_ptr<Font const>> open(std::string bytes, std::string const& name);
  ~Font();
  Font(Font const&) = delete;
  Font& operator=(Font const&) = delete;

  /// How many units the size of the font is.
  double units_per_em() const;
  /// Number of the glyph that shows a character; 0, the glyph for none, where there is none. Fonts
  /// with their own order of symbols have these at the codes from 0xf000 on, too.
  std::uint32_t glyph(char32_t character) const;
  /// Empty where the glyph is blank or damaged.
  std::vector<Contour> outline(std::uint32_t glyph) const;
  /// How far the next character is, without kerning; 0 when damaged.
  double advance(std::uint32_t glyph) const;
  /// How far to the right of its place a glyph begins; 0 when damaged.
  double left_bearing(std::uint32_t glyph) const;
  /// The distance by which the table `kern` moves the second of two neighbours.
  double kerning(std::uint32_t left, std::uint32_t right) const;

private:
  struct Impl;
  explicit Font(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

} // namespace abbe::font
