// SPDX-License-Identifier: MIT
#include "render/sample_film.hpp"

#include <algorithm>

namespace abbe::render {

SampleFilm::SampleFilm(Stage const& stage) : stage_(stage) {
  auto const n = static_cast<std::uint32_t>(stage.channels);
  std::uint32_t slots = n;
  for (auto const& jitter : stage.jitters) {
    Part part;
    part.light = slots;
    parts_.push_back(part);
    if (!has_control(static_cast<int>(parts_.size()) - 1)) continue;
    slots += jitter.faithful ? 2 * n : n;
    parts_.back().control = slots;
    slots += n;
  }
  values_.resize(slots + std::size_t{1});
  plain_.resize(n);
}

void SampleFilm::start_sample() {
  std::fill(values_.begin(), values_.end(), 0.0);
}

bool SampleFilm::is_dark(int jitter) const {
  if (!has_control(jitter)) return true;
  auto const first = values_.begin() + jittered_slot(jitter, 0);
  return std::all_of(first, values_.begin() + control_slot(jitter, stage_.channels),
                     [](double v) { return v == 0; });
}

Vec3 SampleFilm::resolve(WaveTables& waves, std::span<double> bands) const {
  auto const n = static_cast<std::size_t>(stage_.channels);
  std::copy_n(values_.begin(), n, plain_.begin());
  std::fill(bands.begin(), bands.end(), 0.0);
  Vec3 rgb(0);
  // A sample that never met these materials has nothing there: most of a picture.
  for (int j = 0; j < static_cast<int>(stage_.jitters.size()); ++j) {
    if (is_dark(j)) continue;
    double const* control = values_.data() + control_slot(j, 0);
    for (std::size_t c = 0; c < n; ++c) plain_[c] += control[c];
    if (stage_.jitters[static_cast<std::size_t>(j)].faithful)
      resolve_faithful(waves, j);
    else
      rgb += resolve_locked(waves, j, bands);
  }
  for (std::size_t c = 0; c < n; ++c) rgb += plain_[c] * stage_.rgb_weights[c];
  for (std::size_t c = 0; c < bands.size(); ++c) bands[c] += plain_[c];
  return rgb;
}

Vec3 SampleFilm::resolve_plain(std::span<double const> light, std::span<double> bands) const {
  Vec3 rgb(0);
  for (std::size_t c = 0; c < light.size(); ++c) rgb += light[c] * stage_.rgb_weights[c];
  std::copy_n(light.begin(), bands.size(), bands.begin());
  return rgb;
}

Vec3 SampleFilm::resolve_locked(WaveTables& waves, int jitter, std::span<double> bands) const {
  auto const n = static_cast<std::size_t>(stage_.channels);
  double const* light = values_.data() + jittered_slot(jitter, 0);
  double const* control = values_.data() + control_slot(jitter, 0);
  int const wave = waves.first_draw(jitter);
  auto const weights = waves.rgb_weights(wave);
  Vec3 rgb(0);
  for (std::size_t c = 0; c < n; ++c) rgb += (light[c] - control[c]) * weights[c];
  if (!bands.empty()) {
    auto const spreads = waves.spreads(wave);
    for (std::size_t c = 0; c < n; ++c) {
      double const change = light[c] - control[c];
      bands[static_cast<std::size_t>(spreads[c].first)] += spreads[c].first_weight * change;
      bands[static_cast<std::size_t>(spreads[c].second)] += spreads[c].second_weight * change;
    }
  }
  return rgb;
}

void SampleFilm::resolve_faithful(WaveTables& waves, int jitter) const {
  auto const n = static_cast<std::size_t>(stage_.channels);
  double const* light = values_.data() + jittered_slot(jitter, 0);
  double const* control = values_.data() + control_slot(jitter, 0);
  auto const first = waves.spreads(waves.first_draw(jitter));
  auto const second = waves.spreads(waves.second_draw(jitter));
  auto const add = [&](int channel, double value) {
    auto const& spread = second[static_cast<std::size_t>(channel)];
    plain_[static_cast<std::size_t>(spread.first)] += spread.first_weight * value;
    plain_[static_cast<std::size_t>(spread.second)] += spread.second_weight * value;
  };
  for (std::size_t c = 0; c < n; ++c) {
    auto const& spread = first[c];
    // Without dispersion the two would carry the control light of their channels.
    add(spread.first, light[2 * c] - spread.first_weight * control[spread.first]);
    add(spread.second, light[2 * c + 1] - spread.second_weight * control[spread.second]);
  }
}

Vec3 SampleFilm::faithful_colour(WaveTables& waves, int jitter, int channel) const {
  auto const& spread = waves.spreads(waves.second_draw(jitter))[static_cast<std::size_t>(channel)];
  return spread.first_weight * stage_.rgb_weights[static_cast<std::size_t>(spread.first)]
         + spread.second_weight * stage_.rgb_weights[static_cast<std::size_t>(spread.second)];
}

Vec3 SampleFilm::colour(std::uint32_t slot, WaveTables& waves) const {
  auto const n = static_cast<std::uint32_t>(stage_.channels);
  if (slot < n) return stage_.rgb_weights[slot];
  if (slot == unused_slot()) return Vec3(0);
  int jitter = static_cast<int>(parts_.size()) - 1;
  while (jittered_slot(jitter, 0) > slot || !has_control(jitter)) --jitter;
  bool const is_control = slot >= control_slot(jitter, 0);
  auto const c = slot - (is_control ? control_slot(jitter, 0) : jittered_slot(jitter, 0));
  if (!stage_.jitters[static_cast<std::size_t>(jitter)].faithful) {
    Vec3 const jittered = waves.rgb_weights(waves.first_draw(jitter))[c];
    return is_control ? stage_.rgb_weights[c] - jittered : jittered;
  }
  auto const first = waves.spreads(waves.first_draw(jitter));
  if (!is_control)
    return faithful_colour(waves, jitter, c % 2 == 0 ? first[c / 2].first : first[c / 2].second);
  Vec3 colour = stage_.rgb_weights[c];
  for (auto const& spread : first) {
    if (spread.first == static_cast<int>(c))
      colour -= spread.first_weight * faithful_colour(waves, jitter, spread.first);
    if (spread.second == static_cast<int>(c))
      colour -= spread.second_weight * faithful_colour(waves, jitter, spread.second);
  }
  return colour;
}

} // namespace abbe::render
