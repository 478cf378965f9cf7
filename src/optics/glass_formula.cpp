// SPDX-License-Identifier: MIT
#include "optics/glass_formula.hpp"

#include "simd/math.hpp"

#include <fmt/format.h>

#include <cmath>

namespace abbe::optics {
namespace {

constexpr double herzberger_pole_um2 = 0.028;

/// w^p; catalogue exponents are small whole numbers almost always.
double power(double w, double p) {
  double const whole = std::nearbyint(p);
  if (whole != p || std::abs(p) > 64) return simd::pow(w, p);
  unsigned n = static_cast<unsigned>(std::abs(whole));
  double result = 1;
  for (double square = w; n != 0; n >>= 1, square *= square)
    if (n & 1u) result *= square;
  return whole < 0 ? 1 / result : result;
}

std::size_t most_coefficients(int id) {
  switch (id) {
  case 7:
    return 6;
  case 8:
    return 4;
  case 9:
    return 6;
  default:
    return 41; // the database stops at 17
  }
}

} // namespace

GlassFormula::GlassFormula(int id, std::vector<double> coefficients)
    : id_(id), c_(std::move(coefficients)) {
  if (id_ != 1 && id_ != 2) return;
  constant_ = 1 + c(1);
  for (std::size_t i = 2; i <= c_.size(); i += 2) {
    double const pole = id_ == 1 ? c(i + 1) * c(i + 1) : c(i + 1);
    constant_ += c(i);
    if (c(i) != 0 && pole != 0) terms_.push_back({c(i) * pole, pole});
  }
}

Result<GlassFormula> GlassFormula::make(int id, std::vector<double> coefficients) {
  if (id < 1 || id > 9)
    return Error{"E0410",
                 fmt::format("there is no dispersion formula {}; the formulas are 1 to 9", id)};
  if (coefficients.empty() || coefficients.size() > most_coefficients(id))
    return Error{"E0410", fmt::format("dispersion formula {} takes 1 to {} coefficients, not {}",
                                      id, most_coefficients(id), coefficients.size())};
  for (double const value : coefficients)
    if (!std::isfinite(value))
      return Error{"E0410", "a coefficient of the dispersion formula is not finite"};
  return GlassFormula(id, std::move(coefficients));
}

bool GlassFormula::whole(int id, std::size_t coefficients) {
  switch (id) {
  case 4:
    return coefficients == 1 || coefficients == 5 || (coefficients >= 9 && coefficients % 2 == 1);
  case 7:
    return true; // each coefficient is a term
  case 8:
    return coefficients != 2;
  case 9:
    return coefficients == 1 || coefficients == 3 || coefficients == 6;
  default:
    return coefficients % 2 == 1; // a constant, then pairs
  }
}

double GlassFormula::index(double lambda_nm) const {
  double const w = lambda_nm / 1000;
  double const w2 = w * w;
  switch (id_) {
  case 1:
  case 2:
    return std::sqrt(sellmeier(w2));
  case 3:
    return std::sqrt(polynomial(w, 2) + c(1));
  case 4:
    return std::sqrt(formula_4(w));
  case 5:
    return polynomial(w, 2) + c(1);
  case 6: {
    double excess = c(1);
    for (std::size_t i = 2; i <= c_.size(); i += 2)
      if (c(i) != 0) excess += c(i) / (c(i + 1) - 1 / w2);
    return 1 + excess;
  }
  case 7:
    return herzberger(w2);
  case 8:
    return retro(w2);
  case 9:
    return std::sqrt(exotic(w));
  default:
    ABBE_ASSERT(false);
  }
  return 0;
}

double GlassFormula::sellmeier(double w2) const {
  double sum = constant_;
  for (Term const& term : terms_) sum += term.bc / (w2 - term.c);
  return sum;
}

double GlassFormula::polynomial(double w, std::size_t first) const {
  double sum = 0;
  for (std::size_t i = first; i <= c_.size(); i += 2)
    if (c(i) != 0) sum += c(i) * power(w, c(i + 1));
  return sum;
}

double GlassFormula::formula_4(double w) const {
  double sum = c(1) + polynomial(w, 10);
  for (std::size_t i : {std::size_t{2}, std::size_t{6}})
    if (c(i) != 0) sum += c(i) * power(w, c(i + 1)) / (w * w - power(c(i + 2), c(i + 3)));
  return sum;
}

double GlassFormula::herzberger(double w2) const {
  double const l = 1 / (w2 - herzberger_pole_um2);
  return c(1) + l * (c(2) + l * c(3)) + w2 * (c(4) + w2 * (c(5) + w2 * c(6)));
}

double GlassFormula::retro(double w2) const {
  double q = c(1) + c(4) * w2;
  if (c(2) != 0) q += c(2) * w2 / (w2 - c(3));
  return std::sqrt((1 + 2 * q) / (1 - q));
}

double GlassFormula::exotic(double w) const {
  double const w2 = w * w;
  double sum = c(1);
  if (c(2) != 0) sum += c(2) / (w2 - c(3));
  if (c(4) != 0) sum += c(4) * (w - c(5)) / ((w - c(5)) * (w - c(5)) + c(6));
  return sum;
}

std::vector<double> GlassFormula::poles_nm() const {
  std::vector<double> poles;
  auto const add = [&](double weight, double pole_um2) {
    if (weight != 0 && pole_um2 > 0) poles.push_back(1000 * std::sqrt(pole_um2));
  };
  switch (id_) {
  case 1:
  case 2:
    for (Term const& term : terms_) add(term.bc, term.c);
    break;
  case 4:
    for (std::size_t i : {std::size_t{2}, std::size_t{6}}) add(c(i), power(c(i + 2), c(i + 3)));
    break;
  case 6:
    for (std::size_t i = 2; i <= c_.size(); i += 2)
      if (c(i + 1) != 0) add(c(i), 1 / c(i + 1));
    break;
  case 7:
    add(c(2) != 0 ? c(2) : c(3), herzberger_pole_um2);
    break;
  case 8:
    add(c(2), c(3));
    break;
  case 9:
    add(c(2), c(3));
    break;
  default:
    break;
  }
  return poles;
}

} // namespace abbe::optics
