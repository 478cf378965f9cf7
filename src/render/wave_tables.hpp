// SPDX-License-Identifier: MIT
#pragma once

#include "base/random.hpp"
#include "optics/dispersion.hpp"
#include "render/stage.hpp"

#include <span>
#include <vector>

namespace abbe::render {

/// What the random numbers of a sample hang on: its pixel, and its number within it. The numbers of
/// a pixel's samples are spread evenly over the unit interval (golden ratio steps from a random
/// start), so that anti-aliasing averages the wavelengths too.
struct SampleKey {
  RandomKey pixel;
  std::uint64_t number = 0;
  double uniform(std::uint64_t dimension) const;
};

/// The wavelengths of one camera sample and the indices of the glasses there, made on first need.
///
/// All bands of a sample are jittered by one common offset (a comb): interior bands then add up
/// exactly (research brief 1.3). Tables: `band_means`, then for each stochastic setting its first
/// draw, then for each its second draw (used by the published scheme at the second refraction).
class WaveTables {
public:
  explicit WaveTables(Stage const& stage);

  void start_sample(SampleKey key);

  int first_draw(int jitter) const { return jitter; }
  int second_draw(int jitter) const { return jitter_count() + jitter; }
  int jitter_count() const { return static_cast<int>(stage_.jitters.size()); }

  std::span<double const> lambdas_nm(int wave);
  /// Index of refraction of a medium at each wavelength of a table.
  std::span<double const> indices(int medium, int wave);

  /// Where the light of band i goes on the spectral film under a draw: the two bands between whose
  /// centres its wavelength falls. The weights are divided by what each band receives from the
  /// whole comb, so that a flat spectrum stays exactly flat.
  struct Spread {
    int first = 0;
    int second = 0;
    double first_weight = 1;
    double second_weight = 0;
  };
  std::span<Spread const> spreads(int wave);
  /// Colour of one unit of light at each wavelength of the draw: the colour-matching functions
  /// there times the width of the band there. The mean over the draws is the band's colour.
  std::span<Vec3 const> rgb_weights(int wave);

private:
  struct Table {
    bool lambdas_known = false, spreads_known = false, weights_known = false;
    std::vector<double> lambdas_nm;
    std::vector<Spread> spreads;
    std::vector<Vec3> rgb_weights;
    std::vector<bool> indices_known;          // by medium
    std::vector<std::vector<double>> indices; // by medium
  };
  Table& table(int wave) { return tables_[static_cast<std::size_t>(wave)]; }
  /// Offset from the centre of every band, in bands.
  double offset(int wave) const;

  Stage const& stage_;
  std::optional<optics::BandHats> hats_;
  SampleKey key_;
  std::vector<Table> tables_;
};

} // namespace abbe::render
