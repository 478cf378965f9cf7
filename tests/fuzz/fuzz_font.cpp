// SPDX-License-Identifier: MIT
// Any bytes as a font. What is accepted must give outlines that are closed, and a shape of them
// that lines can be asked of.
#include "font/font.hpp"
#include "geometry/shapes/spline_prism.hpp"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace font = abbe::font;
namespace geometry = abbe::geometry;
using abbe::Vec3;

namespace {

void require(bool condition, char const* what) {
  if (condition) return;
  std::fprintf(stderr, "fuzz_font: %s\n", what);
  std::abort();
}

void ask(font::Font const& font, std::uint32_t glyph) {
  require(std::isfinite(font.advance(glyph)) && std::isfinite(font.left_bearing(glyph))
              && std::isfinite(font.kerning(glyph, glyph + 1)),
          "a measure that is no number");
  std::vector<geometry::Outline> outlines;
  for (font::Contour const& contour : font.outline(glyph)) {
    require(!contour.empty() && contour.front().front() == contour.back().back(),
            "an outline that is not closed");
    geometry::Outline& outline = outlines.emplace_back();
    for (font::Segment const& segment : contour) outline.push_back(geometry::bezier_piece(segment));
  }
  auto const shape =
      geometry::make_spline_prism(std::move(outlines), geometry::SplinePrism::Sweep::Linear, 0, 1,
                                  false, geometry::SplinePrism::Fill::NonZero);
  if (!shape) return;
  geometry::Ray ray;
  for (Vec3 const& direction : {Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(.3, .1, 1)}) {
    ray.direction = direction;
    geometry::Crossings crossings;
    shape->shape->crossings(ray, nullptr, crossings);
    require(crossings.size() % 2 == 0, "a line that enters and does not leave");
    for (geometry::Crossing const& c : crossings)
      require(std::isfinite(c.t), "a crossing that is nowhere");
  }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  std::string bytes(reinterpret_cast<char const*>(data), size);
  auto const font = abbe::font::Font::open(std::move(bytes), "mutant");
  if (!font) return 0;
  require((*font)->units_per_em() > 0, "a font without a size");
  for (char32_t const character : {U'A', U'V', U'l', U'\u00e4', U'\U0010ffff'})
    ask(**font, (*font)->glyph(character));
  return 0;
}
