// SPDX-License-Identifier: MIT
#pragma once

#include "optics/glass_builder.hpp"
#include "transport/stage.hpp"
#include "transport/wave_tables.hpp"

#include <utility>
#include <vector>

/// Stages put together by hand: as much of one as a part of the transport asks for.
namespace abbe::transport::testing {

/// Bands, and lines behind them, with the combs of its media. Air is the only medium.
inline Stage spectral_stage(optics::Bands bands, std::vector<optics::Comb> combs = {},
                            std::vector<double> lines_nm = {}) {
  Stage stage;
  stage.spectral = optics::ChannelSet{std::move(bands), {}, {}, std::move(lines_nm)};
  stage.channels = stage.spectral->count();
  for (int c = 0; c < stage.channels; ++c) {
    stage.rgb_weights.push_back(stage.spectral->rgb_weight(c));
    stage.lambdas_nm.push_back(stage.spectral->lambda_nm(c));
  }
  stage.combs = std::move(combs);
  stage.media.emplace_back();
  return stage;
}

/// Red, green and blue.
inline Stage rgb_stage() {
  Stage stage;
  stage.rgb_weights = {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  stage.media.emplace_back();
  return stage;
}

inline optics::Bands even_bands(int count, double low_nm = 380, double high_nm = 780) {
  auto bands = optics::Bands::uniform(count, low_nm, high_nm);
  ABBE_ASSERT(bands);
  return *bands;
}
/// Bands of different widths.
inline optics::Bands uneven_bands() {
  auto bands = optics::Bands::from_edges({400, 440, 520, 530, 600, 700});
  ABBE_ASSERT(bands);
  return *bands;
}

/// A glass of Abbe number 30.
inline void add_glass(Stage& stage, double nd = 1.6) {
  auto glass = optics::GlassBuilder("of a test").abbe(nd, 30).build();
  ABBE_ASSERT(glass);
  Medium medium;
  medium.index_d = nd;
  medium.glass = glass->get();
  medium.dispersive = true;
  stage.glasses.push_back(*glass);
  for (double const lambda_nm : stage.lambdas_nm)
    medium.index.push_back(medium.glass->index_unchecked(lambda_nm));
  stage.media.push_back(std::move(medium));
}

/// Of so many samples of one pixel.
inline std::vector<SampleKey> sample_keys(std::size_t count, std::uint64_t pixel = 0) {
  std::vector<SampleKey> keys;
  for (std::size_t n = 0; n < count; ++n)
    keys.push_back(
        {RandomKey(3).child(pixel), n, static_cast<std::int64_t>(pixel), 5, RandomKey(3)});
  return keys;
}

using Jitter = optics::Comb::Jitter;
using Follow = optics::Comb::Follow;

} // namespace abbe::transport::testing
