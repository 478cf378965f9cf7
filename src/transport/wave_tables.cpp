// SPDX-License-Identifier: MIT
#include "transport/wave_tables.hpp"

#include "base/blue_noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace abbe::transport {
namespace {

using Jitter = optics::Comb::Jitter;

// Dimensions of a sample's random numbers. Those of the place are before them in
// SampleKey::points; what is many begins a group of dimensions there.
constexpr std::uint64_t first_offset = 0, second_offset = 1, choice = 2, tooth_offsets = 16;

double fraction(double value) {
  return value - std::floor(value);
}

/// The golden ratio, then those of the plane (M. Roberts 2018): irrational, and not each other's
/// multiples.
constexpr std::array<double, 3> steps{0.6180339887498949, 0.7548776662466927, 0.5698402909980532};

} // namespace

double SampleKey::uniform(std::uint64_t dimension) const {
  if (points) return points->at(number, dimension + (dimension < tooth_offsets ? 2 : 3));
  return fraction(pixel.uniform(dimension)
                  + static_cast<double>(number) * steps[dimension % steps.size()]);
}

double SampleKey::independent(std::uint64_t dimension) const {
  return pixel.child(number).uniform(dimension);
}

double SampleKey::blue() const {
  if (points) return uniform(0);
  // Another seed, another part of the mask, and another start.
  auto const shift = [&](std::uint64_t d) {
    return static_cast<std::int64_t>(64 * picture.uniform(d));
  };
  return fraction(blue_noise(x + shift(0), y + shift(1)) + picture.uniform(2)
                  + static_cast<double>(number) * steps[0]);
}

WaveTables::WaveTables(Stage const& stage, std::size_t samples)
    : stage_(stage), keys_(samples), tables_(2 * stage.combs.size() * samples) {
  if (!stage.combs.empty()) hats_.emplace(stage.bands());
  for (int comb = 0; comb < comb_count(); ++comb)
    teeth_.push_back(drawn_teeth(comb) + stage_.channels - stage_.bands().count());
  for (auto& table : tables_) {
    table.indices_known.resize(stage.media.size());
    table.indices.resize(stage.media.size());
  }
}

void WaveTables::start_samples(std::span<SampleKey const> keys) {
  std::copy(keys.begin(), keys.end(), keys_.begin());
  for (auto& table : std::span(tables_).first(2 * stage_.combs.size() * keys.size())) {
    table.lambdas_known = table.spreads_known = table.weights_known = table.pick_known = false;
    table.indices_known.assign(table.indices_known.size(), false);
  }
}

int WaveTables::drawn_teeth(int comb) const {
  int const asked = stage_.combs[static_cast<std::size_t>(comb)].teeth;
  return asked > 0 ? asked : stage_.bands().count();
}

double WaveTables::common_number(optics::Comb const& comb, SampleKey const& key,
                                 std::uint64_t dimension) const {
  if (comb.jitter == Jitter::Uniform) return key.independent(dimension);
  if (comb.jitter == Jitter::BlueNoise && dimension == first_offset) return key.blue();
  return key.uniform(dimension);
}

double WaveTables::offset(int wave, SampleKey const& key, int tooth) const {
  optics::Comb const& comb = comb_of(wave);
  auto const dimension = wave >= comb_count() ? second_offset : first_offset;
  double u = comb.jitter == Jitter::Stratified
                 ? key.many(tooth_offsets + 2 * static_cast<std::uint64_t>(tooth) + dimension)
                 : common_number(comb, key, dimension);
  // One number draws the hero and the offset of the whole comb: the hero's own wavelength then
  // takes even steps over the whole range.
  if (comb.follow == optics::Comb::Follow::Hero) u = fraction(u * drawn_teeth(wave % comb_count()));
  return optics::jitter_offset(comb, u);
}

void WaveTables::draw(int wave, SampleKey const& key, Table& out) const {
  optics::Bands const& bands = stage_.bands();
  int const m = drawn_teeth(wave % comb_count());
  out.lambdas_nm.clear();
  out.channels.clear();
  for (int i = 0; i < m; ++i) {
    double const xi = offset(wave, key, i);
    // The light of a triangle's tooth is its band's, wherever it lies.
    bool const own_band =
        comb_of(wave).jitter == Jitter::Triangular || (m == bands.count() && std::abs(xi) <= 0.5);
    double const lambda_nm =
        m == bands.count() ? hats_->jittered(i, xi) : hats_->at((i + 0.5 + xi) * bands.count() / m);
    out.lambdas_nm.push_back(lambda_nm);
    out.channels.push_back(static_cast<std::uint16_t>(own_band ? i : bands.index_of(lambda_nm)));
  }
  // Emission lines are where they are.
  for (int c = bands.count(); c < stage_.channels; ++c) {
    out.lambdas_nm.push_back(stage_.lambda_nm(c));
    out.channels.push_back(static_cast<std::uint16_t>(c));
  }
}

WaveTables::Table& WaveTables::drawn(int wave, std::size_t sample) {
  Table& t = tables_[2 * stage_.combs.size() * sample + static_cast<std::size_t>(wave)];
  if (!t.lambdas_known) {
    draw(wave, keys_[sample], t);
    t.lambdas_known = true;
  }
  return t;
}

double WaveTables::lambda_nm(int wave, std::size_t sample, int tooth) {
  auto const at = static_cast<std::size_t>(tooth);
  return wave == band_means ? stage_.lambdas_nm[at] : drawn(wave, sample).lambdas_nm[at];
}

std::span<std::uint16_t const> WaveTables::channels(int wave, std::size_t sample) {
  return drawn(wave, sample).channels;
}

std::span<double const> WaveTables::indices(int medium, int wave, std::size_t sample) {
  Medium const& m = stage_.media[static_cast<std::size_t>(medium)];
  if (wave == band_means) return m.dispersive ? m.index : m.flat_index;
  Table& t = drawn(wave, sample);
  auto const number = static_cast<std::size_t>(medium);
  if (!t.indices_known[number]) {
    auto& values = t.indices[number];
    values.clear();
    for (double const lambda_nm : t.lambdas_nm)
      values.push_back(m.dispersive ? m.glass->index_unchecked(lambda_nm) : m.index_d);
    t.indices_known[number] = true;
  }
  return t.indices[number];
}

WaveTables::Pick WaveTables::pick(int comb, std::size_t sample) {
  Table& t = drawn(first_draw(comb), sample);
  if (t.pick_known) return t.pick;
  t.pick_known = true;
  SampleKey const& key = keys_[sample];
  int const m = drawn_teeth(comb);
  optics::Comb const& settings = stage_.combs[static_cast<std::size_t>(comb)];
  if (settings.follow == optics::Comb::Follow::Hero) {
    double const u = common_number(settings, key, first_offset);
    return t.pick = {std::min(static_cast<int>(u * m), m - 1), double(m)};
  }
  // A tenth of the probability for all alike: what the eye sees badly must not come with weights
  // without bound.
  auto const share = [&](double lambda_nm) {
    Vec3 const seen = stage_.bands().xyz_density(lambda_nm);
    return seen.x + seen.y + seen.z;
  };
  double total = 0;
  for (int i = 0; i < m; ++i) total += share(t.lambdas_nm[static_cast<std::size_t>(i)]);
  double const u = key.uniform(choice);
  double below = 0;
  for (int i = 0; i < m; ++i) {
    double const seen =
        total > 0 ? share(t.lambdas_nm[static_cast<std::size_t>(i)]) / total : 1.0 / m;
    double const probability = 0.1 / m + 0.9 * seen;
    below += probability;
    t.pick = {i, 1 / probability};
    if (u < below) break;
  }
  return t.pick;
}

double WaveTables::width_nm(int wave, double lambda_nm) const {
  optics::Bands const& bands = stage_.bands();
  return bands.width(bands.index_of(lambda_nm)) * bands.count() / drawn_teeth(wave % comb_count());
}

std::span<WaveTables::Spread const> WaveTables::spreads(int wave, std::size_t sample) {
  Table& t = drawn(wave, sample);
  if (t.spreads_known) return t.spreads;
  t.spreads_known = true;
  int const count = stage_.bands().count(), m = drawn_teeth(wave % comb_count());
  auto& received = received_;
  received.assign(static_cast<std::size_t>(count), 0.0);
  t.spreads.clear();
  for (int i = 0; i < m; ++i) {
    double const lambda_nm = t.lambdas_nm[static_cast<std::size_t>(i)];
    auto const hat = hats_->spread(lambda_nm);
    double const width = width_nm(wave, lambda_nm);
    Spread s{hat.lower, std::min(hat.lower + 1, count - 1), 0, 0};
    s.first_weight = (1 - hat.a) * width / hats_->mass(s.first);
    s.second_weight = hat.a * width / hats_->mass(s.second);
    received[static_cast<std::size_t>(s.first)] += s.first_weight;
    received[static_cast<std::size_t>(s.second)] += s.second_weight;
    t.spreads.push_back(s);
  }
  // With fewer teeth than bands some bands receive nothing: only the mean is right.
  if (m >= count)
    for (Spread& s : t.spreads) {
      if (s.first_weight != 0) s.first_weight /= received[static_cast<std::size_t>(s.first)];
      if (s.second_weight != 0) s.second_weight /= received[static_cast<std::size_t>(s.second)];
    }
  for (int c = count; c < stage_.channels; ++c) t.spreads.push_back({c, c, 1, 0});
  return t.spreads;
}

std::span<Vec3 const> WaveTables::rgb_weights(int wave, std::size_t sample) {
  Table& t = drawn(wave, sample);
  if (!t.weights_known) {
    t.rgb_weights.clear();
    int const m = drawn_teeth(wave % comb_count());
    for (int i = 0; i < m; ++i) {
      double const lambda_nm = t.lambdas_nm[static_cast<std::size_t>(i)];
      t.rgb_weights.push_back(width_nm(wave, lambda_nm) * stage_.bands().rgb_density(lambda_nm));
    }
    for (int c = stage_.bands().count(); c < stage_.channels; ++c)
      t.rgb_weights.push_back(stage_.rgb_weights[static_cast<std::size_t>(c)]);
    t.weights_known = true;
  }
  return t.rgb_weights;
}

} // namespace abbe::transport
