// SPDX-License-Identifier: MIT
#include "lang/blocks.hpp"
#include "lang/libraries.hpp"
#include "lang/pairs.hpp"
#include "optics/cie_table.hpp"
#include "optics/spectra_data.hpp"

#include <fmt/format.h>

namespace abbe::lang {

namespace {

using optics::cie_first_nm, optics::cie_last_nm;
using optics::Spectrum;

/// Wavelengths of so few nm are no light: um were meant.
constexpr double hardly_nm = 100;

/// A spectrum or a reported error and white.
Spectrum checked(Reader& in, Result<Spectrum> spectrum, Span at) {
  if (spectrum) return std::move(*spectrum);
  in.report(Severity::Error, spectrum.error().code, spectrum.error().message, at);
  return Spectrum::constant(1);
}

/// `illuminant "D65"`: CIE illuminants and lamps.
Spectrum read_named_light(Reader& in) {
  Span const at = in.next_span();
  std::string const name = in.string("name of an illuminant or lamp");
  auto const* library = name.empty() ? nullptr : spectra_library(in, at);
  return library ? checked(in, optics::load_light(*library, name), at) : Spectrum::constant(1);
}

/// A bare name: a reflectance, or a metal seen from straight ahead is not one (its colour depends
/// on the angle), so it is named where it belongs.
Spectrum read_named(Reader& in) {
  Span const at = in.next_span();
  std::string const name = in.string("name of a spectrum");
  auto const* library = name.empty() ? nullptr : spectra_library(in, at);
  if (!library) return Spectrum::constant(1);
  auto entry = library->find(name);
  if (!entry) return checked(in, entry.error(), at);
  if (entry->kind == "metal_entry") {
    in.report(
        Severity::Error, "E0420",
        "'" + name
            + "' is a metal: its reflectance depends on the angle; write finish { reflection { "
              "metal \""
            + name + "\" } }",
        at);
    return Spectrum::constant(1);
  }
  bool const reflectance = entry->kind == "reflectance_entry";
  return checked(in,
                 reflectance ? optics::load_reflectance(*library, name)
                             : optics::load_light(*library, name),
                 at);
}

Spectrum read_form(Reader& in) {
  Span const at = in.next_span();
  if (in.next() == Next::Bracket) {
    auto rows = read_pairs(in, "wavelength in nm", "value");
    if (!rows.empty() && (rows.back()[0] < cie_first_nm || rows.front()[0] > cie_last_nm))
      in.report(Severity::Warning, "E0423",
                fmt::format("no point of the spectrum is visible light, {} to {} nm{}",
                            cie_first_nm, cie_last_nm,
                            rows.back()[0] <= hardly_nm ? ": are its wavelengths in um?" : ""),
                at);
    return checked(in, Spectrum::samples(std::move(rows)), at);
  }
  if (in.accept("blackbody"))
    return checked(in, Spectrum::blackbody(in.number("temperature in kelvin")), at);
  if (in.accept("illuminant")) return read_named_light(in);
  if (in.open("lines")) {
    auto rows = read_pairs(in, "wavelength in nm", "energy");
    in.close();
    return checked(in, Spectrum::lines(std::move(rows)), at);
  }
  if (in.next() == Next::String) return read_named(in);
  in.report(
      Severity::Error, "E0250",
      "a spectrum is rows [nm, value], blackbody T, illuminant \"name\", lines { } or \"name\"",
      in.block_span());
  while (!in.at_end()) in.skip();
  return Spectrum::constant(1);
}

} // namespace

std::shared_ptr<optics::Spectrum const> read_spectrum(Reader& in) {
  if (Value const* value = in.identifier()) {
    if (auto const* colour = std::get_if<scene::Colour>(&value->any); colour && colour->spectrum) {
      auto named = std::make_shared<Spectrum>(colour->spectrum->scaled(colour->rgb.x));
      in.take();
      return named;
    }
    if (auto named = in.accept_value<Spectrum>()) return named;
  }
  if (in.open("spectrum")) { // what a macro yields
    auto inner = read_spectrum(in);
    in.close();
    return inner;
  }
  auto spectrum = std::make_shared<Spectrum>(read_form(in));
  while (!in.at_end()) reject(in, "the end of the spectrum");
  return spectrum;
}

} // namespace abbe::lang
