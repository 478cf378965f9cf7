// SPDX-License-Identifier: MIT
#include "render/pixel_sampler.hpp"
#include "render/shown_error.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace abbe::render {
namespace {

/// What a pixel's samples are taken up to next: four times the first ones, so that quarters are
/// known, and twice as many as there are from then on; more where what can have been missed between
/// them is not small enough yet.
int next_count(KnownPixel const& pixel, Samples const& samples, plan::WorkingSpace const& space) {
  auto const twice = [&](int count) { return count > samples.most / 2 ? samples.most : 2 * count; };
  auto const may_miss_too_much = [&](int count) {
    double const rays = pixel.rays / pixel.count * count;
    return shown_error(pixel.mean(), missed(pixel.contrast, count), space)
           >= tolerance(samples, rays);
  };
  int count = twice(pixel.count);
  if (pixel.count == samples.least) count = twice(count);
  while (count < samples.most && may_miss_too_much(count)) count = twice(count);
  return count;
}

/// By how much the means of the quarters differ, which each are as evenly apart as all; and by what
/// can have been missed.
bool is_known(KnownPixel const& pixel, Samples const& samples, plan::WorkingSpace const& space) {
  Vec3 const mean = pixel.mean();
  Vec3 squares(0);
  for (Vec3 const& quarter : pixel.quarters) {
    Vec3 const off = quarter / (0.25 * pixel.count) - mean;
    squares += off * off;
  }
  Vec3 const unseen = missed(pixel.contrast, pixel.count);
  // Variance of a quarter's mean: squares / 3; of the mean of four: a fourth of that.
  return shown_error(mean, glm::sqrt(squares / 12.0 + unseen * unseen), space)
         < tolerance(samples, pixel.rays);
}

/// Adds samples up to a count. @return behind the last
Sampled const* add(KnownPixel& pixel, Sampled const* sample, int count) {
  // Quarters of what there was are eighths, or less, of what there will be.
  auto& q = pixel.quarters;
  if (count / pixel.count < 4)
    q = {q[0] + q[1], q[2] + q[3], Vec3(0), Vec3(0)};
  else
    q = {q[0] + q[1] + q[2] + q[3], Vec3(0), Vec3(0), Vec3(0)};
  int const each = std::max(1, count / 4);
  for (int i = pixel.count; i < count; ++i, ++sample) {
    q[static_cast<std::size_t>(std::min(3, i / each))] += sample->rgb;
    pixel.sum += sample->rgb;
    pixel.rays += sample->rays;
    pixel.bands.resize(sample->bands.size());
    for (std::size_t c = 0; c < sample->bands.size(); ++c) pixel.bands[c] += sample->bands[c];
  }
  pixel.count = count;
  return sample;
}

} // namespace

void PixelSampler::add_samples(Pixel const& pixel, int first, int end) {
  // So that 2^bits samples are enough.
  auto const bits = static_cast<unsigned>(
      std::bit_width(static_cast<unsigned>(options_.anti_aliasing.samples.most - 1)));
  RandomKey const key = key_of(pixel);
  PixelPoints const points(frame_key_, pixel.x, pixel.y, bits);
  for (int i = first; i < end; ++i) {
    auto const number = static_cast<std::uint64_t>(i);
    spots_.add(pixel.x + points.at(number, 0), pixel.y + points.at(number, 1),
               SampleKey{key, number, pixel.x, pixel.y, frame_key_, points}, pixel);
  }
}

void PixelSampler::first_samples(std::span<Pixel const> pixels, FirstSamples* out) {
  int const count = options_.anti_aliasing.samples.least;
  auto const each = static_cast<std::size_t>(count);
  spots_.clear();
  for (Pixel const& pixel : pixels) add_samples(pixel, 0, count);
  taken_.resize(std::max(taken_.size(), spots_.count()));
  take(taken_.data());
  for (std::size_t k = 0; k < pixels.size(); ++k) {
    std::span<Sampled const> const samples = std::span(taken_).subspan(k * each, each);
    FirstSamples& pixel = out[k];
    pixel = {samples[0], Vec3(0), 0};
    for (Sampled const& sample : samples.subspan(1)) pixel.mean.add(sample);
    pixel.mean.scale(1.0 / count);
    for (Sampled const& sample : samples) {
      Vec3 const off = sample.rgb - pixel.mean.rgb;
      pixel.squares += off * off;
      pixel.rays += sample.rays;
    }
  }
}

void PixelSampler::further_samples(std::span<Pixel const> pixels, plan::WorkingSpace const& space,
                                   KnownPixel* known) {
  Samples const& samples = options_.anti_aliasing.samples;
  std::vector<std::size_t> open(pixels.size());
  std::iota(open.begin(), open.end(), std::size_t{0});
  std::vector<int> counts;
  while (!open.empty()) {
    for (std::size_t begin = 0, end = 0; begin < open.size(); begin = end) {
      spots_.clear();
      counts.clear();
      for (; end < open.size() && spots_.count() < tracer_.batch(); ++end) {
        KnownPixel const& pixel = known[open[end]];
        counts.push_back(next_count(pixel, samples, space));
        add_samples(pixels[open[end]], pixel.count, counts.back());
      }
      taken_.resize(std::max(taken_.size(), spots_.count()));
      take(taken_.data());
      Sampled const* sample = taken_.data();
      for (std::size_t k = begin; k < end; ++k)
        sample = add(known[open[k]], sample, counts[k - begin]);
    }
    std::erase_if(open, [&](std::size_t k) {
      return known[k].count == samples.most || is_known(known[k], samples, space);
    });
  }
}

} // namespace abbe::render
