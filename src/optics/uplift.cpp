// SPDX-License-Identifier: MIT
#include "optics/uplift.hpp"

#include "optics/color.hpp"

#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace abbe::optics {
namespace {

constexpr double wanted_residual = 1e-12; // a thousandth of what is promised

double largest(Vec3 const& v) {
  return std::max({v.x, v.y, v.z});
}
double norm(Vec3 const& v) {
  return largest(glm::abs(v));
}

/// Finds values in (0, 1) for a target with components in [0, 1].
class Fit {
public:
  Fit(Bands const& bands, Vec3 const& target)
      : bands_(bands), target_(target), values_(bands.centers().size()) {}

  std::vector<double> run() {
    fit_sigmoid();
    if (norm(residual_) > wanted_residual) correct();
    return std::move(values_);
  }

private:
  double abscissa(std::size_t i) const {
    double const half = 0.5 * (bands_.hi_nm() - bands_.lo_nm());
    return (bands_.centers()[i] - bands_.lo_nm()) / half - 1;
  }

  /// Values and residual at the coefficients; the Jacobian d(rgb)/d(coefficients) if asked for.
  Vec3 evaluate(Vec3 const& c, std::vector<double>& values, Mat3* jacobian) const {
    Vec3 sum(0);
    if (jacobian) *jacobian = Mat3(0);
    for (std::size_t i = 0; i < values.size(); ++i) {
      double const t = abscissa(i);
      double const x = c[0] + t * (c[1] + t * c[2]);
      double const r = 1 / std::sqrt(1 + x * x);
      values[i] = 0.5 + 0.5 * x * r;
      Vec3 const& w = bands_.rgb_weights()[i];
      sum += w * values[i];
      if (!jacobian) continue;
      Vec3 const slope = w * (0.5 * r * r * r);
      (*jacobian)[0] += slope;
      (*jacobian)[1] += slope * t;
      (*jacobian)[2] += slope * (t * t);
    }
    return target_ - sum;
  }

  /// Levenberg-Marquardt from grey: near the solution it is Newton's method.
  void fit_sigmoid() {
    double const grey = std::clamp(luminance(target_), 0.01, 0.99);
    double const y = 2 * grey - 1;
    Vec3 c(y / std::sqrt(1 - y * y), 0, 0);
    Mat3 jacobian;
    residual_ = evaluate(c, values_, &jacobian);
    double damping = 1e-3;
    std::vector<double> trial(values_.size());
    constexpr int most_steps = 60;
    for (int step = 0; step < most_steps && norm(residual_) > wanted_residual; ++step) {
      Mat3 const transposed = glm::transpose(jacobian);
      Mat3 normal = transposed * jacobian;
      for (int k = 0; k < 3; ++k) normal[k][k] *= 1 + damping;
      if (!(std::abs(glm::determinant(normal)) > 0)) return;
      Vec3 const next = c + glm::inverse(normal) * (transposed * residual_);
      Mat3 next_jacobian;
      Vec3 const next_residual = evaluate(next, trial, &next_jacobian);
      if (glm::dot(next_residual, next_residual) < glm::dot(residual_, residual_)) {
        c = next;
        residual_ = next_residual;
        jacobian = next_jacobian;
        values_.swap(trial);
        damping *= 0.1;
      } else {
        damping *= 8;
        if (!(damping < 1e12)) return;
      }
    }
  }

  /// Adds the smallest change (in the mean square over wavelength) that takes the residual away,
  /// holding values at 0 and 1 that it would push out; when the free bands do not suffice, lets
  /// them go.
  void correct() {
    std::vector<bool> free(values_.size(), true);
    constexpr int most_rounds = 64;
    for (int round = 0; round < most_rounds; ++round) {
      if (norm(residual_) <= wanted_residual) return;
      if (!shift(free)) break;
      bool clamped = false;
      for (std::size_t i = 0; i < values_.size(); ++i) {
        double const inside = std::clamp(values_[i], 0.0, 1.0);
        if (inside == values_[i]) continue;
        values_[i] = inside;
        free[i] = false;
        clamped = true;
      }
      update_residual();
      if (!clamped && norm(residual_) > 1e-6) break; // the system of the free bands is singular
    }
    std::fill(free.begin(), free.end(), true);
    for (int round = 0; round < 3 && norm(residual_) > wanted_residual; ++round) {
      shift(free);
      update_residual();
    }
  }

  bool shift(std::vector<bool> const& free) {
    Mat3 gram(0);
    for (std::size_t i = 0; i < values_.size(); ++i)
      if (free[i]) gram += glm::outerProduct(shape(i), bands_.rgb_weights()[i]);
    double const scale = gram[0][0] * gram[1][1] * gram[2][2];
    if (!(std::abs(glm::determinant(gram)) > 1e-12 * scale)) return false;
    Vec3 const amount = glm::inverse(gram) * residual_;
    for (std::size_t i = 0; i < values_.size(); ++i)
      if (free[i]) values_[i] += glm::dot(shape(i), amount);
    return true;
  }

  /// The colour matching functions as mean densities over the bands: the smooth basis of the
  /// change.
  Vec3 shape(std::size_t i) const {
    return bands_.rgb_weights()[i]
           * ((bands_.hi_nm() - bands_.lo_nm()) / bands_.width(static_cast<int>(i)));
  }

  void update_residual() { residual_ = target_ - bands_.rgb(values_); }

  Bands const& bands_;
  Vec3 target_;
  std::vector<double> values_;
  Vec3 residual_{};
};

std::vector<double> uplift_positive(Vec3 const& rgb, Bands const& bands) {
  std::size_t const n = bands.centers().size();
  if (rgb.x == rgb.y && rgb.y == rgb.z) return std::vector<double>(n, rgb.x);
  double const scale = std::max(1.0, largest(rgb));
  auto values = Fit(bands, rgb / scale).run();
  if (scale != 1)
    for (double& value : values) value *= scale;
  return values;
}

} // namespace

std::vector<double> uplift(Vec3 const& rgb, Bands const& bands) {
  if (bands.count() < 3) {
    double const grey = rgb.x == rgb.y && rgb.y == rgb.z ? rgb.x : luminance(rgb);
    return std::vector<double>(bands.centers().size(), grey);
  }
  if (std::min({rgb.x, rgb.y, rgb.z}) >= 0) return uplift_positive(rgb, bands);
  if (rgb.x == rgb.y && rgb.y == rgb.z) return std::vector<double>(bands.centers().size(), rgb.x);
  auto values = uplift_positive(glm::max(rgb, Vec3(0)), bands);
  auto const negative = uplift_positive(glm::max(-rgb, Vec3(0)), bands);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] -= negative[i];
  return values;
}

} // namespace abbe::optics
