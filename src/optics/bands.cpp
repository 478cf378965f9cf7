// SPDX-License-Identifier: MIT
#include "optics/bands.hpp"

#include "optics/cie_table.hpp"
#include "optics/color.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace abbe::optics {
namespace {

constexpr double first_nm = cie_first_nm;
constexpr double last_nm = cie_last_nm;

/// A quantity given at 1 nm nodes and linear in between, with its exact integral.
template <class T>
struct NodeTable {
  std::vector<T> value;
  std::vector<T> integral; ///< from 360 nm to the node

  void integrate() {
    integral.assign(value.size(), T(0));
    for (std::size_t i = 1; i < value.size(); ++i)
      integral[i] = integral[i - 1] + (value[i - 1] + value[i]) * 0.5;
  }
  T at(double lambda_nm) const {
    auto const [i, t] = cell(lambda_nm);
    return value[i] + (value[i + 1] - value[i]) * t;
  }
  T cumulative(double lambda_nm) const {
    auto const [i, t] = cell(lambda_nm);
    return integral[i] + (value[i] + (value[i + 1] - value[i]) * (0.5 * t)) * t;
  }

private:
  static std::pair<std::size_t, double> cell(double lambda_nm) {
    double const x = std::clamp(lambda_nm, first_nm, last_nm) - first_nm;
    std::size_t const i = std::min(static_cast<std::size_t>(x), std::size_t{cie_count - 2});
    return {i, x - static_cast<double>(i)};
  }
};

struct Tables {
  NodeTable<Vec3> observer;
  NodeTable<double> d65;
  NodeTable<Vec3> white; ///< observer * D65 at the nodes
  NodeTable<double> sum; ///< xbar + ybar + zbar
};

Tables const& tables() {
  static Tables const result = [] {
    Tables t;
    for (int i = 0; i < cie_count; ++i) {
      auto const& row = cie_1931_observer[static_cast<std::size_t>(i)];
      Vec3 const cmf(row[0], row[1], row[2]);
      std::size_t const k = static_cast<std::size_t>(std::min(i / d65_step_nm, d65_count - 2));
      double const f = (i - static_cast<int>(k) * d65_step_nm) / double{d65_step_nm};
      double const power = cie_d65[k] + (cie_d65[k + 1] - cie_d65[k]) * f;
      t.observer.value.push_back(cmf);
      t.d65.value.push_back(power);
      t.white.value.push_back(cmf * power);
      t.sum.value.push_back(cmf.x + cmf.y + cmf.z);
    }
    t.d65.integrate();
    t.white.integrate();
    t.sum.integrate();
    return t;
  }();
  return result;
}

bool in_table(double lambda_nm) {
  return lambda_nm >= first_nm && lambda_nm <= last_nm;
}

Result<Bands> bad(std::string message) {
  return Error{"E0416", std::move(message)};
}

std::string check_request(int n, double lo_nm, double hi_nm) {
  if (n < 1 || n > Bands::max_count)
    return fmt::format("the number of bands must lie in 1..{}, not {}", Bands::max_count, n);
  if (!(lo_nm >= first_nm && hi_nm <= last_nm && lo_nm < hi_nm))
    return fmt::format(
        "the wavelength range {}..{} nm must lie within {}..{} nm and not be empty{}", lo_nm, hi_nm,
        cie_first_nm, cie_last_nm, lo_nm > 0 && hi_nm <= 100 ? ": is it in um?" : "");
  return {};
}

/// Where the increasing function f reaches target in [a, b]: bisection down to neighbouring
/// doubles.
template <class F>
double bisect(F const& f, double target, double a, double b) {
  for (;;) {
    double const middle = a + (b - a) / 2;
    if (!(middle > a && middle < b)) return b;
    (f(middle) < target ? a : b) = middle;
  }
}

} // namespace

Bands::Bands(std::vector<double> edges_nm, bool uniform)
    : edges_(std::move(edges_nm)), uniform_(uniform) {
  Tables const& t = tables();
  origin_ = t.white.cumulative(lo_nm());
  Vec3 const total = t.white.cumulative(hi_nm()) - origin_;
  scale_ = srgb_white_xyz / total;
  double const lumens_per_watt = 683.002;
  radiance_scale_ = 1 / (lumens_per_watt * total.y);
  for (std::size_t i = 0; i + 1 < edges_.size(); ++i) {
    double const a = edges_[i];
    double const b = edges_[i + 1];
    centers_.push_back(a + (b - a) / 2);
    xyz_weights_.push_back(xyz_cumulative(b) - xyz_cumulative(a));
    rgb_weights_.push_back(xyz_to_rgb(xyz_weights_.back()));
    d65_powers_.push_back((t.d65.cumulative(b) - t.d65.cumulative(a)) / (b - a));
  }
}

Result<Bands> Bands::uniform(int n, double lo_nm, double hi_nm) {
  if (auto message = check_request(n, lo_nm, hi_nm); !message.empty())
    return bad(std::move(message));
  std::vector<double> edges;
  for (int i = 0; i <= n; ++i) edges.push_back(lo_nm + (hi_nm - lo_nm) * i / n);
  edges.back() = hi_nm;
  return Bands(std::move(edges), true);
}

Result<Bands> Bands::hall(int n, double lo_nm, double hi_nm) {
  if (auto message = check_request(n, lo_nm, hi_nm); !message.empty())
    return bad(std::move(message));
  auto const& sum = tables().sum;
  double const start = sum.cumulative(lo_nm);
  double const total = sum.cumulative(hi_nm) - start;
  auto const cdf = [&](double l) {
    return 0.7 * ((sum.cumulative(l) - start) / total) + 0.3 * ((l - lo_nm) / (hi_nm - lo_nm));
  };
  std::vector<double> edges{lo_nm};
  for (int i = 1; i < n; ++i)
    edges.push_back(bisect(cdf, static_cast<double>(i) / n, edges.back(), hi_nm));
  edges.push_back(hi_nm);
  return Bands(std::move(edges), n == 1);
}

Result<Bands> Bands::from_edges(std::vector<double> edges_nm) {
  if (edges_nm.size() < 2) return bad("band boundaries need at least two wavelengths");
  int const n = static_cast<int>(edges_nm.size()) - 1;
  if (auto message = check_request(n, edges_nm.front(), edges_nm.back()); !message.empty())
    return bad(std::move(message));
  for (std::size_t i = 1; i < edges_nm.size(); ++i)
    if (!(edges_nm[i - 1] < edges_nm[i]))
      return bad(fmt::format("band boundaries must increase: {} nm does not follow {} nm",
                             edges_nm[i], edges_nm[i - 1]));
  return Bands(std::move(edges_nm), n == 1);
}

int Bands::index_of(double lambda_nm) const {
  if (uniform_) {
    int const n = count();
    double const x = (lambda_nm - lo_nm()) / (hi_nm() - lo_nm()) * n;
    int i = x >= n ? n - 1 : (x > 0 ? static_cast<int>(x) : 0);
    // The quotient is rounded: the edges decide.
    if (i > 0 && lambda_nm < edge(i)) --i;
    if (i + 1 < n && lambda_nm >= edge(i + 1)) ++i;
    return i;
  }
  auto const upper = std::upper_bound(edges_.begin() + 1, edges_.end() - 1, lambda_nm);
  return static_cast<int>(upper - edges_.begin()) - 1;
}

Vec3 Bands::rgb(std::span<double const> values) const {
  ABBE_ASSERT(values.size() == rgb_weights_.size());
  Vec3 sum(0);
  for (std::size_t i = 0; i < values.size(); ++i) sum += rgb_weights_[i] * values[i];
  return sum;
}

Vec3 Bands::xyz(std::span<double const> values) const {
  ABBE_ASSERT(values.size() == xyz_weights_.size());
  Vec3 sum(0);
  for (std::size_t i = 0; i < values.size(); ++i) sum += xyz_weights_[i] * values[i];
  return sum;
}

Vec3 Bands::xyz_density(double lambda_nm) const {
  return contains(lambda_nm) ? tables().white.at(lambda_nm) * scale_ : Vec3(0);
}

Vec3 Bands::rgb_density(double lambda_nm) const {
  return xyz_to_rgb(xyz_density(lambda_nm));
}

Vec3 Bands::xyz_cumulative(double lambda_nm) const {
  double const l = std::clamp(lambda_nm, lo_nm(), hi_nm());
  return (tables().white.cumulative(l) - origin_) * scale_;
}

Vec3 Bands::rgb_cumulative(double lambda_nm) const {
  return xyz_to_rgb(xyz_cumulative(lambda_nm));
}

double d65_power_at(double lambda_nm) {
  return in_table(lambda_nm) ? tables().d65.at(lambda_nm) : 0;
}

Vec3 cie_observer(double lambda_nm) {
  return in_table(lambda_nm) ? tables().observer.at(lambda_nm) : Vec3(0);
}

} // namespace abbe::optics
