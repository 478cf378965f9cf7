// SPDX-License-Identifier: MIT
#include "optics/conductor.hpp"

#include "optics/fresnel.hpp"
#include "optics/spectrum.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace abbe::optics {

Result<Conductor> Conductor::make(std::string name, std::vector<std::array<double, 3>> um_n_k) {
  auto const bad = [&](std::string_view what) {
    return Error{"E0418", fmt::format("metal '{}': {}", name, what)};
  };
  if (um_n_k.empty()) return bad("the table of n and k is empty");
  for (std::size_t i = 0; i < um_n_k.size(); ++i) {
    auto& row = um_n_k[i];
    row[0] *= 1000;
    if (!(row[0] > 0 && row[1] >= 0 && row[2] >= 0 && row[1] + row[2] > 0
          && std::isfinite(row[0] + row[1] + row[2])))
      return bad(
          fmt::format("[{}, {}, {}] is no wavelength with n and k", row[0] / 1000, row[1], row[2]));
    if (i > 0 && !(um_n_k[i - 1][0] < row[0])) return bad("wavelengths must increase");
  }
  Conductor metal;
  metal.name_ = std::move(name);
  metal.rows_ = std::move(um_n_k);
  return metal;
}

Conductor::Index Conductor::index(double lambda_nm) const {
  if (lambda_nm <= rows_.front()[0]) return {rows_.front()[1], rows_.front()[2]};
  if (lambda_nm >= rows_.back()[0]) return {rows_.back()[1], rows_.back()[2]};
  auto const above =
      std::upper_bound(rows_.begin(), rows_.end(), lambda_nm,
                       [](double l, std::array<double, 3> const& row) { return l < row[0]; });
  auto const& a = *(above - 1);
  auto const& b = *above;
  double const t = (lambda_nm - a[0]) / (b[0] - a[0]);
  return {a[1] + (b[1] - a[1]) * t, a[2] + (b[2] - a[2]) * t};
}

double Conductor::reflectance(double lambda_nm, double cos_i) const {
  Index const m = index(lambda_nm);
  return conductor_reflectance<double>(m.n, m.k, cos_i);
}

namespace {

std::vector<double> knots_of(std::vector<std::array<double, 3>> const& rows) {
  std::vector<double> knots;
  for (auto const& row : rows) knots.push_back(row[0]);
  return knots;
}

} // namespace

std::vector<double> Conductor::reflectance_bands(Bands const& bands, double cos_i) const {
  return mean_over_bands([&](double l) { return reflectance(l, cos_i); }, knots_of(rows_), bands);
}

Vec3 Conductor::reflectance_rgb(double cos_i) const {
  return rgb_under_d65([&](double l) { return reflectance(l, cos_i); }, knots_of(rows_));
}

} // namespace abbe::optics
