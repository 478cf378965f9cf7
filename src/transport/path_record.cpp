// SPDX-License-Identifier: MIT
#include "transport/path_record.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::transport {
namespace {

bool negative(std::span<double const> channels) {
  return std::any_of(channels.begin(), channels.end(), [](double v) { return v < 0; });
}

bool in_order(double value, bool negative_is_wrong) {
  return std::isfinite(value) && !(negative_is_wrong && value < 0);
}

} // namespace

bool negative_light_is_wrong(Stage const& stage) {
  return !negative(stage.background) && !negative(stage.sky_emission)
         && std::none_of(stage.lamps.begin(), stage.lamps.end(),
                         [](auto const& lamp) { return negative(lamp->value()); })
         && !negative(stage.textures.colours)
         && std::none_of(stage.textures.finishes.begin(), stage.textures.finishes.end(),
                         [](surface::CompiledFinish const& finish) {
                           return negative(finish.ambient) || negative(finish.emission);
                         });
}

std::optional<BadSample::Kind> what_is_wrong(std::span<double const> light, Vec3 const& rgb,
                                             bool negative_is_wrong) {
  bool nan = false, infinite = false, below = false;
  for (double const value : light) {
    nan = nan || std::isnan(value);
    infinite = infinite || std::isinf(value);
    below = below || value < 0;
  }
  // Infinite light has no colour: inf - inf.
  if (!nan && !infinite)
    for (int c = 0; c < 3; ++c) {
      nan = nan || std::isnan(rgb[c]);
      infinite = infinite || std::isinf(static_cast<float>(rgb[c]));
    }
  if (nan) return BadSample::Kind::NotANumber;
  if (infinite) return BadSample::Kind::Infinite;
  if (below && negative_is_wrong) return BadSample::Kind::Negative;
  return std::nullopt;
}

std::uint32_t PathRecord::arrive(std::uint32_t from, bool through, Vec3 const& direction,
                                 std::span<double const> light, PathStep step) {
  if (from != none)
    step.kind = !through                             ? PathStep::Kind::Reflected
                : rays_[from].direction == direction ? PathStep::Kind::Passed
                                                     : PathStep::Kind::Refracted;
  step.in_order = std::all_of(light.begin(), light.end(),
                              [&](double value) { return in_order(value, negative_is_wrong_); });
  // What the surface before it did to the light is wrong already.
  if (!guilty_ && !step.in_order && from != none) guilty_ = from;
  rays_.push_back({from, std::move(step), direction});
  return static_cast<std::uint32_t>(rays_.size() - 1);
}

void PathRecord::add(std::uint32_t ray, double light, bool to_sample) {
  if (!guilty_ && !in_order(light, negative_is_wrong_)) guilty_ = ray;
  if (!to_sample || !(std::abs(light) > most_)) return;
  most_ = std::abs(light);
  brightest_ = ray;
}

std::vector<PathStep> PathRecord::path() const {
  std::vector<PathStep> steps;
  if (rays_.empty()) return steps;
  for (std::uint32_t i = guilty_.value_or(brightest_); i != none; i = rays_[i].parent)
    steps.push_back(rays_[i].step);
  std::reverse(steps.begin(), steps.end());
  return steps;
}

} // namespace abbe::transport
