// SPDX-License-Identifier: MIT
#include "render/pixel_sampler.hpp"

#include "render/camera.hpp"
#include "render/marks.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::render {

void Sampled::add(Sampled const& other) {
  rgb += other.rgb;
  for (std::size_t i = 0; i < bands.size(); ++i) bands[i] += other.bands[i];
}

void Sampled::scale(double factor) {
  rgb *= factor;
  for (auto& band : bands) band *= factor;
}

PixelSampler::PixelSampler(Stage const& stage, RenderOptions const& options, Tracer& tracer)
    : stage_(stage),
      options_(options),
      tracer_(tracer),
      frame_key_(options.seed),
      grid_(options.anti_aliasing.method == 2 ? std::int64_t{1} << options.anti_aliasing.depth : 1),
      negative_is_wrong_(options.check_finite && negative_light_is_wrong(stage)) {}

Sampled PixelSampler::at(Spot const& spot) {
  auto const& [x, y, key] = spot;
  Sampled out;
  if (options_.spectral_output) out.bands.resize(stage_.film_bands());
  auto const ray = camera_ray(stage_.camera, x, y, options_.width, options_.height);
  out.rgb = tracer_.sample(ray, key, out.bands);
  if (options_.check_finite && !wrong_)
    if (auto const kind = tracer_.wrong(0, out.rgb, negative_is_wrong_))
      wrong_ = Wrong{*kind, x, y, key, out.rgb};
  return out;
}

void PixelSampler::at_together(Spot const* spots, std::size_t count, Sampled* out) {
  geometry::FanLines rays;
  rays.count = count;
  for (std::size_t k = 0; k < count; ++k) {
    auto const ray =
        camera_ray(stage_.camera, spots[k].x, spots[k].y, options_.width, options_.height);
    rays.origin.set(k, ray.origin);
    rays.direction.set(k, ray.direction);
    rays.origin_error.set(k, ray.origin_error);
  }
  rays.fill();
  SampleKey keys[geometry::fan_width];
  for (std::size_t k = 0; k < count; ++k) keys[k] = spots[k].key;
  tracer_.samples(rays, {keys, count});
  for (std::size_t k = 0; k < count; ++k) {
    out[k].bands.resize(options_.spectral_output ? stage_.film_bands() : 0);
    out[k].rgb = tracer_.light_of(k, out[k].bands);
    if (options_.check_finite && !wrong_)
      if (auto const kind = tracer_.wrong(k, out[k].rgb, negative_is_wrong_))
        wrong_ = Wrong{*kind, spots[k].x, spots[k].y, spots[k].key, out[k].rgb};
  }
}

void PixelSampler::at_all(Spot const* spots, std::size_t count, Sampled* out) {
  std::size_t const most = tracer_.together() ? geometry::fan_width : 1;
  for (std::size_t first = 0; first < count; first += most) {
    std::size_t const some = std::min(most, count - first);
    if (some > 1)
      at_together(spots + first, some, out + first);
    else
      out[first] = at(spots[first]);
  }
}

RandomKey PixelSampler::key_of(int x, int y) const {
  return frame_key_.child(static_cast<std::uint64_t>(y)).child(static_cast<std::uint64_t>(x));
}

PixelSampler::Spot PixelSampler::spot(double x, double y, RandomKey pixel, std::uint64_t number) {
  return {x, y,
          SampleKey{pixel, number, static_cast<std::int64_t>(std::floor(x)),
                    static_cast<std::int64_t>(std::floor(y)), frame_key_}};
}

Sampled PixelSampler::centre(int x, int y) {
  return at(spot(x + 0.5, y + 0.5, key_of(x, y), 0));
}

void PixelSampler::centres(int x, int y, std::size_t count, Sampled* out) {
  Spot spots[geometry::fan_width];
  ABBE_ASSERT(count <= geometry::fan_width);
  for (std::size_t k = 0; k < count; ++k) {
    int const at = x + static_cast<int>(k);
    spots[k] = spot(at + 0.5, y + 0.5, key_of(at, y), 0);
  }
  at_all(spots, count, out);
}

Sampled PixelSampler::refined(int x, int y, Sampled const& centre) {
  auto const key = key_of(x, y);
  int const n = options_.anti_aliasing.depth;
  double const jitter = options_.anti_aliasing.jitter;
  spots_.clear();
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      auto const index = static_cast<std::uint64_t>(j * n + i + 1);
      double dx = 0.5, dy = 0.5;
      if (jitter != 0) {
        RandomKey const sub = key.child(index + 0x10000);
        dx += jitter * (sub.uniform(0) - 0.5);
        dy += jitter * (sub.uniform(1) - 0.5);
      }
      spots_.push_back(spot(x + (i + dx) / n, y + (j + dy) / n, key, index));
    }
  taken_.resize(spots_.size());
  at_all(spots_.data(), spots_.size(), taken_.data());
  Sampled sum = centre;
  for (Sampled const& sampled : taken_) sum.add(sampled);
  sum.scale(1.0 / (n * n + 1));
  return sum;
}

Sampled PixelSampler::corner(std::int64_t x, std::int64_t y) {
  auto const key = frame_key_.child(static_cast<std::uint64_t>(y) + 0x100000000ULL)
                       .child(static_cast<std::uint64_t>(x));
  auto const scale = static_cast<double>(grid_);
  return at(spot(static_cast<double>(x) / scale, static_cast<double>(y) / scale, key, 0));
}

Sampled PixelSampler::cell(std::int64_t x, std::int64_t y, std::int64_t size,
                           Sampled const (&c)[4]) {
  bool uneven = false;
  for (int i = 0; i < 4 && size > 1; ++i)
    for (int j = i + 1; j < 4; ++j) uneven = uneven || differ(c[i].rgb, c[j].rgb);
  if (!uneven) {
    Sampled mean = c[0];
    for (int i = 1; i < 4; ++i) mean.add(c[i]);
    mean.scale(0.25);
    return mean;
  }
  std::int64_t const h = size / 2;
  Sampled const top = corner(x + h, y), left = corner(x, y + h), middle = corner(x + h, y + h),
                right = corner(x + size, y + h), bottom = corner(x + h, y + size);
  Sampled sum = cell(x, y, h, {c[0], top, left, middle});
  sum.add(cell(x + h, y, h, {top, c[1], middle, right}));
  sum.add(cell(x, y + h, h, {left, middle, c[2], bottom}));
  sum.add(cell(x + h, y + h, h, {middle, right, bottom, c[3]}));
  sum.scale(0.25);
  return sum;
}

Sampled PixelSampler::subdivided(int x, int y) {
  std::int64_t const left = x * grid_, top = y * grid_;
  return cell(left, top, grid_,
              {corner(left, top), corner(left + grid_, top), corner(left, top + grid_),
               corner(left + grid_, top + grid_)});
}

bool PixelSampler::differ(Vec3 const& a, Vec3 const& b) const {
  double difference = 0;
  for (int c = 0; c < 3; ++c) difference += std::abs(as_seen(a[c]) - as_seen(b[c]));
  return difference >= options_.anti_aliasing.threshold;
}

} // namespace abbe::render
