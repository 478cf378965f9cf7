// SPDX-License-Identifier: MIT
#include "render/sample_film.hpp"

#include <algorithm>

namespace abbe::render {

SampleFilm::SampleFilm(Stage const& stage) : stage_(stage) {
  auto const n = static_cast<std::size_t>(stage.channels);
  std::size_t slots = n;
  for (auto const& jitter : stage.jitters) {
    jitter_base_.push_back(static_cast<std::uint32_t>(slots));
    slots += jitter.faithful ? 2 * n : n;
  }
  values_.resize(slots);
  plain_.resize(n);
}

void SampleFilm::start_sample() {
  std::fill(values_.begin(), values_.end(), 0.0);
}

Vec3 SampleFilm::resolve(WaveTables& waves, std::span<double> bands) const {
  auto const n = static_cast<std::size_t>(stage_.channels);
  std::copy_n(values_.begin(), n, plain_.begin());
  for (int j = 0; j < static_cast<int>(stage_.jitters.size()); ++j)
    if (stage_.jitters[static_cast<std::size_t>(j)].faithful) resolve_faithful(waves, j, plain_);
  Vec3 rgb(0);
  for (std::size_t c = 0; c < n; ++c) rgb += plain_[c] * stage_.rgb_weights[c];
  if (!bands.empty()) std::copy(plain_.begin(), plain_.end(), bands.begin());
  for (int j = 0; j < static_cast<int>(stage_.jitters.size()); ++j)
    if (!stage_.jitters[static_cast<std::size_t>(j)].faithful)
      rgb += resolve_locked(waves, j, bands);
  return rgb;
}

Vec3 SampleFilm::resolve_locked(WaveTables& waves, int jitter, std::span<double> bands) const {
  auto const n = static_cast<std::size_t>(stage_.channels);
  double const* light = values_.data() + jitter_base_[static_cast<std::size_t>(jitter)];
  // A sample that never met this material has nothing here: most of a picture.
  if (std::all_of(light, light + n, [](double v) { return v == 0; })) return Vec3(0);
  int const wave = waves.first_draw(jitter);
  auto const weights = waves.rgb_weights(wave);
  Vec3 rgb(0);
  for (std::size_t c = 0; c < n; ++c) rgb += light[c] * weights[c];
  if (!bands.empty()) {
    auto const spreads = waves.spreads(wave);
    for (std::size_t c = 0; c < n; ++c) {
      bands[static_cast<std::size_t>(spreads[c].first)] += spreads[c].first_weight * light[c];
      bands[static_cast<std::size_t>(spreads[c].second)] += spreads[c].second_weight * light[c];
    }
  }
  return rgb;
}

void SampleFilm::resolve_faithful(WaveTables& waves, int jitter, std::span<double> plain) const {
  auto const n = static_cast<std::size_t>(stage_.channels);
  double const* light = values_.data() + jitter_base_[static_cast<std::size_t>(jitter)];
  if (std::all_of(light, light + 2 * n, [](double v) { return v == 0; })) return;
  auto const first = waves.spreads(waves.first_draw(jitter));
  auto const second = waves.spreads(waves.second_draw(jitter));
  auto const add = [&](int channel, double value) {
    auto const& spread = second[static_cast<std::size_t>(channel)];
    plain[static_cast<std::size_t>(spread.first)] += spread.first_weight * value;
    plain[static_cast<std::size_t>(spread.second)] += spread.second_weight * value;
  };
  for (std::size_t c = 0; c < n; ++c) {
    add(first[c].first, light[2 * c]);
    add(first[c].second, light[2 * c + 1]);
  }
}

} // namespace abbe::render
