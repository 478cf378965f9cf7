// SPDX-License-Identifier: MIT
#pragma once

#include "optics/bands.hpp"

#include <variant>
#include <vector>

namespace abbe::optics {

/// How a material treats the wavelength dependence of its index.

/// The index at the d line for every wavelength.
struct NoDispersion {
  bool operator==(NoDispersion const&) const = default;
};
/// One ray per band, at the centre of the band.
struct DeterministicDispersion {
  bool operator==(DeterministicDispersion const&) const = default;
};
/// One ray per band at a jittered wavelength, its contribution spread to a neighbouring band.
struct StochasticDispersion {
  enum class Jitter { Uniform, Triangular };
  Jitter jitter = Jitter::Uniform;
  /// Whole extent of the jitter, in bands. Uniform 1 and triangular 2 (the hat itself) cover the
  /// range evenly, and so does any whole width: unbiased. Less samples the middle of each band
  /// only.
  double width_bands = 1;
  /// Jitter anew at the second dispersive interface, as published; else the ray keeps its
  /// wavelength.
  bool faithful = false;
  bool operator==(StochasticDispersion const&) const = default;
};
/// Append a mode here: every exhaustive std::visit then asks for it.
using Dispersion = std::variant<NoDispersion, DeterministicDispersion, StochasticDispersion>;

/// Offset xi in bands, within width/2 of 0, for u uniform in [0, 1).
double jitter_offset(StochasticDispersion const& mode, double u);

/// The hat functions phi_j on the centres of the bands, flat beyond the outer centres: a partition
/// of unity over the whole range. Light is written to bands (scatter) and read from them (gather)
/// with the same functions, which keeps white white and the light path symmetric.
/// @source research brief 1.3
class BandHats {
public:
  /// Keeps a reference to nothing: copies what it needs.
  explicit BandHats(Bands const& bands);

  /// Wavelength at offset xi (in bands) from the centre of band i: centre + xi width within the
  /// band, continuing with the widths of the neighbours, mirrored at the ends of the range. Always
  /// inside the range; mirroring keeps the coverage even there.
  double jittered(int i, double xi) const;

  /// Weights of a wavelength: 1 - a for band `lower`, a for band `lower + 1`. At the ends a = 0 (or
  /// lower is the last band).
  struct Spread {
    int lower;
    double a; ///< in [0, 1); 0 when there is no upper neighbour
  };
  Spread spread(double lambda_nm) const;

  /// w_j, the integral of phi_j over the range, nm. Their sum is the range.
  double mass(int j) const { return masses_[static_cast<std::size_t>(j)]; }

  /// Scatter: adds radiance L found by the ray of band i at lambda_nm to band values:
  /// P_j += (h_i / w_j) phi_j(lambda) L. In each sample sum_j w_j P_j = sum_i h_i L_i: energy is
  /// kept.
  void scatter(int i, double lambda_nm, double radiance, std::vector<double>& values) const;
  /// Gather: band data at a wavelength, sum_j phi_j(lambda) values_j.
  double gather(double lambda_nm, std::vector<double> const& values) const;
  /// What scatter gives for L = 1 when all bands jitter by the same xi: dividing by it makes flat
  /// light exactly flat in every sample, at the price of a bias of the order of the variance.
  std::vector<double> realised_weights(double xi) const;

private:
  std::vector<double> edges_, centers_, masses_;
};

} // namespace abbe::optics
