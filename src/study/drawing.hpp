// SPDX-License-Identifier: MIT
#pragma once

#include "base/vec.hpp"

#include <string>
#include <vector>

namespace abbe::study {

/// A drawing of lines and words as SVG: x to the right, y down, both in pixels.
class Drawing {
public:
  Drawing(double width, double height) : width_(width), height_(height) {}

  /// @param colour "#rrggbb" or a word of CSS
  void line(std::vector<Vec2> const& points, std::string const& colour, double width = 1.5,
            double opacity = 1);
  void polygon(std::vector<Vec2> const& points, std::string const& fill, std::string const& line);
  enum class Anchor { Start, Middle, End };
  void text(Vec2 at, std::string const& words, Anchor anchor = Anchor::Start, double size = 13,
            std::string const& colour = "#222222");
  std::string svg() const;

private:
  double width_, height_;
  std::string body_;
};

/// Straight axes, linear both ways, with ticks, in a frame of a drawing.
class Axes {
public:
  struct Range {
    double lo, hi, step;
    int decimals;
  };
  Axes(Drawing& drawing, Vec2 corner, Vec2 size, Range x, Range y);
  Vec2 place(double x, double y) const;
  void titles(std::string const& x, std::string const& y);

private:
  Drawing& drawing_;
  Vec2 corner_, size_;
  Range x_, y_;
};

/// A colour of linear sRGB as "#rrggbb", mixed with grey of its luminance where it is outside.
std::string css_colour(Vec3 linear_rgb);

} // namespace abbe::study
