// SPDX-License-Identifier: MIT
#include "lang/blocks.hpp"

#include <fmt/format.h>

namespace abbe::lang {

namespace {

using scene::DispersionMode;

/// `jitter uniform 1.0`: distribution and width in bands.
void read_jitter(Reader& in, DispersionMode& mode) {
  if (in.accept("uniform"))
    mode.jitter = DispersionMode::Jitter::Uniform;
  else if (in.accept("triangular"))
    mode.jitter = DispersionMode::Jitter::Triangular;
  Span const at = in.next_span();
  if (auto width = in.optional_number("jitter width in bands")) {
    if (*width >= 0 && *width <= 1000)
      mode.jitter_width_bands = *width;
    else
      in.report(Severity::Error, "E0353",
                fmt::format("the jitter's width must be 0 to 1000 bands, not {}", *width), at);
  }
}

} // namespace

scene::DispersionMode read_dispersion_mode(Reader& in) {
  DispersionMode mode;
  mode.span = in.block_span();
  bool rejected = false;
  while (!in.at_end()) {
    Span const at = in.next_span();
    bool const stochastic = mode.kind == DispersionMode::Kind::Stochastic;
    if (in.accept("none")) {
      mode.kind = DispersionMode::Kind::None;
    } else if (in.accept("deterministic")) {
      mode.kind = DispersionMode::Kind::Deterministic;
    } else if (in.accept("stochastic")) {
      mode.kind = DispersionMode::Kind::Stochastic;
    } else if (in.accept("faithful") || in.accept("jitter")) {
      bool const faithful = at.text() == "faithful";
      if (!stochastic)
        in.report(Severity::Error, "E0252",
                  fmt::format("'{}' belongs to 'stochastic'", faithful ? "faithful" : "jitter"),
                  at);
      if (faithful)
        mode.faithful = true;
      else
        read_jitter(in, mode);
    } else {
      reject(in, "a dispersion mode");
      rejected = true;
    }
  }
  if (mode.kind == DispersionMode::Kind::Inherit && !rejected)
    in.report(Severity::Error, "E0250",
              "dispersion {} needs a mode: none, deterministic or stochastic", mode.span);
  return mode;
}

} // namespace abbe::lang
