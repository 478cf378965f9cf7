// SPDX-License-Identifier: MIT
#include "optics/glass_builder.hpp"

#include "optics/bands.hpp"
#include "simd/math.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace abbe::optics {
namespace {

constexpr double default_lo_nm = 360;
constexpr double default_hi_nm = 830;
constexpr double printed_zero_transmittance = 0.0005;
constexpr double highest_index = 4; ///< that a clear material has in the visible
constexpr double printed_nd_error = 0.01;
constexpr double nm2_in_um2 = 1e6;
/// Wavelengths of so many um are no light: nm were meant.
constexpr double hardly_um = 100;

double um2(double nm) {
  return nm * nm * 1e-6;
}

} // namespace

GlassBuilder& GlassBuilder::fail(std::string message) {
  if (!error_) error_ = Error{"E0410", std::move(message)};
  return *this;
}

GlassBuilder& GlassBuilder::maker(std::string maker) {
  maker_ = std::move(maker);
  return *this;
}

GlassBuilder& GlassBuilder::model(IndexModel model) {
  if (model_) return fail("a glass has one description of its index, not two");
  model_ = std::move(model);
  return *this;
}

GlassBuilder& GlassBuilder::formula_result(Result<GlassFormula> formula) {
  if (!formula) return fail(formula.error().message);
  return model(std::move(*formula));
}

GlassBuilder& GlassBuilder::formula(int id, std::vector<double> coefficients) {
  if (id >= 1 && id <= 9 && !GlassFormula::whole(id, coefficients.size()))
    unfinished_ = fmt::format("formula {} does not end after {} coefficients: is one missing?", id,
                              coefficients.size());
  return formula_result(GlassFormula::make(id, std::move(coefficients)));
}

GlassBuilder& GlassBuilder::sellmeier(std::span<double const> b, std::span<double const> c_um2) {
  if (b.size() != c_um2.size())
    return fail(
        fmt::format("sellmeier needs as many C as B, not {} B and {} C", b.size(), c_um2.size()));
  if (std::any_of(c_um2.begin(), c_um2.end(), [](double c) { return c >= nm2_in_um2 / 1000; }))
    slip_ = "C is in um^2: is it in nm^2?";
  std::vector<double> coefficients{0};
  for (std::size_t i = 0; i < b.size(); ++i) {
    coefficients.push_back(b[i]);
    coefficients.push_back(c_um2[i]);
  }
  return formula(2, std::move(coefficients));
}

GlassBuilder& GlassBuilder::schott(std::span<double const> a) {
  if (a.empty()) return fail("schott needs coefficients");
  std::vector<double> coefficients{a[0]};
  for (std::size_t i = 1; i < a.size(); ++i) {
    coefficients.push_back(a[i]);
    coefficients.push_back(i == 1 ? 2.0 : -2.0 * static_cast<double>(i - 1));
  }
  return formula(3, std::move(coefficients));
}

GlassBuilder& GlassBuilder::cauchy(std::span<double const> a) {
  if (a.empty()) return fail("cauchy needs coefficients");
  if (a.size() > 1 && std::abs(a[1]) >= nm2_in_um2 / 10000)
    slip_ = "B is in um^2, C in um^4: are they in nm^2, nm^4?";
  std::vector<double> coefficients{a[0]};
  for (std::size_t i = 1; i < a.size(); ++i) {
    coefficients.push_back(a[i]);
    coefficients.push_back(-2.0 * static_cast<double>(i));
  }
  return formula(5, std::move(coefficients));
}

GlassBuilder& GlassBuilder::abbe(double nd, double vd) {
  if (vd >= 1 && vd <= highest_index && nd > highest_index) slip_ = "are nd and Vd swapped?";
  if (!(nd >= 1) || !(vd > 0))
    return fail(fmt::format("abbe needs nd >= 1 and Vd > 0, not {} and {}", nd, vd));
  double const b = (nd - 1) / (vd * (1 / um2(f_line_nm) - 1 / um2(c_line_nm)));
  return formula(5, {nd - b / um2(d_line_nm), b, -2});
}

GlassBuilder& GlassBuilder::pov(double ior, double dispersion) {
  if (!(ior > 0 && std::isfinite(ior)) || !(dispersion > 0 && std::isfinite(dispersion)))
    return fail(fmt::format("ior and dispersion must be positive, not {} and {}", ior, dispersion));
  return model(PovIndex{ior, dispersion});
}

GlassBuilder& GlassBuilder::constant(double n) {
  if (!(n > 0 && std::isfinite(n)))
    return fail(fmt::format("an index must be positive, not {}", n));
  return model(ConstantIndex{n});
}

GlassBuilder& GlassBuilder::samples(std::vector<Pair> um_n) {
  if (auto message = check_table(um_n); !message.empty()) return fail("samples: " + message);
  if (um_n.front()[0] <= 0) return fail("samples: wavelengths must be positive");
  return model(TabulatedIndex{MonotoneCubic(std::move(um_n))});
}

GlassBuilder& GlassBuilder::range_um(double lo, double hi) {
  if (!(lo > 0 && lo <= hi && std::isfinite(hi)))
    return fail(fmt::format("the range {}..{} um is not a range of wavelengths", lo, hi));
  range_ = Glass::Range{lo * 1000, hi * 1000};
  return *this;
}

GlassBuilder& GlassBuilder::absorption(std::vector<Pair> nm_per_mm) {
  if (auto message = check_table(nm_per_mm); !message.empty())
    return fail("absorption: " + message);
  if (nm_per_mm.front()[0] <= 0) return fail("absorption: wavelengths must be positive");
  if (!absorption_.empty()) return fail("a glass has one absorption table, not two");
  absorption_ = std::move(nm_per_mm);
  return *this;
}

GlassBuilder& GlassBuilder::transmittance(std::vector<Transmittance> const& rows) {
  double zero = printed_zero_transmittance;
  for (auto const& [um, tau, mm] : rows) {
    if (!(mm > 0 && std::isfinite(mm)))
      return fail(fmt::format("transmittance needs a thickness in mm, not {}", mm));
    if (!(tau >= 0 && tau <= 1))
      return fail(fmt::format("an internal transmittance must lie in 0..1, not {}{}", tau,
                              tau > 1 && tau <= 100 ? " (per cent?)" : ""));
    if (tau > 0) zero = std::min(zero, tau / 2);
  }
  std::vector<Pair> nm_per_mm;
  for (auto const& [um, tau, mm] : rows)
    nm_per_mm.push_back({um * 1000, -simd::log(tau > 0 ? tau : zero) / mm});
  return absorption(std::move(nm_per_mm));
}

GlassBuilder& GlassBuilder::transmittance(double thickness_mm, std::vector<Pair> const& um_tau) {
  std::vector<Transmittance> rows;
  for (Pair const& row : um_tau) rows.push_back({row[0], row[1], thickness_mm});
  return transmittance(rows);
}

GlassBuilder& GlassBuilder::extinction(std::vector<Pair> um_k) {
  for (Pair& row : um_k) {
    if (!(row[1] >= 0))
      return fail(fmt::format("an extinction coefficient must not be negative: {}", row[1]));
    row = {row[0] * 1000, 4 * std::numbers::pi * row[1] / row[0] * 1000};
  }
  return absorption(std::move(um_k));
}

GlassBuilder& GlassBuilder::clear() {
  absorption_.clear();
  return *this;
}

GlassBuilder& GlassBuilder::printed(double nd, double vd) {
  if (std::isfinite(nd)) nd_ = nd;
  if (std::isfinite(vd)) vd_ = vd;
  return *this;
}

GlassBuilder& GlassBuilder::status(std::string status) {
  status_ = std::move(status);
  return *this;
}

GlassBuilder& GlassBuilder::medium(std::string medium) {
  if (medium != "air" && medium != "vacuum")
    return fail(fmt::format("an index is relative to \"air\" or \"vacuum\", not \"{}\"", medium));
  medium_ = std::move(medium);
  return *this;
}

Result<GlassPtr> GlassBuilder::build() const {
  if (error_) return *error_;
  if (!model_) return Error{"E0410", fmt::format("glass '{}' says nothing about its index", name_)};
  Glass glass(*model_);
  glass.name_ = name_;
  glass.maker_ = maker_;
  glass.status_ = status_;
  glass.medium_ = medium_;
  glass.printed_nd_ = nd_;
  glass.printed_vd_ = vd_;
  glass.absorption_ = absorption_;
  bool const unlimited =
      std::holds_alternative<ConstantIndex>(*model_) || std::holds_alternative<PovIndex>(*model_);
  if (range_) {
    glass.range_ = *range_;
  } else if (unlimited) {
    double const infinity = std::numeric_limits<double>::infinity();
    glass.range_ = {0, infinity};
  } else if (auto const* table = std::get_if<TabulatedIndex>(&*model_)) {
    auto const& rows = table->curve.rows();
    glass.range_ = {rows.front()[0] * 1000, rows.back()[0] * 1000};
  } else {
    glass.range_ = {default_lo_nm, default_hi_nm};
  }
  double const lo = std::max(glass.range_.lo_nm, default_lo_nm);
  double const hi = std::min(glass.range_.hi_nm, default_hi_nm);
  // POV-Ray takes any positive ior: its own models keep that freedom.
  if (!unlimited && lo <= hi)
    if (auto error = glass.check_range(lo, hi)) return *error;
  return GlassPtr(std::make_shared<Glass const>(std::move(glass)));
}

std::string GlassBuilder::index_doubt(Glass const& glass) const {
  auto const range = glass.range_nm();
  double const lo = std::max(range.lo_nm, default_lo_nm);
  double const hi = std::min(range.hi_nm, default_hi_nm);
  if (std::holds_alternative<PovIndex>(glass.model()) || lo > hi) return {};
  double const middle = std::clamp(d_line_nm, lo, hi);
  for (double const lambda_nm : {middle, lo, hi}) {
    double const n = glass.index_unchecked(lambda_nm);
    // Steep formulas may pass the highest towards the ends of the visible.
    if (n >= 1 && (n <= highest_index || lambda_nm != middle)) continue;
    return fmt::format("the index of glass '{}' is {:.6g} at {:.6g} nm; no glass lies outside 1..4",
                       glass.full_name(), n, lambda_nm);
  }
  return {};
}

std::vector<std::string> GlassBuilder::doubts(Glass const& glass) const {
  std::vector<std::string> all;
  if (auto doubt = index_doubt(glass); !doubt.empty())
    all.push_back(slip_.empty() ? doubt : doubt + ": " + slip_);
  if (!unfinished_.empty()) all.push_back(unfinished_);
  auto const nd = glass.nd();
  if (nd && nd_ && *nd_ > 1 && std::abs(*nd - *nd_) > printed_nd_error)
    all.push_back(fmt::format("the index of glass '{}' is {:.6g} at the d line, but its nd says "
                              "{:.6g}: is a coefficient wrong?",
                              glass.full_name(), *nd, *nd_));
  auto const range = glass.range_nm();
  bool const visible = range.lo_nm <= default_hi_nm && range.hi_nm >= default_lo_nm;
  if (visible && !absorption_.empty()
      && (absorption_.front()[0] > default_hi_nm || absorption_.back()[0] < default_lo_nm)) {
    double const lo_um = absorption_.front()[0] / 1000;
    all.push_back(fmt::format("the absorption of glass '{}' is given from {:.6g} to {:.6g} um, for "
                              "no visible wavelength{}",
                              glass.full_name(), lo_um, absorption_.back()[0] / 1000,
                              lo_um >= hardly_um ? ": are these nm?" : ""));
  }
  return all;
}

} // namespace abbe::optics
