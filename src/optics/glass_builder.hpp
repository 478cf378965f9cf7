// SPDX-License-Identifier: MIT
#pragma once

#include "optics/glass.hpp"

#include <span>

namespace abbe::optics {

/// Makes a Glass piece by piece, in any order, and checks it in build(). `lang` drives it from
/// `glass { .. }` and `glass_entry "maker/name" { .. }`, the AGF reader from its lines.
/// The first mistake is kept and returned by build().
class GlassBuilder {
public:
  /// A name with its maker ("SCHOTT/N-BK7") may also be given whole; maker() then stays unused.
  explicit GlassBuilder(std::string name) : name_(std::move(name)) {}
  GlassBuilder& maker(std::string maker);

  // Exactly one model of the index.
  GlassBuilder& formula(int id, std::vector<double> coefficients);
  /// n^2 = 1 + sum B w^2/(w^2 - C), C in um^2. As many B as C.
  GlassBuilder& sellmeier(std::span<double const> b, std::span<double const> c_um2);
  /// n^2 = a0 + a1 w^2 + a2 w^-2 + a3 w^-4 + a4 w^-6 + a5 w^-8 ..
  GlassBuilder& schott(std::span<double const> a);
  /// n = A + B w^-2 + C w^-4 + ..
  GlassBuilder& cauchy(std::span<double const> a);
  /// Index at d and Abbe number: n = A + B w^-2 through both. vd > 0; infinity means no dispersion.
  GlassBuilder& abbe(double nd, double vd);
  /// POV-Ray's ior and dispersion. @see PovIndex
  GlassBuilder& pov(double ior, double dispersion);
  GlassBuilder& constant(double n);
  /// Rows [um, n], wavelengths increasing.
  GlassBuilder& samples(std::vector<Pair> um_n);

  /// Where the index holds, um. Default: 0.36..0.83 for formulas, the table's extent for samples.
  GlassBuilder& range_um(double lo, double hi);
  /// Internal transmittance (no reflection losses) of a thickness, 0 <= tau <= 1. A printed 0,
  /// which has no logarithm, is read as 0.0005, half the last digit of catalogues, but as no more
  /// than half the smallest value of the table that is not 0.
  struct Transmittance {
    double um, tau, mm;
  };
  GlassBuilder& transmittance(std::vector<Transmittance> const& rows);
  GlassBuilder& transmittance(double thickness_mm, std::vector<Pair> const& um_tau);
  /// Extinction coefficient, rows [um, k]: alpha = 4 pi k / lambda.
  GlassBuilder& extinction(std::vector<Pair> um_k);
  /// Drops the absorption given so far.
  GlassBuilder& clear();

  GlassBuilder& printed(double nd, double vd); ///< NaN: not printed
  GlassBuilder& status(std::string status);
  GlassBuilder& medium(std::string medium); ///< "air" or "vacuum"

  /// @error E0410 bad or missing definition; E0411 a pole or no positive index within the range and
  /// [360, 830] nm
  Result<GlassPtr> build() const;
  /// What makes a built glass hardly the one that was meant, each with the likely slip: an index
  /// outside 1..4, a printed nd that is another, coefficients of an unfinished term, absorption
  /// that is given for no visible wavelength.
  std::vector<std::string> doubts(Glass const&) const;

private:
  GlassBuilder& model(IndexModel model);
  GlassBuilder& formula_result(Result<GlassFormula> formula);
  GlassBuilder& fail(std::string message);
  GlassBuilder& absorption(std::vector<Pair> nm_per_mm);
  std::string index_doubt(Glass const&) const;

  std::string name_, maker_, status_, medium_ = "air";
  std::optional<IndexModel> model_;
  std::optional<Glass::Range> range_;
  std::optional<double> nd_, vd_;
  std::vector<Pair> absorption_;
  std::optional<Error> error_;
  std::string slip_;       ///< what explains an index that no glass has
  std::string unfinished_; ///< a term of a formula that lacks coefficients
};

} // namespace abbe::optics
