// SPDX-License-Identifier: MIT
// `height_field { png "file" ... }` and `height_field { function w, h { ... } ... }`.
#include "geometry/shapes/height_field.hpp"
#include "image/colour.hpp"
#include "image/texels.hpp"
#include "lang/blocks.hpp"
#include "lang/file_shapes.hpp"
#include "lang/function.hpp"
#include "lang/load_file.hpp"
#include "simd/math.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::lang {

namespace {

using geometry::HeightGrid;
using image::Texels;

constexpr std::string_view type_words[] = {"png", "gif", "tga", "jpeg", "tiff", "iff", "ppm",
                                           "pgm", "pot", "sys", "exr",  "hdr",  "bmp"};

/// What a file's pixels are made of, which decides how they become heights.
enum class Kind {
  Grey8,   ///< PNG's grey of up to 8 bits, of which fractions are dropped
  Fine,    ///< grey, or the grey of colours, in 16 bits
  HighLow, ///< colours: red is the high byte, green the low one
  Palette, ///< the number of the entry is the high byte
  Halves   ///< POT: the left half has the high bytes, the right one the low ones
};

Kind kind_of(std::string_view bytes, Texels const& texels, bool pot) {
  auto const byte = [&](std::size_t k) {
    return k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0U;
  };
  if (pot && !texels.index.empty()) return Kind::Halves;
  if (!texels.index.empty()) return Kind::Palette;
  if (bytes.starts_with("\x89PNG")) {
    unsigned const depth = byte(24), colour = byte(25);
    if (colour == 0) return depth <= 8 ? Kind::Grey8 : Kind::Fine;
    return (colour & 2U) != 0 && depth <= 8 ? Kind::HighLow : Kind::Fine;
  }
  if (bytes.starts_with("P6") || bytes.starts_with("P3")) {
    bool const fine = std::any_of(texels.rgba.begin(), texels.rgba.end(), [](float code) {
      float const scaled = code * 255;
      return std::fabs(scaled - std::round(scaled)) > 1e-4F;
    });
    return fine ? Kind::Fine : Kind::HighLow;
  }
  return Kind::HighLow; // of greys the same as Fine
}

/// POV-Ray's grey, in single precision as there: what it cuts off depends on it.
float grey_of(float r, float g, float b) {
  return 0.297F * r + 0.589F * g + 0.114F * b;
}

/// A number of 16 bits as POV-Ray cuts one: fractions are dropped, and what is above begins anew.
std::uint16_t sixteen_bits(double value) {
  if (!std::isfinite(value)) return 0;
  double const whole = std::fmod(std::trunc(value), 65536.0);
  return static_cast<std::uint16_t>(whole < 0 ? whole + 65536 : whole);
}

/// @param gamma power that decodes the codes, 1: none, below 0: sRGB
std::optional<HeightGrid> grid_of(Texels const& texels, Kind kind, double gamma) {
  bool const halves = kind == Kind::Halves;
  HeightGrid grid;
  grid.columns = halves ? texels.width / 2 : texels.width;
  grid.rows = texels.height;
  if (grid.columns < 2 || grid.rows < 2) return std::nullopt;
  auto const light = [&](float code) {
    if (gamma == 1) return code;
    auto const c = static_cast<double>(code);
    return static_cast<float>(gamma < 0 ? image::srgb_decode(c) : simd::pow(c, gamma));
  };
  for (int row = grid.rows - 1; row >= 0; --row) {
    for (int i = 0; i < grid.columns; ++i) {
      auto const at = static_cast<std::size_t>(row) * static_cast<std::size_t>(texels.width)
                      + static_cast<std::size_t>(i);
      double height = 0;
      if (kind == Kind::Palette || halves) {
        height = 256.0 * texels.index[at];
        if (halves) height += texels.index[at + static_cast<std::size_t>(grid.columns)];
      } else {
        float const* const code = &texels.rgba[4 * at];
        float const r = light(code[0]), g = light(code[1]), b = light(code[2]);
        // What single precision takes from a whole number is given back.
        constexpr double little = 0.01;
        if (kind == Kind::HighLow)
          height = (static_cast<double>(r) * 256 + static_cast<double>(g)) * 255 + little;
        else if (kind == Kind::Grey8)
          height = 257 * std::floor(static_cast<double>(grey_of(r, g, b) * 255.0F));
        else
          height = static_cast<double>(grey_of(r, g, b)) * 65535 + little;
        height = std::clamp(height, 0.0, 65535.0);
      }
      grid.heights.push_back(sixteen_bits(height));
    }
  }
  return grid;
}

std::optional<HeightGrid> read_picture(Reader& in) {
  bool pot = false;
  std::string_view kind;
  for (std::string_view const word : type_words) {
    if (!in.accept(word)) continue;
    kind = word;
    pot = word == "pot";
    break;
  }
  Span const at = in.next_span();
  std::string const name = in.path("the file of a picture");
  double gamma = 1;
  while (!in.at_end()) {
    if (in.accept("gamma")) {
      if (in.accept("srgb")) {
        gamma = -1;
        continue;
      }
      Span const place = in.next_span();
      gamma = in.number("gamma");
      if (gamma > 0) continue;
      in.report(Severity::Error, "E0353", "gamma must be positive", place);
      gamma = 1;
    } else if (in.accept("premultiplied")) {
      in.boolean_or(true);
    } else {
      break;
    }
  }
  if (name.empty()) return std::nullopt; // reported
  auto const bytes = load_picture(in.interpreter(), name, kind);
  if (!bytes) {
    in.report(Severity::Error, bytes.error().code, bytes.error().message, at);
    return std::nullopt;
  }
  auto const texels = image::read_texels(*bytes, name);
  if (!texels) {
    in.report(Severity::Error, texels.error().code, texels.error().message, at);
    return std::nullopt;
  }
  auto grid = grid_of(*texels, kind_of(*bytes, *texels, pot), gamma);
  if (!grid)
    in.report(Severity::Error, "E0634",
              "a height_field needs a picture of two or more rows and columns", at);
  return grid;
}

/// `function w, h { ... }`: its values at x and y from 0 to 1, the first row, at y = 0, being that
/// of z = 1.
std::optional<HeightGrid> read_function(Reader& in) {
  Span const at = in.next_span();
  auto const function = std::get<std::shared_ptr<FunctionValue>>(in.identifier()->any);
  in.take();
  if (!function->unsupported.empty()) {
    in.report(Severity::Error, "E0901", function->unsupported, at);
    return std::nullopt;
  }
  HeightGrid grid;
  grid.columns = function->picture_width;
  grid.rows = function->picture_height;
  if (grid.columns == 0 || function->parameters != 3) {
    in.report(Severity::Error, "E0622",
              "a height_field of a function needs its size, and x, y and z as its arguments: "
              "'function 100, 80 { ... }'",
              at);
    return std::nullopt;
  }
  if (grid.columns < 2 || grid.rows < 2) {
    in.report(Severity::Error, "E0634", "a height_field needs two or more rows and columns", at);
    return std::nullopt;
  }
  for (int row = grid.rows - 1; row >= 0; --row) {
    for (int i = 0; i < grid.columns; ++i) {
      double const place[] = {i / (grid.columns - 1.0), row / (grid.rows - 1.0), 0};
      Numeric const value = evaluate_function(*function, place);
      auto const part = [&](std::size_t k) { return static_cast<float>(value.c[k]); };
      double const height =
          function->vector ? static_cast<double>(grey_of(part(0), part(1), part(2))) : value.c[0];
      grid.heights.push_back(sixteen_bits(height * 65535));
    }
  }
  return grid;
}

bool starts_function(Reader& in) {
  Value const* const value = in.identifier();
  return value && std::holds_alternative<std::shared_ptr<FunctionValue>>(value->any);
}

} // namespace

/** @scene height_field { [KIND] "FILE" [gamma g] | function w, h { ... } [smooth] [water_level f] }
 * A surface over the unit square of x and z whose heights, 0 to 1 along y, are those of a picture
 * or a function; inside is below it, down to the water level. */
scene::Object read_height_field(Reader& in) {
  scene::Object object;
  object.kind = scene::Object::Kind::Union;
  object.span = in.block_span();
  auto grid = starts_function(in) ? read_function(in) : read_picture(in);
  bool smooth = false;
  double water = 0;
  for (;;) {
    if (auto const flag = in.flag("smooth"))
      smooth = *flag;
    else if (in.accept("water_level"))
      water = in.number("water level");
    else if (!in.flag("hierarchy"))
      break;
  }
  if (!grid) return object; // reported
  auto shape = geometry::make_height_field(std::move(*grid), smooth, water);
  if (!shape) {
    in.report(Severity::Warning, "E0634",
              "nothing of this height_field is above its water level: it is not drawn",
              object.span);
    return object;
  }
  object.kind = scene::Object::Kind::Shape;
  object.keyword = "height_field";
  object.shape = std::move(shape->shape);
  object.placement = shape->placement;
  return object;
}

} // namespace abbe::lang
