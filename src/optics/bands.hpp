// SPDX-License-Identifier: MIT
#pragma once

#include "base/result.hpp"
#include "base/vec.hpp"

#include <span>
#include <vector>

namespace abbe::optics {

/// Line of helium d, hydrogen F and C, nm in air: nd is the index at d, Vd = (nd - 1) / (nF - nC).
inline constexpr double d_line_nm = 587.5618;
inline constexpr double f_line_nm = 486.1327;
inline constexpr double c_line_nm = 656.2725;

/// The wavelength bands of a rendering and what each is worth as colour.
///
/// Band values of light are stored RELATIVE TO D65: 1 in every band is light with the spectral
/// power of D65, luminance 1, linear sRGB (1,1,1). The colour of band values v is sum_i v[i]
/// rgb_weight(i). The weights are integrals over the bands of cmf * D65 (products at 1 nm, linear
/// in between, partial nanometres included), scaled per component of XYZ so that the flat spectrum
/// is exactly white for every n and every range: truncating the range does not tint white.
/// Wavelengths are nm in standard air throughout abbe::optics.
class Bands {
public:
  static constexpr int max_count = 1000;

  /// n equal bands. @error E0416 n outside 1..1000, range outside [360, 830] or empty
  static Result<Bands> uniform(int n, double lo_nm = 380, double hi_nm = 780);
  /// Edges at the quantiles of 0.7 (xbar+ybar+zbar)/S + 0.3/range: narrow bands where the eye
  /// looks.
  /// @error E0416 as above   @source after R. Hall, IEEE CG&A 19(4), 1999
  static Result<Bands> hall(int n, double lo_nm = 380, double hi_nm = 780);
  /// n + 1 increasing edges. @error E0416
  static Result<Bands> from_edges(std::vector<double> edges_nm);

  int count() const { return static_cast<int>(centers_.size()); }
  double lo_nm() const { return edges_.front(); }
  double hi_nm() const { return edges_.back(); }
  std::span<double const> edges() const { return edges_; }
  std::span<double const> centers() const { return centers_; }
  double edge(int i) const { return edges_[static_cast<std::size_t>(i)]; }
  double center(int i) const { return centers_[static_cast<std::size_t>(i)]; }
  double width(int i) const { return edge(i + 1) - edge(i); }
  bool is_uniform() const { return uniform_; }
  bool contains(double lambda_nm) const { return lambda_nm >= lo_nm() && lambda_nm <= hi_nm(); }
  /// The band i with edge(i) <= lambda < edge(i+1); the last band owns its upper edge; wavelengths
  /// outside the range give the first or last band.
  int index_of(double lambda_nm) const;

  Vec3 const& xyz_weight(int i) const { return xyz_weights_[static_cast<std::size_t>(i)]; }
  Vec3 const& rgb_weight(int i) const { return rgb_weights_[static_cast<std::size_t>(i)]; }
  std::span<Vec3 const> rgb_weights() const { return rgb_weights_; }
  /// Colour of band values (relative to D65), linear sRGB.
  Vec3 rgb(std::span<double const> values) const;
  Vec3 xyz(std::span<double const> values) const;

  /// d(XYZ)/d(lambda) and d(rgb)/d(lambda) of light with value 1, per nm; 0 outside the range.
  /// Their integrals over band i are the weights, and over the range white.
  Vec3 xyz_density(double lambda_nm) const;
  Vec3 rgb_density(double lambda_nm) const;
  /// Integral of the density from lo_nm to lambda (clamped to the range).
  Vec3 xyz_cumulative(double lambda_nm) const;
  Vec3 rgb_cumulative(double lambda_nm) const;

  /// Mean power of D65 in the band on the CIE scale (100 at 560 nm): band value * d65_power is
  /// relative spectral power.
  double d65_power(int i) const { return d65_powers_[static_cast<std::size_t>(i)]; }
  /// Spectral radiance in W m^-2 sr^-1 nm^-1 that a band value of 1 stands for if luminance 1 is 1
  /// cd/m^2.
  double d65_radiance(int i) const { return d65_power(i) * radiance_scale_; }

  bool operator==(Bands const& other) const { return edges_ == other.edges_; }

private:
  Bands(std::vector<double> edges_nm, bool uniform);
  std::vector<double> edges_;
  std::vector<double> centers_;
  std::vector<Vec3> xyz_weights_;
  std::vector<Vec3> rgb_weights_;
  std::vector<double> d65_powers_;
  Vec3 scale_{};  ///< from raw cmf * D65 to XYZ, per component
  Vec3 origin_{}; ///< raw cumulative at lo_nm
  double radiance_scale_ = 0;
  bool uniform_ = false;
};

/// Power of D65 at a wavelength, 100 at 560 nm; linear in the 5 nm table, 0 outside 360..830 nm.
double d65_power_at(double lambda_nm);
/// xbar, ybar, zbar of the CIE 1931 observer, linear in the 1 nm table, 0 outside.
Vec3 cie_observer(double lambda_nm);

} // namespace abbe::optics
