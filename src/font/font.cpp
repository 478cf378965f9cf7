// SPDX-License-Identifier: MIT
#include "font/font.hpp"

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <mutex>

namespace abbe::font {

struct Font::Impl {
  std::string bytes; ///< FreeType reads from here as long as the face is there
  FT_Library library = nullptr;
  FT_Face face = nullptr;
  bool symbols = false;
  std::mutex mutable mutex; ///< of the face, whose glyphs are loaded into one slot

  ~Impl() {
    if (face != nullptr) FT_Done_Face(face);
    if (library != nullptr) FT_Done_FreeType(library);
  }
};

namespace {

/// Outlines as they are: no size, no hints, no pictures.
constexpr FT_Int32 as_drawn = FT_LOAD_NO_SCALE | FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP
                              | FT_LOAD_NO_AUTOHINT | FT_LOAD_IGNORE_TRANSFORM;

/// The character map for Unicode, else one with symbols at 0xf000, else what the font has.
bool choose_characters(FT_Face face) {
  if (FT_Select_Charmap(face, FT_ENCODING_UNICODE) == 0) return false;
  if (FT_Select_Charmap(face, FT_ENCODING_MS_SYMBOL) == 0) return true;
  if (FT_Select_Charmap(face, FT_ENCODING_APPLE_ROMAN) != 0 && face->num_charmaps > 0)
    FT_Set_Charmap(face, face->charmaps[0]);
  return false;
}

/// Collects the contours of an outline as FreeType walks along it.
struct Collector {
  std::vector<Contour> contours;
  Vec2 at{0}, first{0};

  static Vec2 point(FT_Vector const* v) {
    return {static_cast<double>(v->x), static_cast<double>(v->y)};
  }
  void finish() {
    if (contours.empty()) return;
    if (at != first) contours.back().push_back({at, first});
    if (contours.back().empty()) contours.pop_back();
  }
  void line_to(Vec2 const& to) {
    if (to != at) contours.back().push_back({at, to});
    at = to;
  }
  void curve(Segment segment) {
    at = segment.back();
    contours.back().push_back(std::move(segment));
  }

  static int move_to(FT_Vector const* to, void* self) {
    auto& c = *static_cast<Collector*>(self);
    c.finish();
    c.contours.emplace_back();
    c.at = c.first = point(to);
    return 0;
  }
  static int line_to(FT_Vector const* to, void* self) {
    static_cast<Collector*>(self)->line_to(point(to));
    return 0;
  }
  static int conic_to(FT_Vector const* control, FT_Vector const* to, void* self) {
    auto& c = *static_cast<Collector*>(self);
    c.curve({c.at, point(control), point(to)});
    return 0;
  }
  static int cubic_to(FT_Vector const* one, FT_Vector const* two, FT_Vector const* to, void* self) {
    auto& c = *static_cast<Collector*>(self);
    c.curve({c.at, point(one), point(two), point(to)});
    return 0;
  }
};

Error damaged(std::string const& name, std::string const& why) {
  return {"E0518", "'" + name + "' " + why};
}

} // namespace

Font::Font(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Font::~Font() = default;

Result<std::shared_ptr<Font const>> Font::open(std::string bytes, std::string const& name) {
  auto impl = std::make_unique<Impl>();
  impl->bytes = std::move(bytes);
  if (FT_Init_FreeType(&impl->library) != 0)
    return damaged(name, "cannot be read: FreeType does not start");
  auto const* data = reinterpret_cast<FT_Byte const*>(impl->bytes.data());
  FT_Error const failed = FT_New_Memory_Face(
      impl->library, data, static_cast<FT_Long>(impl->bytes.size()), 0, &impl->face);
  if (failed != 0) {
    impl->face = nullptr;
    return damaged(name, failed == FT_Err_Unknown_File_Format
                             ? "is not a font: expected a TrueType or OpenType file"
                             : "is damaged: its tables cannot be read");
  }
  if (!FT_IS_SCALABLE(impl->face)) return damaged(name, "has no outlines, only pictures of sizes");
  if (impl->face->units_per_EM == 0) return damaged(name, "is damaged: its size is 0");
  impl->symbols = choose_characters(impl->face);
  return std::shared_ptr<Font const>(new Font(std::move(impl)));
}

double Font::units_per_em() const {
  return impl_->face->units_per_EM;
}

std::uint32_t Font::glyph(char32_t character) const {
  std::lock_guard const lock(impl_->mutex);
  std::uint32_t const found = FT_Get_Char_Index(impl_->face, character);
  if (found == 0 && impl_->symbols && character < 0x100)
    return FT_Get_Char_Index(impl_->face, 0xf000 + character);
  return found;
}

std::vector<Contour> Font::outline(std::uint32_t glyph) const {
  std::lock_guard const lock(impl_->mutex);
  if (FT_Load_Glyph(impl_->face, glyph, as_drawn) != 0
      || impl_->face->glyph->format != FT_GLYPH_FORMAT_OUTLINE)
    return {};
  FT_Outline_Funcs const steps{
      Collector::move_to, Collector::line_to, Collector::conic_to, Collector::cubic_to, 0, 0};
  Collector collector;
  if (FT_Outline_Decompose(&impl_->face->glyph->outline, &steps, &collector) != 0) return {};
  collector.finish();
  return std::move(collector.contours);
}

double Font::advance(std::uint32_t glyph) const {
  std::lock_guard const lock(impl_->mutex);
  if (FT_Load_Glyph(impl_->face, glyph, as_drawn) != 0) return 0;
  return static_cast<double>(impl_->face->glyph->metrics.horiAdvance);
}

double Font::left_bearing(std::uint32_t glyph) const {
  std::lock_guard const lock(impl_->mutex);
  if (FT_Load_Glyph(impl_->face, glyph, as_drawn) != 0) return 0;
  return static_cast<double>(impl_->face->glyph->metrics.horiBearingX);
}

double Font::kerning(std::uint32_t left, std::uint32_t right) const {
  std::lock_guard const lock(impl_->mutex);
  FT_Vector by{0, 0};
  if (FT_Get_Kerning(impl_->face, left, right, FT_KERNING_UNSCALED, &by) != 0) return 0;
  return static_cast<double>(by.x);
}

} // namespace abbe::font
