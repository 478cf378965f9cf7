// SPDX-License-Identifier: MIT
#include "lang/blocks.hpp"
#include "simd/math.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace abbe::lang {

namespace {

using scene::Colour;

/// The words that begin a colour given by a vector.
struct VectorForm {
  std::string_view word;
  int components;
  bool fourth_is_transmit;
  bool srgb;
};
constexpr VectorForm vector_forms[] = {
    {"rgb", 3, false, false},   {"rgbf", 4, false, false},  {"rgbt", 4, true, false},
    {"rgbft", 5, false, false}, {"srgb", 3, false, true},   {"srgbf", 4, false, true},
    {"srgbt", 4, true, true},   {"srgbft", 5, false, true},
};

/// One component of an sRGB-encoded colour in the scene's working space.
/// @source IEC 61966-2-1
double from_srgb(double encoded, scene::Settings const& settings) {
  if (settings.assumed_gamma_srgb) return encoded;
  double const linear =
      encoded <= 0.04045 ? encoded / 12.92 : simd::pow((encoded + 0.055) / 1.055, 2.4);
  double const gamma = settings.assumed_gamma.value_or(1);
  return gamma == 1 || linear <= 0 ? linear : simd::pow(linear, 1 / gamma);
}

/// Missing components are zero, except that a lone number stands for as many as `replicate`.
Colour colour_of(Numeric const& value, int replicate) {
  Numeric const five = value.promoted(value.size == 1 ? replicate : 5).promoted(5);
  return {Vec3(five.c[0], five.c[1], five.c[2]), five.c[3], five.c[4], nullptr};
}

Colour read_vector_form(Reader& in, VectorForm const& form, Span& at) {
  at = in.value_span();
  Numeric const value = in.numeric("colour", form.components);
  Colour colour = colour_of(value, form.components);
  if (form.fourth_is_transmit) {
    colour.transmit = colour.filter;
    colour.filter = 0;
  }
  if (form.srgb) {
    auto const& settings = scene_state(in.interpreter()).scene.settings;
    if (!settings.assumed_gamma && !settings.assumed_gamma_srgb)
      in.report(
          Severity::Error, "E0355",
          fmt::format("'{}' needs global_settings {{ assumed_gamma ... }} before it", form.word),
          at);
    for (int i = 0; i < 3; ++i) colour.rgb[i] = from_srgb(colour.rgb[i], settings);
  }
  return colour;
}

/// `red e`, `filter e` ...: each sets one component. A comma ends the colour.
/// @return was there any?
bool read_components(Reader& in, Colour& colour) {
  struct {
    std::string_view word;
    double& component;
  } const parts[] = {{"red", colour.rgb.x},
                     {"green", colour.rgb.y},
                     {"blue", colour.rgb.z},
                     {"filter", colour.filter},
                     {"transmit", colour.transmit}};
  bool any = false;
  while (!in.at_end()) {
    auto const part =
        std::ranges::find_if(parts, [&](auto const& one) { return in.accept(one.word); });
    if (part == std::end(parts)) break;
    any = true;
    Span const at = in.value_span();
    part->component = in.number(part->word);
    if (in.comma_follows(at)) break;
  }
  return any;
}

/// A declared spectrum, alone or scaled.
std::optional<Colour> accept_spectrum_name(Reader& in) {
  Value const* const value = in.identifier();
  if (!value) return std::nullopt;
  if (auto const* colour = std::get_if<Colour>(&value->any)) {
    Colour copy = *colour;
    in.take();
    return copy;
  }
  if (auto spectrum = in.accept_value<optics::Spectrum>())
    return Colour{Vec3(1), 0, 0, std::move(spectrum)};
  return std::nullopt;
}

/// The part of a colour before its `filter e` and the like.
/// @param bare may a vector stand alone?
/// @param at where its value stands, for comma_follows()
std::optional<Colour> accept_start(Reader& in, bool bare, Span& at) {
  if (in.next() == Next::Word)
    for (VectorForm const& form : vector_forms)
      if (in.accept(form.word)) return read_vector_form(in, form, at);
  at = in.value_span();
  if (in.open("spectrum")) {
    Colour colour{Vec3(1), 0, 0, read_spectrum(in)};
    in.close();
    return colour;
  }
  if (auto named = accept_spectrum_name(in)) return named;
  if (!in.has_value()) return std::nullopt;
  Numeric const value = in.numeric("colour");
  if (!bare && !value.colour && !value.poisoned())
    in.report(Severity::Error, "E0354",
              "a colour must begin here with 'rgb', 'color' or a colour's name, not with a bare "
              "number or vector",
              at);
  return colour_of(value, 5);
}

} // namespace

Colour read_colour_parts(Reader& in, Colour start) {
  read_components(in, start);
  return start;
}

namespace {

std::optional<Colour> accept_any(Reader& in, bool bare) {
  bool const announced = in.accept("color") || in.accept("colour");
  Span at;
  std::optional<Colour> colour = accept_start(in, bare || announced, at);
  Colour parts = colour.value_or(Colour{});
  bool any = colour.has_value();
  if (!any || !in.comma_follows(at)) any = read_components(in, parts) || any;
  if (!any && announced) {
    in.report(Severity::Error, "E0250", "expected a colour after 'color'", in.next_span());
    return Colour{};
  }
  return any ? std::optional(std::move(parts)) : std::nullopt;
}

} // namespace

bool starts_colour(Reader& in) {
  static constexpr std::string_view words[] = {"color", "colour", "red",     "green",
                                               "blue",  "filter", "transmit"};
  switch (in.next()) {
  case Next::Numeric:
    return true;
  case Next::Block:
    return in.next_word() == "spectrum";
  case Next::Word: {
    std::string_view const word = in.next_word();
    return std::ranges::find(words, word) != std::end(words)
           || std::ranges::find(vector_forms, word, &VectorForm::word) != std::end(vector_forms);
  }
  case Next::Identifier: {
    Value const* const value = in.identifier();
    return value
           && (std::holds_alternative<Colour>(value->any)
               || std::holds_alternative<std::shared_ptr<optics::Spectrum const>>(value->any));
  }
  default:
    return false;
  }
}

Colour read_colour(Reader& in, std::string_view name) {
  if (auto colour = accept_any(in, true)) return *colour;
  in.report(Severity::Error, "E0250", fmt::format("expected a colour for {}", name),
            in.next_span());
  return {};
}

Colour read_rgb(Reader& in, std::string_view name) {
  Colour colour = read_colour(in, name);
  colour.filter = colour.transmit = 0;
  return colour;
}

std::optional<Colour> accept_colour(Reader& in) {
  return accept_any(in, false);
}

} // namespace abbe::lang
