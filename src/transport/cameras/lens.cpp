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
constexpr std::uint64_t across = 0x1e05, around = 0x1e06, chance = 0x1e07;

double fraction(double x) {
  return x - std::floor(x);
}

/// Of a bokeh that is dark: so many points are looked at for one through which a ray goes.
constexpr int most_tries = 1024;

} // namespace

class Lens::Points {
public:
  Points(texture::Pattern const* bokeh, SampleKey const& key)
      : bokeh_(bokeh), start_(key.many(across), key.many(around), key.many(chance)) {}

  Vec2 next() {
    if (bokeh_ == nullptr) {
      // Roberts' R2 sequence: points that are evenly apart, however many there are.
      double const radius = std::sqrt(fraction(start_.x + at_ * 0.7548776662466927));
      double const turn = 2 * std::numbers::pi * fraction(start_.y + at_ * 0.5698402909980532);
      at_ += 1;
      return radius * Vec2(simd::cos(turn), simd::sin(turn));
    }
    Vec2 place(0);
    for (int i = 0; i < most_tries; ++i) {
      // R3: those points of it that lie below the density are spread as it says.
      place = {fraction(start_.x + at_ * 0.8191725133961645),
               fraction(start_.y + at_ * 0.6710436067037893)};
      double const height = fraction(start_.z + at_ * 0.5497004779019703);
      at_ += 1;
      if (height < bokeh_->raw({place.x, place.y, 0}, {})) break;
    }
    return {2 * place.x - 1, 1 - 2 * place.y};
  }

private:
  texture::Pattern const* bokeh_;
  Vec3 start_;
  double at_ = 0;
};

std::optional<Lens> Lens::of(scene::Camera const& camera) {
  if (!(camera.aperture > 0)) return std::nullopt;
  double const radius = camera.aperture / 4;
  Lens lens;
  lens.ahead_ = glm::normalize(camera.direction);
  lens.right_ = radius * glm::normalize(camera.right);
  lens.up_ = radius * glm::normalize(camera.up);
  lens.focal_distance_ = camera.focal_distance;
  lens.rays_ = camera.blur_samples;
  lens.bokeh_ = camera.bokeh;
  return lens;
}

void Lens::spread(Rays& rays, std::span<SampleKey const> keys) const {
  auto const each = static_cast<std::size_t>(rays_);
  // From behind: what is written lies behind what is still to be read.
  for (std::size_t k = keys.size(); k-- > 0;) {
    Vec3 const origin = rays.origin.get(k), direction = rays.direction.get(k);
    Vec3 const focus = direction * (focal_distance_ / glm::dot(direction, ahead_));
    Points points(bokeh_.get(), keys[k]);
    for (std::size_t i = 0; i < each; ++i) {
      Vec2 const at = points.next();
      Vec3 const point = at.x * right_ + at.y * up_;
      rays.origin.set(k * each + i, origin + point);
      rays.direction.set(k * each + i, glm::normalize(focus - point));
    }
  }
}

} // namespace abbe::transport
