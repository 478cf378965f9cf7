// SPDX-License-Identifier: MIT
#pragma once

#include "base/result.hpp"

#include <vector>

namespace abbe::optics {

/// A dispersion formula of the refractiveindex.info database with its coefficients c1, c2, ..
/// w is the wavelength in micrometres (in air for catalogue glasses); missing coefficients are 0:
///   1  n^2 = 1 + c1 + sum c(i) w^2/(w^2 - c(i+1)^2)        i = 2, 4, 6, ..   (Sellmeier)
///   2  n^2 = 1 + c1 + sum c(i) w^2/(w^2 - c(i+1))                            (Sellmeier, C not
///   squared) 3  n^2 = c1 + sum c(i) w^c(i+1)                                          (polynomial;
///   Schott) 4  n^2 = c1 + c2 w^c3/(w^2 - c4^c5) + c6 w^c7/(w^2 - c8^c9) + sum c(i) w^c(i+1), i =
///   10, 12, .. 5  n   = c1 + sum c(i) w^c(i+1)                                          (Cauchy)
///   6  n   = 1 + c1 + sum c(i)/(c(i+1) - w^-2)                               (gases)
///   7  n   = c1 + c2 L + c3 L^2 + c4 w^2 + c5 w^4 + c6 w^6,  L = 1/(w^2 - 0.028)   (Herzberger)
///   8  (n^2-1)/(n^2+2) = c1 + c2 w^2/(w^2 - c3) + c4 w^2                     (retro)
///   9  n^2 = c1 + c2/(w^2 - c3) + c4 (w - c5)/((w - c5)^2 + c6)              (exotic)
/// Sellmeier terms are evaluated as B + B C/(w^2 - C), and formula 6 keeps n - 1 apart to the end.
/// @source M. N. Polyanskiy, Sci. Data 11, 94 (2024), "Dispersion formulas"
class GlassFormula {
public:
  /// @error E0410 unknown formula number, too many coefficients, or one that is not finite
  static Result<GlassFormula> make(int id, std::vector<double> coefficients);

  /// May formula `id` end after so many coefficients, or does a term lack some?
  static bool whole(int id, std::size_t coefficients);

  /// n at a wavelength in nm. Pure arithmetic: extrapolates, and is NaN where n^2 < 0.
  double index(double lambda_nm) const;
  /// Wavelengths in nm at which a term is infinite (terms of weight 0 apart).
  std::vector<double> poles_nm() const;

  int id() const { return id_; }
  std::vector<double> const& coefficients() const { return c_; }
  bool operator==(GlassFormula const&) const = default;

private:
  GlassFormula(int id, std::vector<double> coefficients);
  double c(std::size_t i) const { return i <= c_.size() ? c_[i - 1] : 0; }
  double sellmeier(double w2) const;
  double polynomial(double w, std::size_t first) const;
  double formula_4(double w) const;
  double herzberger(double w2) const;
  double retro(double w2) const;
  double exotic(double w) const;

  int id_;
  std::vector<double> c_;
  /// Formulas 1, 2: constant 1 + c1 + sum B, then B C and C of each term.
  double constant_ = 0;
  struct Term {
    double bc, c;
  };
  std::vector<Term> terms_;
};

} // namespace abbe::optics
