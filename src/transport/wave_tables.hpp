// SPDX-License-Identifier: MIT
#pragma once

#include "base/random.hpp"
#include "base/sobol.hpp"
#include "optics/band_hats.hpp"
#include "transport/rays.hpp"
#include "transport/stage.hpp"

#include <optional>
#include <span>
#include <vector>

namespace abbe::transport {

/// What the random numbers of a sample hang on: its pixel, and its number within it. The numbers of
/// a pixel's samples are spread evenly over the unit interval (steps by irrational numbers from a
/// random start), so that anti-aliasing averages the wavelengths too.
struct SampleKey {
  RandomKey pixel;
  std::uint64_t number = 0;
  std::int64_t x = 0, y = 0; ///< of the pixel
  RandomKey picture{};       ///< of all pixels
  /// Set: the numbers are those of these points, whose first two dimensions are the place in the
  /// pixel, so that place and wavelengths are stratified together.
  std::optional<PixelPoints> points{};
  std::uint64_t lens = 0; ///< the first of the lens's rays that are taken (Lens::group())
  double uniform(std::uint64_t dimension) const;
  /// Of this sample alone, not spread.
  double independent(std::uint64_t dimension) const;
  /// What has so many dimensions that uniform() has no irrational numbers for all of them:
  /// independent(), unless the sample has points.
  double many(std::uint64_t dimension) const {
    return points ? uniform(dimension) : independent(dimension);
  }
  /// As uniform(), from a start that neighbouring pixels have far apart.
  double blue() const;
};

/// The wavelengths of the camera samples in work and the indices of the glasses there, made on
/// first need. Tables of a sample: `band_means`, then for each comb its first draw, then for each
/// its second draw (used by the published scheme at the second refraction).
class WaveTables {
public:
  /// @param samples in work at a time, at most
  WaveTables(Stage const& stage, std::size_t samples);

  void start_samples(std::span<SampleKey const> keys);

  int first_draw(int comb) const { return comb; }
  int second_draw(int comb) const { return comb_count() + comb; }
  int comb_count() const { return static_cast<int>(stage_.combs.size()); }
  /// Number of wavelengths of a comb: those that it draws, then the emission lines.
  int teeth(int comb) const { return teeth_[static_cast<std::size_t>(comb)]; }
  int drawn_teeth(int comb) const;

  double lambda_nm(int wave, std::size_t sample, int tooth);
  /// Index of refraction of a medium there.
  double index(int medium, int wave, std::size_t sample, int tooth) {
    return indices(medium, wave, sample)[static_cast<std::size_t>(tooth)];
  }
  /// The same of all teeth of a sample.
  std::span<double const> indices(int medium, int wave, std::size_t sample);
  /// The channel of materials and lights in which each wavelength of a sample lies.
  std::span<std::uint16_t const> channels(int wave, std::size_t sample);

  /// The tooth of a comb that goes on alone in this sample, and 1 / its probability.
  struct Pick {
    int tooth = 0;
    double weight = 1;
  };
  /// Its number is among those of the sample. @pre the comb picks one
  Pick pick(int comb, std::size_t sample);

  /// Where the light of a tooth goes on the spectral film: the two channels between whose centres
  /// its wavelength falls. With a tooth a band or more, the weights are divided by what each band
  /// receives from the whole comb, so that a flat spectrum stays exactly flat.
  struct Spread {
    int first = 0;
    int second = 0;
    double first_weight = 1;
    double second_weight = 0;
  };
  std::span<Spread const> spreads(int wave, std::size_t sample);
  /// Colour of one unit of light at each wavelength of the draw: the colour-matching functions
  /// there times the width of its stratum. The mean of their sum over the draws is the white.
  std::span<Vec3 const> rgb_weights(int wave, std::size_t sample);

private:
  struct Table {
    bool lambdas_known = false, spreads_known = false, weights_known = false, pick_known = false;
    std::vector<double> lambdas_nm;
    std::vector<std::uint16_t> channels;
    std::vector<Spread> spreads;
    std::vector<Vec3> rgb_weights;
    Pick pick;
    std::vector<bool> indices_known;          // by medium
    std::vector<std::vector<double>> indices; // by medium
  };
  optics::Comb const& comb_of(int wave) const {
    return stage_.combs[static_cast<std::size_t>(wave % comb_count())];
  }
  /// With the wavelengths drawn.
  Table& drawn(int wave, std::size_t sample);
  void draw(int wave, SampleKey const& key, Table& out) const;
  /// The random number that all teeth of a comb share.
  double common_number(optics::Comb const& comb, SampleKey const& key,
                       std::uint64_t dimension) const;
  /// Offset of a tooth from the middle of its stratum, in strata.
  double offset(int wave, SampleKey const& key, int tooth) const;
  /// Width of a tooth's stratum at its wavelength, nm.
  double width_nm(int wave, double lambda_nm) const;

  Stage const& stage_;
  std::optional<optics::BandHats> hats_;
  std::vector<int> teeth_; ///< by comb
  std::vector<SampleKey> keys_;
  std::vector<Table> tables_;    ///< of the first sample, then of the next
  std::vector<double> received_; ///< scratch of spreads(), by band
};

} // namespace abbe::transport
