// SPDX-License-Identifier: MIT
// `text { ttf "file" "string" thickness, offset }`: a union of glyphs.
#include "font/font.hpp"
#include "geometry/shapes/blank.hpp"
#include "geometry/shapes/reading.hpp"
#include "geometry/shapes/spline_prism.hpp"
#include "lang/blocks.hpp"
#include "lang/file_shapes.hpp"
#include "lang/load_file.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <utility>

namespace abbe::lang {

/// The fonts that a scene has named, each read once, and the glyphs made of them so far.
class Fonts {
public:
  struct Loaded {
    std::shared_ptr<font::Font const> font;
    /// By number and whether it is flat; in units of the font, from z = 0 to 1, y downwards.
    std::map<std::pair<std::uint32_t, bool>, std::optional<geometry::PlacedShape>> glyphs;
  };
  using Key = std::pair<SourceFile const*, std::string>;
  std::map<Key, std::shared_ptr<Loaded>> by_name;
};

namespace {

using geometry::Transform;

/// What stands for a font that is not there. Free, part of abbe.
constexpr std::string_view packaged = "fonts/abbe-sans.ttf";
/// POV-Ray's own fonts, by the number behind `internal`; any other number is 0.
constexpr std::string_view internal_fonts[] = {"povlogo.ttf", "timrom.ttf", "cyrvetic.ttf",
                                               "crystal.ttf"};

std::shared_ptr<font::Font const> open_font(Reader& in, std::string const& name, Span at) {
  auto bytes = load_file(in.interpreter(), name, {".ttf", ".otf"});
  if (!bytes && bytes.error().message.starts_with("cannot find")) {
    in.report(Severity::Warning, "E0519",
              fmt::format("{}: abbe's own '{}' stands for it", bytes.error().message, packaged),
              at);
    std::filesystem::path const own = std::filesystem::absolute(stdlib_dir(in.interpreter()));
    bytes = load_file(in.interpreter(), (own / packaged).string());
  }
  if (!bytes) {
    in.report(Severity::Error, bytes.error().code, bytes.error().message, at);
    return nullptr;
  }
  auto font = font::Font::open(std::move(*bytes), name);
  if (font) return std::move(*font);
  in.report(Severity::Error, font.error().code, font.error().message, at);
  return nullptr;
}

std::shared_ptr<Fonts::Loaded> find_font(Reader& in, std::string const& name, Span at) {
  auto& fonts = scene_state(in.interpreter()).fonts;
  if (!fonts) fonts = std::make_shared<Fonts>();
  auto const [place, added] = fonts->by_name.try_emplace({at.source, name});
  if (added) {
    place->second = std::make_shared<Fonts::Loaded>();
    place->second->font = open_font(in, name, at);
  }
  return place->second;
}

std::shared_ptr<Fonts::Loaded> read_font(Reader& in) {
  if (in.accept("internal")) {
    Span const at = in.next_span();
    int const number = in.integer("number of a font", -1 << 30, 1 << 30);
    bool const known = number >= 0 && number < static_cast<int>(std::size(internal_fonts));
    return find_font(in, std::string(internal_fonts[known ? number : 0]), at);
  }
  if (!in.accept("ttf")) {
    in.unexpected("'ttf' and the name of a font, or 'internal' and a number");
    return nullptr;
  }
  Span const at = in.next_span();
  std::string const name = in.path("the file of a font");
  return name.empty() ? nullptr : find_font(in, name, at);
}

/// The characters of UTF-8; a byte that belongs to none is a blank.
std::u32string characters_of(std::string_view text) {
  std::u32string out;
  for (std::size_t i = 0; i < text.size();) {
    auto const byte = [&](std::size_t k) {
      return i + k < text.size() ? static_cast<unsigned char>(text[i + k]) : 0U;
    };
    unsigned const lead = byte(0);
    std::size_t const size = lead < 0x80                   ? 1
                             : lead >= 0xc2 && lead < 0xe0 ? 2
                             : lead >= 0xe0 && lead < 0xf0 ? 3
                             : lead >= 0xf0 && lead < 0xf5 ? 4
                                                           : 0;
    char32_t code = size == 1 ? lead : lead & (0xffU >> (size + 1));
    bool sound = size > 0;
    for (std::size_t k = 1; k < size; ++k) {
      sound = sound && (byte(k) & 0xc0U) == 0x80;
      code = code << 6 | (byte(k) & 0x3fU);
    }
    out.push_back(sound ? code : U' ');
    i += sound ? size : 1;
  }
  return out;
}

std::optional<geometry::PlacedShape> make_glyph(font::Font const& font, std::uint32_t glyph,
                                                bool flat) {
  std::vector<geometry::Outline> outlines;
  for (font::Contour const& contour : font.outline(glyph)) {
    geometry::Outline& outline = outlines.emplace_back();
    for (font::Segment segment : contour) {
      for (Vec2& point : segment) point.y = 0 - point.y;
      outline.push_back(geometry::bezier_piece(segment));
    }
  }
  auto shape =
      geometry::make_spline_prism(std::move(outlines), geometry::SplinePrism::Sweep::Linear, 0,
                                  flat ? 0 : 1, false, geometry::SplinePrism::Fill::NonZero);
  if (!shape) return std::nullopt;
  // From the plane of y to that of z.
  return geometry::PlacedShape{shape->shape,
                               shape->placement.then(Transform::rotation({90, 0, 0}))};
}

/// How glyphs follow one another, as POV-Ray has it: the first one begins where it is drawn, not
/// where its space does; then by advances, kerning and the offset.
class Pen {
public:
  Pen(font::Font const& font, Vec3 const& offset) : font_(font), offset_(offset) {}

  Vec3 place(std::uint32_t glyph) {
    if (!last_) {
      units_ = -font_.left_bearing(glyph);
    } else {
      units_ += font_.advance(*last_) + font_.kerning(*last_, glyph);
      ++steps_;
    }
    last_ = glyph;
    return Vec3(units_ / font_.units_per_em(), 0, 0) + static_cast<double>(steps_) * offset_;
  }

private:
  font::Font const& font_;
  Vec3 offset_;
  double units_ = 0;
  int steps_ = 0;
  std::optional<std::uint32_t> last_;
};

} // namespace

/** @scene text { ttf "FILE" "TEXT" thickness, offset } | text { internal NUMBER "TEXT" thickness,
 * offset }: the text in the xy plane from its baseline on, one unit a line's height, drawn out from
 * z = 0 to the thickness; each character is moved on by the
 * offset's x and y besides. */
scene::Object read_text_object(Reader& in) {
  scene::Object object;
  object.kind = scene::Object::Kind::Union;
  object.span = in.block_span();
  auto const loaded = read_font(in);
  if (!loaded) {
    while (!in.at_end()) in.skip();
    return object;
  }
  std::u32string const characters = characters_of(in.string("the text"));
  Span const at = in.next_span();
  double const thickness = in.number("thickness");
  Vec3 offset = in.vec3("offset");
  offset.z = 0; // as in POV-Ray
  bool const flat = thickness == 0;
  if (!loaded->font) return object; // reported
  if (!(flat || geometry::usable_size(thickness)) || !geometry::finite(offset)) {
    in.report(Severity::Error, "E0632", "a text needs a finite thickness and offset", at);
    return object;
  }
  font::Font const& font = *loaded->font;
  double const em = 1 / font.units_per_em();
  Transform const size = Transform::scaling({em, em, flat ? 1 : thickness});
  Pen pen(font, offset);
  // The first and the last place count for the extent, also of blanks.
  geometry::PlacedShape const blank{
      std::make_shared<geometry::Blank>(geometry::Bounds{Vec3(0), Vec3(0, 0, 1), false}), {}};
  for (std::size_t k = 0; k < characters.size(); ++k) {
    std::uint32_t const glyph = font.glyph(characters[k]);
    Vec3 const place = pen.place(glyph);
    auto const [known, added] = loaded->glyphs.try_emplace({glyph, flat});
    if (added) known->second = make_glyph(font, glyph, flat);
    if (!geometry::finite(place)) {
      in.report(Severity::Error, "E0632", "the offset moves this text out of all numbers", at);
      return object;
    }
    bool const at_end = k == 0 || k + 1 == characters.size();
    if (!known->second && !at_end) continue;
    auto const& [shape, placement] = known->second ? *known->second : blank;
    scene::Object child;
    child.span = object.span;
    child.keyword = "text";
    child.shape = shape;
    child.placement = placement.then(size).then(Transform::rounded_translation(place, 4));
    object.children.push_back(std::move(child));
  }
  if (flat && !object.children.empty())
    in.report(Severity::Warning, "E0632", "this text has no thickness: it has no inside", at);
  return object;
}

} // namespace abbe::lang
