// SPDX-License-Identifier: MIT
#include "transport/cameras/lens.hpp"

#include "simd/math.hpp"
#include "transport/rays.hpp"
#include "transport/wave_tables.hpp"

#include <cmath>
#include <numbers>

namespace abbe::transport {
namespace {

/// Dimensions of the random start of a sample's points on the lens.
constexpr std::uint64_t across = 0x1e05, around = 0x1e06;

double fraction(double x) {
  return x - std::floor(x);
}

} // namespace

std::optional<Lens> Lens::of(scene::Camera const& camera) {
  if (!(camera.aperture > 0)) return std::nullopt;
  double const radius = camera.aperture / 4;
  Lens lens;
  lens.ahead_ = glm::normalize(camera.direction);
  lens.right_ = radius * glm::normalize(camera.right);
  lens.up_ = radius * glm::normalize(camera.up);
  lens.focal_distance_ = camera.focal_distance;
  lens.rays_ = camera.blur_samples;
  return lens;
}

void Lens::spread(Rays& rays, std::span<SampleKey const> keys) const {
  auto const each = static_cast<std::size_t>(rays_);
  // From behind: what is written lies behind what is still to be read.
  for (std::size_t k = keys.size(); k-- > 0;) {
    Vec3 const origin = rays.origin.get(k), direction = rays.direction.get(k);
    Vec3 const focus = direction * (focal_distance_ / glm::dot(direction, ahead_));
    double const u = keys[k].many(across), v = keys[k].many(around);
    for (std::size_t i = each; i-- > 0;) {
      // Roberts' R2 sequence: points that are evenly apart, however many there are.
      double const at = static_cast<double>(i);
      double const radius = std::sqrt(fraction(u + at * 0.7548776662466927));
      double const turn = 2 * std::numbers::pi * fraction(v + at * 0.5698402909980532);
      Vec3 const point = radius * (simd::cos(turn) * right_ + simd::sin(turn) * up_);
      rays.origin.set(k * each + i, origin + point);
      rays.direction.set(k * each + i, glm::normalize(focus - point));
    }
  }
}

} // namespace abbe::transport
