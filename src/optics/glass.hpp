// SPDX-License-Identifier: MIT
#pragma once

#include "base/result.hpp"
#include "optics/glass_formula.hpp"
#include "optics/interpolate.hpp"

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace abbe::optics {

/// The same index at every wavelength.
struct ConstantIndex {
  double n;
};
/// POV-Ray's `ior` with `dispersion`: n = ior * dispersion^((555 - lambda)/350), lambda in nm;
/// dispersion = n(violet) / n(red).
struct PovIndex {
  double ior, dispersion;
};
/// Rows [um, n], monotone cubic in between, end values outside.
struct TabulatedIndex {
  MonotoneCubic curve;
};
using IndexModel = std::variant<ConstantIndex, GlassFormula, TabulatedIndex, PovIndex>;

/// A clear material: refractive index and internal absorption against wavelength. Immutable; shared
/// by pointer. Made by GlassBuilder, which checks it.
///
/// Wavelengths: nm in standard air. Index: relative to air at the catalogue's temperature, as glass
/// catalogues give it (gases: relative to vacuum, see medium()).
class Glass {
public:
  std::string const& name() const { return name_; }   ///< "N-BK7"
  std::string const& maker() const { return maker_; } ///< "SCHOTT" or ""
  /// "SCHOTT/N-BK7", or the name alone.
  std::string full_name() const { return maker_.empty() ? name_ : maker_ + "/" + name_; }

  /// @return n at lambda_nm  @error E0412 outside range_nm: naming glass, wavelength and range
  Result<double> index(double lambda_nm) const;
  /// The same without the check. Outside range_nm formulas extrapolate (plausible for the
  /// catalogue, whose rows were checked to stay smooth over 360..830 nm; else see check_range) and
  /// tables hold.
  double index_unchecked(double lambda_nm) const;

  struct Range {
    double lo_nm, hi_nm;
    bool contains(double lambda_nm) const { return lambda_nm >= lo_nm && lambda_nm <= hi_nm; }
  };
  /// Where the index data is valid as stated by its source; unlimited for constants and POV-Ray's
  /// model.
  Range range_nm() const { return range_; }
  /// Is the index finite, positive and free of poles all over [lo, hi]? Range not considered.
  /// @error E0411 says where it is not
  std::optional<Error> check_range(double lo_nm, double hi_nm) const;

  /// Index at the d line and Abbe number (nd - 1)/(nF - nC); nothing when the range misses the
  /// lines, no Vd either when nF = nC.
  std::optional<double> nd() const;
  std::optional<double> vd() const;
  /// The values printed by the source, where it prints them.
  std::optional<double> printed_nd() const { return printed_nd_; }
  std::optional<double> printed_vd() const { return printed_vd_; }

  /// Does the index change at all between the two wavelengths? Exact: constants say no.
  bool is_dispersive(double lo_nm, double hi_nm) const;
  IndexModel const& model() const { return model_; }

  /// Internal absorption coefficient per mm: intensity falls as exp(-alpha d). Linear between the
  /// rows of the table, end values outside, 0 without a table.
  double absorption_per_mm(double lambda_nm) const;
  bool absorbs() const { return !absorption_.empty(); }
  /// This glass, perfectly clear (itself when it is).
  std::shared_ptr<Glass const> without_absorption() const;

  std::string const& status() const { return status_; } ///< "preferred", "obsolete" or ""
  std::string const& medium() const {
    return medium_;
  } ///< what n is relative to: "air" or "vacuum"

private:
  friend class GlassBuilder;
  explicit Glass(IndexModel model) : model_(std::move(model)) {}
  std::string name_, maker_, status_, medium_ = "air";
  IndexModel model_;
  Range range_{};
  std::optional<double> printed_nd_, printed_vd_;
  std::vector<Pair> absorption_; ///< [nm, 1/mm]
};

using GlassPtr = std::shared_ptr<Glass const>;

} // namespace abbe::optics
