// SPDX-License-Identifier: MIT
#include "render/wave_tables.hpp"

#include "render/beam.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::render {

WaveTables::WaveTables(Stage const& stage) : stage_(stage), tables_(2 * stage.jitters.size()) {
  if (!stage.jitters.empty()) hats_.emplace(*stage.bands);
  for (auto& table : tables_) {
    table.indices_known.resize(stage.media.size());
    table.indices.resize(stage.media.size());
  }
}

double SampleKey::uniform(std::uint64_t dimension) const {
  constexpr double golden_step = 0.6180339887498949;
  double const value = pixel.uniform(dimension) + static_cast<double>(number) * golden_step;
  return value - std::floor(value);
}

void WaveTables::start_sample(SampleKey key) {
  key_ = key;
  for (auto& table : tables_) {
    table.lambdas_known = table.spreads_known = table.weights_known = false;
    table.indices_known.assign(table.indices_known.size(), false);
  }
}

double WaveTables::offset(int wave) const {
  bool const second = wave >= jitter_count();
  JitterSettings const& settings =
      stage_.jitters[static_cast<std::size_t>(second ? wave - jitter_count() : wave)];
  optics::StochasticDispersion mode;
  mode.jitter = settings.jitter == scene::DispersionMode::Jitter::Triangular
                    ? optics::StochasticDispersion::Jitter::Triangular
                    : optics::StochasticDispersion::Jitter::Uniform;
  mode.width_bands = settings.width_bands;
  return optics::jitter_offset(mode, key_.uniform(second ? 1 : 0));
}

std::span<double const> WaveTables::lambdas_nm(int wave) {
  if (wave == band_means) return stage_.bands->centers();
  Table& t = table(wave);
  if (!t.lambdas_known) {
    double const xi = offset(wave);
    t.lambdas_nm.clear();
    for (int i = 0; i < stage_.channels; ++i) t.lambdas_nm.push_back(hats_->jittered(i, xi));
    t.lambdas_known = true;
  }
  return t.lambdas_nm;
}

std::span<double const> WaveTables::indices(int medium, int wave) {
  Medium const& m = stage_.media[static_cast<std::size_t>(medium)];
  if (wave == band_means && m.dispersive) return m.index;
  if (!m.dispersive) return m.flat_index;
  Table& t = table(wave);
  auto const number = static_cast<std::size_t>(medium);
  if (!t.indices_known[number]) {
    auto& values = t.indices[number];
    values.clear();
    for (double const lambda_nm : lambdas_nm(wave))
      values.push_back(m.glass->index_unchecked(lambda_nm));
    t.indices_known[number] = true;
  }
  return t.indices[number];
}

std::span<WaveTables::Spread const> WaveTables::spreads(int wave) {
  Table& t = table(wave);
  if (!t.spreads_known) {
    auto const realised = hats_->realised_weights(offset(wave));
    auto const lambdas = lambdas_nm(wave);
    int const last = stage_.channels - 1;
    t.spreads.clear();
    for (int i = 0; i <= last; ++i) {
      auto const hat = hats_->spread(lambdas[static_cast<std::size_t>(i)]);
      int const upper = std::min(hat.lower + 1, last);
      double const width = stage_.bands->width(i);
      auto const weight = [&](int j, double part) {
        double const received = realised[static_cast<std::size_t>(j)];
        return part == 0 || received == 0 ? 0 : part * width / hats_->mass(j) / received;
      };
      t.spreads.push_back({hat.lower, upper, weight(hat.lower, 1 - hat.a), weight(upper, hat.a)});
    }
    t.spreads_known = true;
  }
  return t.spreads;
}

std::span<Vec3 const> WaveTables::rgb_weights(int wave) {
  Table& t = table(wave);
  if (!t.weights_known) {
    optics::Bands const& bands = *stage_.bands;
    t.rgb_weights.clear();
    for (double const lambda_nm : lambdas_nm(wave))
      t.rgb_weights.push_back(bands.width(bands.index_of(lambda_nm))
                              * bands.rgb_density(lambda_nm));
    t.weights_known = true;
  }
  return t.rgb_weights;
}

} // namespace abbe::render
