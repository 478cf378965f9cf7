// SPDX-License-Identifier: MIT
#include "render/pixel_sampler.hpp"

#include "render/camera.hpp"

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
      grid_(std::int64_t{1} << options.anti_aliasing.depth),
      negative_is_wrong_(options.check_finite && negative_light_is_wrong(stage)) {}

Sampled PixelSampler::at(double x, double y, RandomKey pixel, std::uint64_t index) {
  Sampled out;
  if (options_.spectral_output) out.bands.resize(static_cast<std::size_t>(stage_.channels));
  auto const ray = camera_ray(stage_.camera, x, y, options_.width, options_.height);
  out.rgb = tracer_.sample(ray, {pixel, index}, out.bands);
  if (options_.check_finite && !wrong_)
    if (auto const kind = tracer_.wrong(out.rgb, negative_is_wrong_))
      wrong_ = Wrong{*kind, x, y, {pixel, index}, out.rgb};
  return out;
}

Sampled PixelSampler::centre(int x, int y) {
  auto const key =
      frame_key_.child(static_cast<std::uint64_t>(y)).child(static_cast<std::uint64_t>(x));
  return at(x + 0.5, y + 0.5, key, 0);
}

Sampled PixelSampler::refined(int x, int y, Sampled const& centre) {
  auto const key =
      frame_key_.child(static_cast<std::uint64_t>(y)).child(static_cast<std::uint64_t>(x));
  int const n = options_.anti_aliasing.depth;
  double const jitter = options_.anti_aliasing.jitter;
  Sampled sum = centre;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      auto const index = static_cast<std::uint64_t>(j * n + i + 1);
      double dx = 0.5, dy = 0.5;
      if (jitter != 0) {
        RandomKey const sub = key.child(index + 0x10000);
        dx += jitter * (sub.uniform(0) - 0.5);
        dy += jitter * (sub.uniform(1) - 0.5);
      }
      sum.add(at(x + (i + dx) / n, y + (j + dy) / n, key, index));
    }
  sum.scale(1.0 / (n * n + 1));
  return sum;
}

Sampled PixelSampler::corner(std::int64_t x, std::int64_t y) {
  auto const key = frame_key_.child(static_cast<std::uint64_t>(y) + 0x100000000ULL)
                       .child(static_cast<std::uint64_t>(x));
  auto const scale = static_cast<double>(grid_);
  return at(static_cast<double>(x) / scale, static_cast<double>(y) / scale, key, 0);
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
  for (int c = 0; c < 3; ++c)
    difference += std::abs(std::pow(std::clamp(a[c], 0.0, 1.0), 1 / 2.5)
                           - std::pow(std::clamp(b[c], 0.0, 1.0), 1 / 2.5));
  return difference >= options_.anti_aliasing.threshold;
}

} // namespace abbe::render
