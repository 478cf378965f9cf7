// SPDX-License-Identifier: MIT
#pragma once

#include "base/result.hpp"
#include "base/vec.hpp"
#include "optics/bands.hpp"
#include "optics/interpolate.hpp"
#include "optics/peaks.hpp"

#include <functional>
#include <memory>
#include <vector>

namespace abbe::optics {

/// A function of wavelength that a scene gives: reflectance of a surface or power of a light.
/// Immutable, cheap to copy.
///
/// As a REFLECTANCE (or transmittance, or factor): constants and samples.
/// As a LIGHT, in units where luminance 1 is that of rgb (1,1,1):
/// - constant v: v times D65, that is rgb <v, v, v>;
/// - samples: spectral power. v = 1 everywhere is the equal-energy light of luminance 1;
/// - power tables (illuminants, lamps), blackbodies and emission lines: their shape only,
/// normalised
///   to luminance 1 over the wavelength range of the rendering;
/// each times scale().
class Spectrum {
public:
  static Spectrum constant(double value);
  /// Rows [nm, value], linear between, end values outside. @error E0415 not a table
  static Result<Spectrum> samples(std::vector<Pair> nm_value);
  /// Rows [nm, relative power] of an illuminant or lamp, linear between, nothing outside.
  /// @error E0415 not a table, negative, or no luminance
  static Result<Spectrum> power(std::vector<Pair> nm_power);
  /// Planck's law. @error E0415 temperature not positive
  /// @source CODATA 2018: c2 = hc/k = 1.438776877e-2 m K
  static Result<Spectrum> blackbody(double temperature_k);
  /// Emission lines [nm, energy], any order. @error E0415 none visible, or negative
  static Result<Spectrum> lines(std::vector<Pair> nm_energy);

  Spectrum scaled(double factor) const;
  double scale() const { return scale_; }
  /// Power tables, blackbodies and lines are lights and nothing else.
  bool is_light_only() const { return kind_ != Kind::Constant && kind_ != Kind::Samples; }

  /// Value of a reflectance at a wavelength; samples and constants only.
  double value(double lambda_nm) const;
  /// What `representation composite` tells apart: lines that were given as such, within the range
  /// of the bands, and peaks of a power table that are lines as far as these bands can tell
  /// (optics/peaks.hpp). `smooth` is the rest of a power table, and empty for any other spectrum.
  SplitTable split(Bands const& bands) const;
  /// Wavelengths at which a table has its rows.
  std::vector<double> knots() const;

private:
  friend std::vector<double> light_bands(Spectrum const&, Bands const&);
  friend Vec3 light_rgb(Spectrum const&);
  friend std::vector<double> light_beside_lines(Spectrum const&, Bands const&);
  friend std::vector<double> light_at_lines(Spectrum const&, Bands const&,
                                            std::vector<double> const&);
  enum class Kind { Constant, Samples, Power, Blackbody, Lines };
  Spectrum(Kind kind, double value, std::vector<Pair> rows);
  double power_at(double lambda_nm) const;
  /// XYZ of the light relative to white over the range of bands, not yet normalised.
  Vec3 raw_xyz(Bands const& bands) const;
  double raw_power(double a_nm, double b_nm) const;
  /// What raw_xyz().y and raw powers are multiplied with. 0 when the light is dark over the range.
  double unit(Bands const& bands, double raw_luminance) const;

  Kind kind_;
  double value_ = 0; ///< of a constant, or kelvin
  double scale_ = 1;
  std::shared_ptr<std::vector<Pair> const> rows_;
};

/// Band values relative to D65: mean power over the band / mean power of D65 over it, then one
/// common factor that makes the luminance exact, so that a light of luminance 1 has luminance 1 for
/// every n. A line goes to its band whole (energy); lines outside the range are left out.
std::vector<double> light_bands(Spectrum const& light, Bands const& bands);
/// light_bands of what is left of the light without Spectrum::split(bands).lines.
std::vector<double> light_beside_lines(Spectrum const& light, Bands const& bands);
/// Emission lines one by one: the power of each of the given lines, relative to that of D65 in one
/// nm there, in the units of light_bands. Lines that are not among Spectrum::split(bands).lines are
/// 0.
std::vector<double> light_at_lines(Spectrum const& light, Bands const& bands,
                                   std::vector<double> const& lines_nm);
/// Linear sRGB of the light, integrated over 360..830 nm (unclipped: may be negative).
Vec3 light_rgb(Spectrum const& light);

/// Mean over each band weighted with D65 (xbar + ybar + zbar): the mean that matters to a visible
/// light; a constant stays constant and values stay within their bounds.
/// @error E0415 a light is no reflectance
Result<std::vector<double>> reflectance_bands(Spectrum const& spectrum, Bands const& bands);
/// Linear sRGB of the reflectance under D65, 360..830 nm.
/// @error E0415 as above
Result<Vec3> reflectance_rgb(Spectrum const& spectrum);

/// The weighted mean behind reflectance_bands and the integral behind reflectance_rgb for any
/// function of wavelength that is smooth between whole nm and the given knots (sorted).
std::vector<double> mean_over_bands(std::function<double(double)> const& f,
                                    std::vector<double> const& knots, Bands const& bands);
Vec3 rgb_under_d65(std::function<double(double)> const& f, std::vector<double> const& knots);

} // namespace abbe::optics
