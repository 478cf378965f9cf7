// SPDX-License-Identifier: MIT
#pragma once

#include "base/result.hpp"
#include "base/vec.hpp"
#include "optics/bands.hpp"

#include <array>
#include <string>
#include <vector>

namespace abbe::optics {

/// A metal: complex refractive index n + i k against wavelength, from a table, linear in between;
/// the end values hold outside (the tables of stdlib/spectra/metals.inc cover 360..830 nm).
/// Immutable.
class Conductor {
public:
  /// Rows [um, n, k]. @error E0418 empty, unordered, negative or not finite
  static Result<Conductor> make(std::string name, std::vector<std::array<double, 3>> um_n_k);

  std::string const& name() const { return name_; }
  struct Index {
    double n, k;
  };
  Index index(double lambda_nm) const;
  /// Fresnel reflectance of unpolarised light in air at the angle of incidence with this cosine.
  double reflectance(double lambda_nm, double cos_i) const;
  /// The same for each band (D65-weighted mean over the band at 1 nm) and as linear rgb under D65.
  std::vector<double> reflectance_bands(Bands const& bands, double cos_i) const;
  Vec3 reflectance_rgb(double cos_i) const;

private:
  Conductor() = default;
  std::string name_;
  std::vector<std::array<double, 3>> rows_;
};

} // namespace abbe::optics
