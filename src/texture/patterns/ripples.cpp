// SPDX-License-Identifier: MIT
#include "texture/patterns/ripples.hpp"

#include "simd/math.hpp"
#include "texture/noise_tables.hpp"
#include "texture/patterns/formula.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace abbe::texture {
namespace {

constexpr std::size_t number_of_waves = 10;

struct WaveSource {
  Vec3 centre;
  double frequency;
};
using WaveSources = std::array<WaveSource, number_of_waves>;

WaveSources make_wave_sources() {
  WaveSources sources;
  auto state = static_cast<std::uint32_t>(-560851967);
  double at = 0;
  for (WaveSource& source : sources) {
    source.centre = glm::normalize(vector_noise(Vec3(at, 0, 0)));
    state = lcg(state);
    source.frequency = lcg_high(state) * 0.000030518509476 + 0.01;
    at += 1;
  }
  return sources;
}

WaveSources const& wave_sources() {
  static WaveSources const sources = make_wave_sources();
  return sources;
}

double ripples(Vec3 const& p, PatternModifiers const& modifiers) {
  double const frequency = modifiers.frequency.value_or(1);
  double sum = 0;
  for (WaveSource const& source : wave_sources())
    sum += simd::sin(2 * std::numbers::pi
                     * (glm::length(p - source.centre) * frequency + modifiers.phase));
  return 0.5 * (1 + sum / number_of_waves);
}

double waves(Vec3 const& p, PatternModifiers const& modifiers) {
  double const frequency = modifiers.frequency.value_or(1);
  double sum = 0;
  for (WaveSource const& source : wave_sources())
    sum += simd::sin(
               2 * std::numbers::pi
               * (glm::length(p - source.centre) * frequency * source.frequency + modifiers.phase))
           / source.frequency;
  return 0.2 * (2.5 + sum / number_of_waves);
}

/// @param frequency of the pattern times that of the source
Vec3 slope(Vec3 const& p, WaveSource const& source, double frequency, double phase) {
  Vec3 const way = p - source.centre;
  double const distance = glm::length(way);
  if (distance == 0) return Vec3(0);
  return simd::sin(2 * std::numbers::pi * (distance * frequency + phase)) / distance * way;
}

void tilt_by_ripples(Vec3 const& p, PatternModifiers const& modifiers, double amount,
                     Vec3& normal) {
  double const frequency = modifiers.frequency.value_or(1);
  for (WaveSource const& source : wave_sources())
    normal += amount / number_of_waves * slope(p, source, frequency, modifiers.phase);
}

void tilt_by_waves(Vec3 const& p, PatternModifiers const& modifiers, double amount, Vec3& normal) {
  double const frequency = modifiers.frequency.value_or(1);
  for (WaveSource const& source : wave_sources())
    normal += amount / number_of_waves / source.frequency
              * slope(p, source, frequency * source.frequency, modifiers.phase);
}

} // namespace

std::shared_ptr<Pattern const> read_ripples(Parameters&) {
  return make_formula({.raw = ripples, .tilt = tilt_by_ripples});
}

std::shared_ptr<Pattern const> read_waves(Parameters&) {
  return make_formula({.raw = waves, .tilt = tilt_by_waves});
}

} // namespace abbe::texture
