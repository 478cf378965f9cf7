// SPDX-License-Identifier: MIT
#include "lang/blocks.hpp"
#include "lang/not_rendered.hpp"

#include <fmt/format.h>

#include <cmath>

namespace abbe::lang {

namespace {

using scene::Interior;

double read_not_negative(Reader& in, std::string_view name) {
  Span const at = in.next_span();
  double const value = in.number(name);
  if (value >= 0) return value;
  in.report(Severity::Error, "E0353", fmt::format("{} must not be negative, it is {}", name, value),
            at);
  return 0;
}

/// POV-Ray: 0 means unset, as 1.
double read_ior(Reader& in) {
  double const ior = read_not_negative(in, "ior");
  return ior == 0 ? 1 : ior;
}

double read_dispersion_ratio(Reader& in) {
  Span const at = in.next_span();
  double const ratio = in.number("dispersion");
  if (ratio > 0) return ratio;
  in.report(Severity::Error, "E0353",
            fmt::format("dispersion is a ratio of indices and positive, not {}", ratio), at);
  return 1;
}

/// `glass { ... }`, `glass Name`, `glass "N-BK7"`
bool read_glass_item(Reader& in, Interior& interior) {
  if (in.open("glass")) {
    interior.glass = read_glass(in);
    in.close();
    return true;
  }
  if (!in.accept("glass")) return false;
  Span const at = in.next_span();
  if (auto named = in.accept_value<optics::Glass>())
    interior.glass = named;
  else if (in.next() == Next::String)
    interior.glass = named_glass(in, in.string("name of a glass"), at);
  else if (!reject_unquoted_glass(in))
    in.report(Severity::Error, "E0250", "expected a glass: its name, \"name\" or { ... }", at);
  return true;
}

bool read_dispersion_item(Reader& in, Interior& interior) {
  if (in.open("dispersion")) {
    interior.dispersion = read_dispersion_mode(in);
    in.close();
  } else if (in.accept("dispersion")) {
    interior.pov_dispersion = read_dispersion_ratio(in);
  } else if (in.accept("dispersion_samples")) {
    interior.pov_dispersion_samples = in.integer("dispersion_samples", 2, 1000);
  } else {
    return false;
  }
  return true;
}

bool read_fade(Reader& in, Interior& interior) {
  if (in.accept("fade_distance"))
    interior.fade_distance = in.number("fade_distance");
  else if (in.accept("fade_power"))
    interior.fade_power = in.number("fade_power");
  else if (in.accept("fade_color") || in.accept("fade_colour"))
    interior.fade_colour = read_rgb(in, "fade_color");
  else if (in.accept("caustics"))
    interior.caustics = in.number("caustics");
  else
    return false;
  return true;
}

/// colour + (1 - colour) / (1 + (depth / fade_distance)^fade_power) is what POV-Ray takes, whatever
/// the numbers.
void check_fade(Reader& in, Interior const& interior, Span at) {
  double const distance = interior.fade_distance, power = interior.fade_power;
  if (distance == 0) return;
  if (distance < 0 && (std::fmod(power, 2) != 0 || power >= 1000))
    in.report(
        Severity::Error, "E0353",
        fmt::format("light inside would grow without bound: fade_distance is {}, and fade_power "
                    "{} is no even number below 1000",
                    distance, power),
        at);
  else if (power == 0)
    in.report(Severity::Warning, "E0353",
              "without a fade_power, half of what fade_distance can take is lost at any depth (and "
              "nothing in shadows), as in POV-Ray",
              at);
  else if (power < 0)
    in.report(Severity::Warning, "E0353",
              fmt::format("fade_power {} takes less light the deeper it goes (and nothing in "
                          "shadows), as in POV-Ray",
                          power),
              at);
}

} // namespace

void read_interior(Reader& in, Interior& interior) {
  Span const span = in.block_span();
  Span ior_at, fade_at;
  for (bool first = true; !in.at_end(); first = false) {
    Span const at = in.next_span();
    if (auto named = in.accept_copied<Interior>(first, "interior")) {
      interior = *named;
    } else if (auto glass = in.accept_value<optics::Glass>()) {
      interior.glass = glass;
    } else if (in.accept("ior")) {
      interior.ior = read_ior(in);
      ior_at = at;
    } else if (read_fade(in, interior)) {
      fade_at = at;
    } else if (in.open("media")) {
      read_media(in);
      in.close();
    } else if (in.accept("priority")) {
      interior.priority = in.integer("priority", -1000000, 1000000);
    } else if (!read_glass_item(in, interior) && !read_dispersion_item(in, interior)) {
      reject(in, "an interior item");
    }
  }
  interior.span = span;
  if (fade_at.valid()) check_fade(in, interior, fade_at);
  if (interior.glass && ior_at.valid())
    in.report(Severity::Warning, "E0422", "ior has no effect beside a glass", ior_at);
}

} // namespace abbe::lang
