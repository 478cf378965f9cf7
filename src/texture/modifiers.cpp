// SPDX-License-Identifier: MIT
#include "texture/pattern.hpp"

#include <algorithm>
#include <limits>

namespace abbe::texture {
namespace {

struct WaveWord {
  std::string_view word;
  Wave wave;
};
constexpr WaveWord wave_words[] = {
    {"ramp_wave", Wave::Ramp},       {"triangle_wave", Wave::Triangle}, {"sine_wave", Wave::Sine},
    {"scallop_wave", Wave::Scallop}, {"cubic_wave", Wave::Cubic},       {"poly_wave", Wave::Poly},
};

Turbulence& record(PatternModifiers& modifiers) {
  if (!modifiers.turbulence) modifiers.turbulence.emplace();
  return *modifiers.turbulence;
}

int read_octaves(Parameters& in) {
  Span const span = in.next_span();
  int const wanted =
      in.integer("octaves", std::numeric_limits<int>::min(), std::numeric_limits<int>::max());
  int const octaves = std::clamp(wanted, 1, 10);
  if (octaves != wanted)
    in.report(Severity::Warning, "E0383",
              "octaves are limited to 1..10; " + std::to_string(octaves) + " is used", span);
  return octaves;
}

bool read_wave(Parameters& in, PatternModifiers& modifiers) {
  for (WaveWord const& w : wave_words) {
    if (!in.accept(w.word)) continue;
    modifiers.wave = w.wave;
    if (w.wave == Wave::Poly) modifiers.poly_exponent = in.optional_number("exponent").value_or(1);
    return true;
  }
  return false;
}

} // namespace

bool read_turbulence_item(Parameters& in, PatternModifiers& modifiers) {
  if (in.accept("octaves"))
    record(modifiers).octaves = read_octaves(in);
  else if (in.accept("omega"))
    record(modifiers).omega = in.number("omega");
  else if (in.accept("lambda"))
    record(modifiers).lambda = in.number("lambda");
  else
    return false;
  return true;
}

bool read_modifier(Parameters& in, PatternModifiers& modifiers) {
  if (read_turbulence_item(in, modifiers)) return true;
  if (in.accept("turbulence"))
    record(modifiers).amount = in.vec3("turbulence");
  else if (in.accept("frequency"))
    modifiers.frequency = in.number("frequency");
  else if (in.accept("phase"))
    modifiers.phase = in.number("phase");
  else if (in.accept("noise_generator"))
    modifiers.noise_generator = in.integer("noise generator", 1, 3);
  else
    return read_wave(in, modifiers);
  return true;
}

} // namespace abbe::texture
