// SPDX-License-Identifier: MIT
#pragma once

#include "stages.hpp"
#include "transport/sample_film.hpp"

namespace abbe::transport::testing {

inline constexpr std::size_t samples = 3;

inline optics::Comb comb(Follow follow, int teeth = 0, Jitter jitter = Jitter::LowDiscrepancy) {
  return {teeth, jitter, 1, follow};
}

/// A stage with its film, in work on three samples.
struct Film {
  explicit Film(Stage made)
      : stage(std::move(made)), waves(stage, samples), film(stage, waves, samples) {
    waves.start_samples(sample_keys(samples));
    film.start_samples(samples);
  }
  Film(Film const&) = delete;
  Film& operator=(Film const&) = delete;
  /// What a sample comes to.
  Vec3 rgb(std::size_t sample) { return film.resolve(sample, waves, {}); }
  std::vector<double> bands(std::size_t sample) {
    std::vector<double> out(stage.film_bands());
    film.resolve(sample, waves, out);
    return out;
  }
  Stage stage;
  WaveTables waves;
  SampleFilm film;
};

/// Some light for each of so many slots: not alike.
inline double some(std::size_t number) {
  return 0.2 + RandomKey(7).uniform(number);
}

} // namespace abbe::transport::testing
