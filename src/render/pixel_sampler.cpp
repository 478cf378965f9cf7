// SPDX-License-Identifier: MIT
#include "render/pixel_sampler.hpp"

#include "render/camera.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::render {

void Sampled::add(Sampled const& other) {
  rgb += other.rgb;
  lost += other.lost;
  for (std::size_t i = 0; i < bands.size(); ++i) bands[i] += other.bands[i];
}

void Sampled::scale(double factor) {
  rgb *= factor;
  lost *= factor;
  for (auto& band : bands) band *= factor;
}

PixelSampler::PixelSampler(Stage const& stage, RenderOptions const& options, Tracer& tracer)
    : stage_(stage),
      options_(options),
      tracer_(tracer),
      frame_key_(options.seed),
      grid_(options.anti_aliasing.method == 2 ? std::int64_t{1} << (options.anti_aliasing.depth - 1)
                                              : 1),
      negative_is_wrong_(options.check_finite && negative_light_is_wrong(stage)) {}

Sampled PixelSampler::at(Spot const& spot) {
  Sampled out;
  if (options_.spectral_output) out.bands.resize(stage_.film_bands());
  auto const ray = camera_ray(stage_.camera, spot.x, spot.y, options_.width, options_.height);
  out.rgb = tracer_.sample(ray, spot.key, out.bands);
  out.lost = tracer_.lost_of(0);
  if (options_.check_finite) check(spot, 0, out.rgb);
  return out;
}

void PixelSampler::check(Spot const& spot, std::size_t place, Vec3 const& rgb) {
  auto const row_of = [](Pixel const& pixel) { return std::pair(pixel.y, pixel.x); };
  if (wrong_ && row_of(wrong_->pixel) <= row_of(spot.pixel)) return;
  if (auto const kind = tracer_.wrong(place, rgb, negative_is_wrong_))
    wrong_ = Wrong{*kind, spot.pixel, spot.x, spot.y, spot.key, rgb};
}

void PixelSampler::at_together(Spot const* spots, std::size_t count, Sampled* out) {
  geometry::FanLines rays;
  rays.count = count;
  double x[geometry::fan_width], y[geometry::fan_width]; // whole fours
  for (std::size_t k = 0; k < (count + 3) / 4 * 4; ++k) {
    x[k] = spots[std::min(k, count - 1)].x;
    y[k] = spots[std::min(k, count - 1)].y;
  }
  camera_rays(stage_.camera, x, y, options_.width, options_.height, rays);
  SampleKey keys[geometry::fan_width];
  for (std::size_t k = 0; k < count; ++k) keys[k] = spots[k].key;
  tracer_.samples(rays, {keys, count});
  for (std::size_t k = 0; k < count; ++k) {
    out[k].bands.resize(options_.spectral_output ? stage_.film_bands() : 0);
    out[k].rgb = tracer_.light_of(k, out[k].bands);
    out[k].lost = tracer_.lost_of(k);
    if (options_.check_finite) check(spots[k], k, out[k].rgb);
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

RandomKey PixelSampler::key_of(Pixel const& pixel) const {
  return frame_key_.child(static_cast<std::uint64_t>(pixel.y))
      .child(static_cast<std::uint64_t>(pixel.x));
}

PixelSampler::Spot PixelSampler::spot(double x, double y, RandomKey key, std::uint64_t number,
                                      Pixel const& pixel) const {
  return {x, y,
          SampleKey{key, number, static_cast<std::int64_t>(std::floor(x)),
                    static_cast<std::int64_t>(std::floor(y)), frame_key_},
          pixel};
}

PixelSampler::Spot PixelSampler::centre(Pixel const& pixel) const {
  return {pixel.x + 0.5, pixel.y + 0.5, SampleKey{key_of(pixel), 0, pixel.x, pixel.y, frame_key_},
          pixel};
}

void PixelSampler::centres(std::span<Pixel const> pixels, Sampled* out) {
  spots_.clear();
  for (Pixel const& pixel : pixels) spots_.push_back(centre(pixel));
  at_all(spots_.data(), spots_.size(), out);
}

void PixelSampler::add_grid(Pixel const& pixel) {
  auto const key = key_of(pixel);
  int const n = options_.anti_aliasing.depth;
  double const jitter = options_.anti_aliasing.jitter;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      auto const index = static_cast<std::uint64_t>(j * n + i + 1);
      double dx = 0.5, dy = 0.5;
      if (jitter != 0) {
        RandomKey const sub = key.child(index + 0x10000);
        dx += jitter * (sub.uniform(0) - 0.5);
        dy += jitter * (sub.uniform(1) - 0.5);
      }
      spots_.push_back(spot(pixel.x + (i + dx) / n, pixel.y + (j + dy) / n, key, index, pixel));
    }
}

void PixelSampler::refined(std::span<Pixel const> pixels, bool middle, Sampled* out) {
  spots_.clear();
  for (Pixel const& pixel : pixels) {
    if (middle) spots_.push_back(centre(pixel));
    add_grid(pixel);
  }
  taken_.resize(spots_.size());
  at_all(spots_.data(), spots_.size(), taken_.data());
  std::size_t const each = spots_.size() / pixels.size();
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    Sampled& sum = out[i];
    sum.rgb = Vec3(0);
    sum.bands.assign(taken_[i * each].bands.size(), 0.0);
    for (std::size_t k = 0; k < each; ++k) sum.add(taken_[i * each + k]);
    sum.scale(1.0 / static_cast<double>(each));
  }
}

} // namespace abbe::render
