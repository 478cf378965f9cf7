// SPDX-License-Identifier: MIT
#include "study/drawing.hpp"

#include "image/colour.hpp"
#include "image/tone_map.hpp"

#include <cmath>
#include <fmt/format.h>

namespace abbe::study {
namespace {

std::string points_of(std::vector<Vec2> const& points) {
  std::string out;
  for (auto const& p : points) out += fmt::format("{:.2f},{:.2f} ", p.x, p.y);
  return out;
}

std::string escaped(std::string const& words) {
  std::string out;
  for (char const c : words) out += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  return out;
}

} // namespace

void Drawing::line(std::vector<Vec2> const& points, std::string const& colour, double width,
                   double opacity) {
  body_ += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" "
                       "stroke-opacity=\"{}\" stroke-linejoin=\"round\"/>\n",
                       points_of(points), colour, width, opacity);
}

void Drawing::polygon(std::vector<Vec2> const& points, std::string const& fill,
                      std::string const& line) {
  body_ += fmt::format("<polygon points=\"{}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"1.2\"/>\n",
                       points_of(points), fill, line);
}

void Drawing::text(Vec2 at, std::string const& words, Anchor anchor, double size,
                   std::string const& colour) {
  char const* const anchors[] = {"start", "middle", "end"};
  body_ += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"{}\" font-size=\"{}\" "
                       "fill=\"{}\">{}</text>\n",
                       at.x, at.y, anchors[static_cast<int>(anchor)], size, colour, escaped(words));
}

std::string Drawing::svg() const {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" width=\"{0:g}\" "
      "height=\"{1:g}\" font-family=\"Helvetica, Arial, 'DejaVu Sans', sans-serif\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n{2}</svg>\n",
      width_, height_, body_);
}

Axes::Axes(Drawing& drawing, Vec2 corner, Vec2 size, Range x, Range y)
    : drawing_(drawing), corner_(corner), size_(size), x_(x), y_(y) {
  auto const steps = [](Range const& r) {
    return static_cast<int>(std::floor((r.hi - r.lo) / r.step + 0.5));
  };
  for (int i = 0; i <= steps(x); ++i) {
    double const value = x.lo + i * x.step;
    drawing_.line({place(value, y.lo), place(value, y.hi)}, "#e4e4e4", 1);
    drawing_.text(place(value, y.lo) + Vec2(0, 18), fmt::format("{:.{}f}", value, x.decimals),
                  Drawing::Anchor::Middle, 12, "#555555");
  }
  for (int i = 0; i <= steps(y); ++i) {
    double const value = y.lo + i * y.step;
    drawing_.line({place(x.lo, value), place(x.hi, value)}, "#e4e4e4", 1);
    drawing_.text(place(x.lo, value) + Vec2(-8, 4), fmt::format("{:.{}f}", value, y.decimals),
                  Drawing::Anchor::End, 12, "#555555");
  }
}

Vec2 Axes::place(double x, double y) const {
  return corner_
         + Vec2((x - x_.lo) / (x_.hi - x_.lo) * size_.x, (y_.hi - y) / (y_.hi - y_.lo) * size_.y);
}

void Axes::titles(std::string const& x, std::string const& y) {
  drawing_.text(corner_ + Vec2(size_.x / 2, size_.y + 40), x, Drawing::Anchor::Middle);
  drawing_.text(corner_ + Vec2(-40, -14), y);
}

std::string css_colour(Vec3 linear_rgb) {
  Vec3 const shown = image::map_to_gamut(linear_rgb, image::Gamut::Hue);
  auto const code = [](double v) {
    return static_cast<int>(std::lround(255 * image::srgb_encode(v)));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", code(shown.x), code(shown.y), code(shown.z));
}

} // namespace abbe::study
