// SPDX-License-Identifier: MIT
#include "study/errors.hpp"

#include "image/colour.hpp"
#include "image/metrics.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::study {
namespace {

/// 1 / (R^2 + 0.01 m^2) for X, Y and Z of each pixel.
class Weights {
public:
  explicit Weights(image::Image const& reference) {
    double sum = 0;
    for (std::size_t i = 0; i < reference.pixels(); ++i) {
      xyz_.push_back(image::linear_srgb_to_xyz(image::pixel(reference, i)));
      sum += xyz_.back().y;
    }
    double const m = sum / static_cast<double>(std::max<std::size_t>(1, xyz_.size()));
    floor_ = 0.01 * m * m;
  }
  std::size_t size() const { return xyz_.size(); }
  Vec3 const& reference(std::size_t i) const { return xyz_[i]; }
  /// Black in a black picture counts in absolute units.
  double relative(std::size_t i, Vec3 const& squares) const {
    double sum = 0;
    for (int c = 0; c < 3; ++c) {
      double const below = xyz_[i][c] * xyz_[i][c] + floor_;
      sum += squares[c] / (below > 0 ? below : 1);
    }
    return sum / 3;
  }

private:
  std::vector<Vec3> xyz_;
  double floor_ = 0;
};

Vec3 xyz_of(image::Image const& picture, std::size_t i) {
  return image::linear_srgb_to_xyz(image::pixel(picture, i));
}

} // namespace

Errors measure_errors(image::Image const& reference, image::Image const& test,
                      DispersionField const& field) {
  Errors errors;
  auto const metrics = image::compare(reference, test);
  errors.delta_e_mean = metrics->delta_e_mean;
  errors.delta_e_p99 = metrics->delta_e_p99;
  errors.relative_mse_rgb = metrics->relative_mse;
  errors.flip = metrics->flip_mean;
  Weights const weights(reference);
  double sum = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    Vec3 const off = xyz_of(test, i) - weights.reference(i);
    sum += weights.relative(i, off * off);
  }
  errors.relative_mse = sum / static_cast<double>(weights.size());
  errors.banding = banding(reference, test, field);
  return errors;
}

std::optional<Spread> measure_spread(image::Image const& reference,
                                     std::span<image::Image const> tests, bool deterministic) {
  if (tests.empty() || (tests.size() == 1 && !deterministic)) return std::nullopt;
  Weights const weights(reference);
  double const count = deterministic ? 1 : static_cast<double>(tests.size());
  double variance = 0, off_mean = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    Vec3 mean_xyz{0}, squares{0};
    for (std::size_t t = 0; t < static_cast<std::size_t>(count); ++t)
      mean_xyz += xyz_of(tests[t], i) / count;
    for (std::size_t t = 0; t < static_cast<std::size_t>(count); ++t) {
      Vec3 const off = xyz_of(tests[t], i) - mean_xyz;
      squares += off * off;
    }
    if (count > 1) variance += weights.relative(i, squares / (count - 1));
    Vec3 const off = mean_xyz - weights.reference(i);
    off_mean += weights.relative(i, off * off);
  }
  auto const pixels = static_cast<double>(weights.size());
  variance /= pixels;
  off_mean /= pixels;
  return Spread{std::sqrt(variance), std::sqrt(std::max(0.0, off_mean - variance / count))};
}

std::vector<float> delta_e_map(image::Image const& reference, image::Image const& test) {
  image::Image const a = image::tone_map(reference), b = image::tone_map(test);
  auto const lab = [](image::Image const& picture, std::size_t i) {
    return image::xyz_to_lab(image::linear_srgb_to_xyz(image::pixel(picture, i)));
  };
  std::vector<float> map(a.pixels());
  for (std::size_t i = 0; i < map.size(); ++i)
    map[i] = static_cast<float>(image::ciede2000(lab(a, i), lab(b, i)));
  return map;
}

double mean(std::vector<float> const& values) {
  double sum = 0;
  for (float const value : values) sum += value;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

} // namespace abbe::study
