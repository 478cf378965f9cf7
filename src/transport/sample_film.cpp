// SPDX-License-Identifier: MIT
#include "transport/sample_film.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

namespace abbe::transport {

namespace {

bool doubles(optics::Comb const& comb) {
  return comb.follow == optics::Comb::Follow::Doubled;
}

} // namespace

SampleFilm::SampleFilm(Stage const& stage, WaveTables const& waves, std::size_t samples)
    : stage_(stage) {
  auto const n = static_cast<std::uint32_t>(stage.channels);
  std::uint32_t slots = n;
  for (auto const& comb : stage.combs) {
    Part part;
    bool const apart = comb.has_control();
    auto const number = static_cast<int>(parts_.size());
    auto const of_comb = static_cast<std::uint32_t>(waves.teeth(number));
    std::uint32_t const teeth = !apart ? 0 : doubles(comb) ? 2 * of_comb : of_comb;
    part.light = slots;
    part.control = part.light + teeth;
    part.picked = part.control + (apart ? n : 0);
    part.picked_control = part.picked + (comb.picks_one() ? teeth : 0);
    slots = part.end = part.picked_control + (comb.picks_one() ? n : 0);
    parts_.push_back(part);
  }
  slots_ = slots;
  stride_bits_ = static_cast<std::uint32_t>(std::bit_width(slots - 1));
  values_.resize(samples << stride_bits_);
  plain_.resize(n);
}

void SampleFilm::start_samples(std::size_t count) {
  samples_ = static_cast<std::uint32_t>(count);
  values_.assign(count << stride_bits_, 0.0);
  sample_of_.resize(count);
  std::iota(sample_of_.begin(), sample_of_.end(), 0U);
}

SampleFilm::Block SampleFilm::add_block(Block like) {
  sample_of_.push_back(sample_of_[like]);
  values_.resize(sample_of_.size() << stride_bits_, 0.0);
  return static_cast<Block>(sample_of_.size() - 1);
}

bool SampleFilm::is_dark(double const* values, int comb) const {
  return std::all_of(values + part(comb).light, values + part(comb).end,
                     [](double v) { return v == 0; });
}

Vec3 SampleFilm::resolve_all(std::size_t sample, WaveTables& waves, std::span<double> bands) const {
  auto const n = static_cast<std::size_t>(stage_.channels);
  double const* const values = values_.data() + first(static_cast<Block>(sample));
  Vec3 rgb(0);
  std::fill(bands.begin(), bands.end(), 0.0);
  double const* plain = values;
  // A sample that never met these materials has nothing there: most of a picture.
  for (int j = 0; j < static_cast<int>(stage_.combs.size()); ++j) {
    if (is_dark(values, j)) continue;
    if (plain == values) std::copy_n(values, n, plain_.begin());
    plain = plain_.data();
    double const* control = values + part(j).control;
    for (std::size_t c = 0; c < n; ++c) plain_[c] += control[c];
    if (settings(j).picks_one())
      for (std::size_t c = 0; c < n; ++c) plain_[c] += values[part(j).picked_control + c];
    if (doubles(settings(j)))
      resolve_doubled(sample, waves, j);
    else
      rgb += resolve_teeth(sample, waves, j, bands);
  }
  for (std::size_t c = 0; c < n; ++c) rgb += plain[c] * stage_.rgb_weights[c];
  add_plain({plain, n}, bands);
  return rgb;
}

void SampleFilm::add_plain(std::span<double const> light, std::span<double> bands) const {
  if (bands.empty()) return;
  for (std::size_t c = 0; c < bands.size(); ++c) bands[c] += light[c];
  // A line is seen in the band that it lies in, all its power.
  for (std::size_t c = bands.size(); c < light.size(); ++c) {
    double const lambda_nm = stage_.lambda_nm(static_cast<int>(c));
    int const band = stage_.bands().index_of(lambda_nm);
    bands[static_cast<std::size_t>(band)] +=
        light[c] * optics::d65_power_at(lambda_nm)
        / (stage_.bands().d65_power(band) * stage_.bands().width(band));
  }
}

Vec3 SampleFilm::resolve_teeth(std::size_t sample, WaveTables& waves, int comb,
                               std::span<double> bands) const {
  int const wave = waves.first_draw(comb);
  auto const block = static_cast<Block>(sample);
  double const* light = values_.data() + tooth_slot(block, comb, 0);
  double const* control = values_.data() + control_slot(block, comb, 0);
  auto const weights = waves.rgb_weights(wave, sample);
  auto const channels = waves.channels(wave, sample);
  Vec3 rgb(0);
  auto const add = [&](std::size_t tooth, double change) {
    // A line is the same whatever is drawn.
    if (stage_.spectral->is_line(channels[tooth])) {
      plain_[channels[tooth]] += change;
      return;
    }
    rgb += change * weights[tooth];
    if (bands.empty()) return;
    auto const& spread = waves.spreads(wave, sample)[tooth];
    bands[static_cast<std::size_t>(spread.first)] += spread.first_weight * change;
    bands[static_cast<std::size_t>(spread.second)] += spread.second_weight * change;
  };
  for (std::size_t i = 0; i < weights.size(); ++i) add(i, light[i] - control[channels[i]]);
  if (!settings(comb).picks_one()) return rgb;
  // Emission lines are never left out: what goes on of their control light counts at once.
  double const* const picked_control = values_.data() + picked_control_slot(block, comb, 0);
  for (std::size_t i = 0; i < weights.size(); ++i)
    if (stage_.spectral->is_line(channels[i])) add(i, -picked_control[channels[i]]);
  auto const pick = waves.pick(comb, sample);
  auto const tooth = static_cast<std::size_t>(pick.tooth);
  add(tooth, values_[picked_slot(block, comb, pick.tooth)]
                 - pick.weight * picked_control[channels[tooth]]);
  return rgb;
}

void SampleFilm::resolve_doubled(std::size_t sample, WaveTables& waves, int comb) const {
  auto const n = static_cast<std::size_t>(stage_.channels);
  auto const block = static_cast<Block>(sample);
  double const* light = values_.data() + tooth_slot(block, comb, 0);
  double const* control = values_.data() + control_slot(block, comb, 0);
  auto const first = waves.spreads(waves.first_draw(comb), sample);
  auto const second = waves.spreads(waves.second_draw(comb), sample);
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

Vec3 SampleFilm::doubled_colour(std::size_t sample, WaveTables& waves, int comb,
                                int channel) const {
  auto const& spread =
      waves.spreads(waves.second_draw(comb), sample)[static_cast<std::size_t>(channel)];
  return spread.first_weight * stage_.rgb_weights[static_cast<std::size_t>(spread.first)]
         + spread.second_weight * stage_.rgb_weights[static_cast<std::size_t>(spread.second)];
}

Vec3 SampleFilm::size_of(std::uint32_t slot, double const* light, std::size_t lanes,
                         WaveTables& waves) const {
  auto const n = static_cast<std::uint32_t>(stage_.channels);
  std::size_t const sample = sample_of(slot);
  std::uint32_t const own_first = slot - first(block_of(slot));
  Vec3 sum(0);
  Drawn of;
  for (std::size_t k = 0; k < lanes; ++k) {
    if (light[k] == 0) continue;
    std::uint32_t const own = own_first + static_cast<std::uint32_t>(k);
    if (own < n) {
      sum += light[k] * glm::abs(stage_.rgb_weights[own]);
      continue;
    }
    int comb = 0;
    while (own >= part(comb).end) ++comb;
    if (of.comb != comb) of = drawn(sample, comb, waves);
    sum += light[k] * glm::abs(comb_colour(of, own, waves));
  }
  return sum;
}

SampleFilm::Drawn SampleFilm::drawn(std::size_t sample, int comb, WaveTables& waves) const {
  Drawn out{comb, sample, {}, {}, {}};
  if (doubles(settings(comb))) return out;
  int const wave = waves.first_draw(comb);
  out.weights = waves.rgb_weights(wave, sample);
  out.channels = waves.channels(wave, sample);
  if (settings(comb).picks_one()) out.pick = waves.pick(comb, sample);
  return out;
}

Vec3 SampleFilm::comb_colour(Drawn const& drawn, std::uint32_t slot, WaveTables& waves) const {
  auto const& [comb, sample, weights, channels, pick] = drawn;
  Part const& p = part(comb);
  if (doubles(settings(comb))) {
    auto const first = waves.spreads(waves.first_draw(comb), sample);
    if (slot < p.control) {
      auto const i = slot - p.light;
      return doubled_colour(sample, waves, comb,
                            i % 2 == 0 ? first[i / 2].first : first[i / 2].second);
    }
    auto const c = slot - p.control;
    Vec3 colour = stage_.rgb_weights[c];
    for (auto const& spread : first) {
      if (spread.first == static_cast<int>(c))
        colour -= spread.first_weight * doubled_colour(sample, waves, comb, spread.first);
      if (spread.second == static_cast<int>(c))
        colour -= spread.second_weight * doubled_colour(sample, waves, comb, spread.second);
    }
    return colour;
  }
  if (slot < p.control) return weights[slot - p.light];
  if (slot >= p.picked && slot < p.picked_control) return weights[slot - p.picked];
  if (slot < p.picked) {
    auto const c = slot - p.control;
    Vec3 colour = stage_.rgb_weights[c];
    for (std::size_t i = 0; i < weights.size(); ++i)
      if (channels[i] == c) colour -= weights[i];
    return colour;
  }
  auto const c = slot - p.picked_control;
  if (stage_.spectral->is_line(static_cast<int>(c))) return Vec3(0);
  auto const tooth = static_cast<std::size_t>(pick.tooth);
  return stage_.rgb_weights[c] - (channels[tooth] == c ? pick.weight * weights[tooth] : Vec3(0));
}

} // namespace abbe::transport
