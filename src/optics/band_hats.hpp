// SPDX-License-Identifier: MIT
#pragma once

#include "optics/bands.hpp"

#include <vector>

namespace abbe::optics {

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
  /// Wavelength at a position in units of bands, 0 the lower end of the range; mirrored at both
  /// ends.
  double at(double position) const;

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

private:
  std::vector<double> edges_, centers_, masses_;
};

} // namespace abbe::optics
