// SPDX-License-Identifier: MIT
#include "optics/glass_builder.hpp"

#include "optics/bands.hpp"

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
  return formula_result(GlassFormula::make(id, std::move(coefficients)));
}

GlassBuilder& GlassBuilder::sellmeier(std::span<double const> b, std::span<double const> c_um2) {
  if (b.size() != c_um2.size())
    return fail(
        fmt::format("sellmeier needs as many C as B, not {} B and {} C", b.size(), c_um2.size()));
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
  std::vector<double> coefficients{a[0]};
  for (std::size_t i = 1; i < a.size(); ++i) {
    coefficients.push_back(a[i]);
    coefficients.push_back(-2.0 * static_cast<double>(i));
  }
  return formula(5, std::move(coefficients));
}

GlassBuilder& GlassBuilder::abbe(double nd, double vd) {
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

GlassBuilder& GlassBuilder::transmittance(double thickness_mm, std::vector<Pair> um_tau) {
  if (!(thickness_mm > 0 && std::isfinite(thickness_mm)))
    return fail(fmt::format("transmittance needs a thickness in mm, not {}", thickness_mm));
  for (Pair& row : um_tau) {
    if (!(row[1] >= 0 && row[1] <= 1))
      return fail(fmt::format("an internal transmittance must lie in 0..1, not {}", row[1]));
    row = {row[0] * 1000, -std::log(std::max(row[1], printed_zero_transmittance)) / thickness_mm};
  }
  return absorption(std::move(um_tau));
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

} // namespace abbe::optics
