// SPDX-License-Identifier: MIT
#include "texture/patterns/ripples.hpp"

#include "simd/math.hpp"
#include "texture/noise_tables.hpp"

#include <cmath>
#include <numbers>
#include <vector>

namespace abbe::texture {
namespace {

constexpr int usual_sources = 10;

struct WaveSource {
  Vec3 centre;
  double frequency; ///< of waves; 1 for ripples
};

std::vector<WaveSource> make_sources(int count, bool waves) {
  std::vector<WaveSource> sources(static_cast<std::size_t>(count));
  auto state = static_cast<std::uint32_t>(-560851967);
  double at = 0;
  for (WaveSource& source : sources) {
    source.centre = glm::normalize(vector_noise(Vec3(at, 0, 0)));
    state = lcg(state);
    source.frequency = waves ? lcg_high(state) * 0.000030518509476 + 0.01 : 1;
    at += 1;
  }
  return sources;
}

/// Ripples, or waves: of which each source has a frequency and height of its own.
class Ripples final : public Pattern {
public:
  Ripples(int count, bool waves) : sources_(make_sources(count, waves)), waves_(waves) {}

  double raw(Vec3 const& p, PatternModifiers const& modifiers) const override {
    double const frequency = modifiers.frequency.value_or(1);
    double sum = 0;
    for (WaveSource const& source : sources_)
      sum += simd::sin(2 * std::numbers::pi
                       * (glm::length(p - source.centre) * frequency * source.frequency
                          + modifiers.phase))
             / source.frequency;
    double const mean = sum / static_cast<double>(sources_.size());
    return waves_ ? 0.2 * (2.5 + mean) : 0.5 * (1 + mean);
  }
  bool tilt(Vec3 const& p, PatternModifiers const& modifiers, double amount,
            Vec3& normal) const override {
    double const frequency = modifiers.frequency.value_or(1);
    double const each = amount / static_cast<double>(sources_.size());
    for (WaveSource const& source : sources_) {
      Vec3 const way = p - source.centre;
      double const distance = glm::length(way);
      if (distance == 0) continue;
      double const swing = simd::sin(
          2 * std::numbers::pi * (distance * (frequency * source.frequency) + modifiers.phase));
      normal += each / source.frequency * (swing / distance * way);
    }
    return true;
  }

private:
  std::vector<WaveSource> sources_;
  bool waves_;
};

} // namespace

std::shared_ptr<Pattern const> make_ripples(int sources) {
  return std::make_shared<Ripples>(sources, false);
}
std::shared_ptr<Pattern const> make_waves(int sources) {
  return std::make_shared<Ripples>(sources, true);
}

std::shared_ptr<Pattern const> read_ripples(Parameters&) {
  static auto const ripples = make_ripples(usual_sources);
  return ripples;
}
std::shared_ptr<Pattern const> read_waves(Parameters&) {
  static auto const waves = make_waves(usual_sources);
  return waves;
}

} // namespace abbe::texture
