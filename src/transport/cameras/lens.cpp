// SPDX-License-Identifier: MIT
#include "transport/cameras/lens.hpp"

#include "simd/math.hpp"
#include "transport/rays.hpp"
#include "transport/wave_tables.hpp"

#include <algorithm>
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

/// What a number of the normal distribution is below with this probability, within 5e-4.
/// @source Abramowitz and Stegun 26.2.23
double normal_quantile(double probability) {
  double const tail = std::clamp(std::min(probability, 1 - probability), 1e-12, 0.5);
  double const t = std::sqrt(-2 * simd::log(tail));
  double const size = t
                      - (2.515517 + t * (0.802853 + t * 0.010328))
                            / (1 + t * (1.432788 + t * (0.189269 + t * 0.001308)));
  return probability < 0.5 ? -size : size;
}

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

  void skip(std::uint64_t count) {
    if (bokeh_ == nullptr)
      at_ += static_cast<double>(count);
    else
      for (; count > 0; --count) next();
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
  lens.bokeh_ = camera.bokeh;
  lens.rays_ = static_cast<std::uint64_t>(std::max(1, camera.blur_samples));
  lens.variance_ = camera.blur_variance;
  lens.quantile_ = normal_quantile(camera.blur_confidence);
  return lens;
}

std::uint64_t Lens::next_rays(std::uint64_t taken) const {
  constexpr std::uint64_t most = 256; // that fit into memory, of many samples
  std::uint64_t const wanted = taken == 0 ? std::clamp<std::uint64_t>(rays_ / 4, 8, 64) : taken / 2;
  return std::min({wanted, most, rays_ - taken});
}

bool Lens::enough(std::uint64_t count, double squares) const {
  if (squares == 0) return true;
  auto const freedom = static_cast<double>(count - 1);
  double const spread = 2 / (9 * freedom);
  double const root = 1 - spread - quantile_ * std::sqrt(spread);
  double const least = freedom * root * root * root;
  return root > 0 && squares <= variance_ * static_cast<double>(count) * least;
}

void Lens::spread(Rays& rays, std::span<SampleKey const> keys) const {
  std::optional<Points> points;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    SampleKey const& key = keys[k];
    bool const follows = k > 0 && key.lens == keys[k - 1].lens + 1;
    if (!follows) points.emplace(bokeh_.get(), key).skip(key.lens);
    Vec3 const origin = rays.origin.get(k), direction = rays.direction.get(k);
    Vec3 const focus = direction * (focal_distance_ / glm::dot(direction, ahead_));
    Vec2 const at = points->next();
    Vec3 const point = at.x * right_ + at.y * up_;
    rays.origin.set(k, origin + point);
    rays.direction.set(k, glm::normalize(focus - point));
  }
}

} // namespace abbe::transport
