// SPDX-License-Identifier: MIT
#include "optics/uplift.hpp"

#include "optics/color.hpp"

#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace abbe::optics {
namespace {

constexpr double wanted_residual = 1e-12; // a thousandth of what is promised

constexpr double small_residual = 1e-4;

double largest(Vec3 const& v) {
  return std::max({v.x, v.y, v.z});
}
double norm(Vec3 const& v) {
  return largest(glm::abs(v));
}

/// Finds values in (0, 1) for a target with components in [0, 1].
class Fit {
public:
  Fit(Bands const& bands, Vec3 const& target) : bands_(bands), target_(target) {}

  std::vector<double> run() {
    Level const full = fine();
    double const y = 2 * std::clamp(luminance(target_), 0.01, 0.99) - 1;
    Vec3 coefficients(y / std::sqrt(1 - y * y), 0, 0);
    // Many bands: the way from grey is found on groups of bands, then few full steps remain.
    if (full.t.size() >= 4 * coarse_count) coefficients = fit_sigmoid(coarse(full), coefficients);
    fit_sigmoid(full, coefficients);
    if (norm(residual_) > wanted_residual) correct();
    return std::move(values_);
  }

private:
  static constexpr std::size_t coarse_count = 24;

  /// Places of the bands in -1..1 and what they are worth.
  struct Level {
    std::vector<double> t;
    std::vector<Vec3> weight;
  };

  Level fine() const {
    Level level;
    double const half = 0.5 * (bands_.hi_nm() - bands_.lo_nm());
    for (double const center : bands_.centers())
      level.t.push_back((center - bands_.lo_nm()) / half - 1);
    level.weight.assign(bands_.rgb_weights().begin(), bands_.rgb_weights().end());
    return level;
  }
  static Level coarse(Level const& full) {
    Level level{std::vector<double>(coarse_count, 0.0), std::vector<Vec3>(coarse_count, Vec3(0))};
    std::vector<double> members(coarse_count, 0.0);
    for (std::size_t i = 0; i < full.t.size(); ++i) {
      std::size_t const k = i * coarse_count / full.t.size();
      level.t[k] += full.t[i];
      level.weight[k] += full.weight[i];
      members[k] += 1;
    }
    for (std::size_t k = 0; k < coarse_count; ++k) level.t[k] /= members[k];
    return level;
  }

  /// Values and residual at the coefficients, and the Jacobian d(rgb)/d(coefficients).
  Vec3 evaluate(Level const& level, Vec3 const& c, std::vector<double>& values,
                Mat3& jacobian) const {
    Vec3 sum(0);
    jacobian = Mat3(0);
    for (std::size_t i = 0; i < values.size(); ++i) {
      double const t = level.t[i];
      double const x = c[0] + t * (c[1] + t * c[2]);
      double const r = 1 / std::sqrt(1 + x * x);
      values[i] = 0.5 + 0.5 * x * r;
      Vec3 const& w = level.weight[i];
      sum += w * values[i];
      Vec3 const slope = w * (0.5 * r * r * r);
      jacobian[0] += slope;
      jacobian[1] += slope * t;
      jacobian[2] += slope * (t * t);
    }
    return target_ - sum;
  }

  /// Levenberg-Marquardt; near the solution it is Newton's method. Leaves the values and the
  /// residual of the coefficients that it returns.
  Vec3 fit_sigmoid(Level const& level, Vec3 c) {
    Mat3 jacobian;
    values_.resize(level.t.size());
    residual_ = evaluate(level, c, values_, jacobian);
    double damping = 1e-3;
    std::vector<double> trial(values_.size());
    constexpr int most_steps = 60;
    for (int step = 0; step < most_steps && norm(residual_) > wanted_residual; ++step) {
      Mat3 const transposed = glm::transpose(jacobian);
      Mat3 normal = transposed * jacobian;
      for (int k = 0; k < 3; ++k) normal[k][k] *= 1 + damping;
      if (!(std::abs(glm::determinant(normal)) > 0)) return c;
      Vec3 const next = c + glm::inverse(normal) * (transposed * residual_);
      Mat3 next_jacobian;
      Vec3 const next_residual = evaluate(level, next, trial, next_jacobian);
      if (glm::dot(next_residual, next_residual) < glm::dot(residual_, residual_)) {
        // A saturated sigmoid creeps; the linear correction finishes what is left better.
        bool const creeping =
            norm(residual_) < small_residual && norm(next_residual) > 0.25 * norm(residual_);
        c = next;
        residual_ = next_residual;
        jacobian = next_jacobian;
        values_.swap(trial);
        damping *= 0.1;
        if (creeping) return c;
      } else {
        damping *= 8;
        if (!(damping < 1e12)) return c;
      }
    }
    return c;
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
