// SPDX-License-Identifier: MIT
#include "optics/glass.hpp"

#include "optics/bands.hpp"
#include "simd/math.hpp"

#include <fmt/format.h>

#include <cmath>

namespace abbe::optics {
namespace {

constexpr double pov_center_nm = 555;
constexpr double pov_span_nm = 350; // POV-Ray's 380..730

struct Evaluate {
  double lambda_nm;
  double operator()(ConstantIndex const& m) const { return m.n; }
  double operator()(GlassFormula const& m) const { return m.index(lambda_nm); }
  double operator()(TabulatedIndex const& m) const { return m.curve(lambda_nm / 1000); }
  double operator()(PovIndex const& m) const {
    return m.ior * simd::pow(m.dispersion, (pov_center_nm - lambda_nm) / pov_span_nm);
  }
};

} // namespace

double Glass::index_unchecked(double lambda_nm) const {
  return std::visit(Evaluate{lambda_nm}, model_);
}

Result<double> Glass::index(double lambda_nm) const {
  if (!range_.contains(lambda_nm))
    return Error{
        "E0412",
        fmt::format("the index of glass '{}' is known from {:.6g} to {:.6g} nm, not at {:.6g} nm",
                    full_name(), range_.lo_nm, range_.hi_nm, lambda_nm)};
  return index_unchecked(lambda_nm);
}

std::optional<Error> Glass::check_range(double lo_nm, double hi_nm) const {
  if (auto const* formula = std::get_if<GlassFormula>(&model_))
    for (double const pole : formula->poles_nm())
      if (pole >= lo_nm && pole <= hi_nm)
        return Error{"E0411",
                     fmt::format("the index of glass '{}' is infinite at {:.6g} nm, a pole of its "
                                 "formula within {:.6g}..{:.6g} nm",
                                 full_name(), pole, lo_nm, hi_nm)};
  // Away from poles the formulas are smooth; 512 points find any dip wider than 1/512 of the range.
  constexpr int steps = 512;
  for (int i = 0; i <= steps; ++i) {
    double const lambda = lo_nm + (hi_nm - lo_nm) * i / steps;
    double const n = index_unchecked(lambda);
    if (!(std::isfinite(n) && n > 0))
      return Error{
          "E0411",
          fmt::format("the index of glass '{}' would be {:.6g} at {:.6g} nm; it must be positive",
                      full_name(), n, lambda)};
  }
  return std::nullopt;
}

std::optional<double> Glass::nd() const {
  if (!range_.contains(d_line_nm)) return std::nullopt;
  return index_unchecked(d_line_nm);
}

std::optional<double> Glass::vd() const {
  if (!range_.contains(f_line_nm) || !range_.contains(c_line_nm)) return std::nullopt;
  double const spread = index_unchecked(f_line_nm) - index_unchecked(c_line_nm);
  if (spread == 0) return std::nullopt;
  return (index_unchecked(d_line_nm) - 1) / spread;
}

bool Glass::is_dispersive(double lo_nm, double hi_nm) const {
  constexpr int steps = 64;
  double const first = index_unchecked(lo_nm);
  for (int i = 1; i <= steps; ++i)
    if (index_unchecked(lo_nm + (hi_nm - lo_nm) * i / steps) != first) return true;
  return false;
}

double Glass::absorption_per_mm(double lambda_nm) const {
  return absorption_.empty() ? 0 : interpolate_linear(absorption_, lambda_nm);
}

GlassPtr Glass::without_absorption() const {
  auto clear = std::make_shared<Glass>(*this);
  clear->absorption_.clear();
  return clear;
}

} // namespace abbe::optics
