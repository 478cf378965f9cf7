// SPDX-License-Identifier: MIT
#include "render/pixel_sampler.hpp"

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
      draws_(!stage.combs.empty() || stage.lens || options.anti_aliasing.jitter != 0
             || std::ranges::any_of(stage.lamps,
                                    [](auto const& lamp) {
                                      return lamp->area() != nullptr && lamp->area()->grid().jitter;
                                    })),
      grid_(options.anti_aliasing.method == 2 ? std::int64_t{1} << (options.anti_aliasing.depth - 1)
                                              : 1),
      negative_is_wrong_(options.check_finite && transport::negative_light_is_wrong(stage)) {}

void PixelSampler::start() {
  wrong_.reset();
  lost_ = 0;
  corners_.clear();
  corner_numbers_ = {};
}

void PixelSampler::Spots::clear() {
  x.clear();
  y.clear();
  key.clear();
  pixel.clear();
}

void PixelSampler::Spots::add(double at_x, double at_y, SampleKey const& of,
                              Pixel const& for_pixel) {
  x.push_back(at_x);
  y.push_back(at_y);
  key.push_back(of);
  pixel.push_back(for_pixel);
}

void PixelSampler::check(Spots const& spots, std::size_t spot, std::size_t place, Vec3 const& rgb) {
  auto const row_of = [](Pixel const& pixel) { return std::pair(pixel.y, pixel.x); };
  Pixel const& pixel = spots.pixel[spot];
  if (wrong_ && row_of(wrong_->pixel) <= row_of(pixel)) return;
  if (auto const kind = tracer_.wrong(place, rgb, negative_is_wrong_))
    wrong_ = Wrong{*kind, pixel, spots.x[spot], spots.y[spot], spots.key[spot], rgb};
}

std::size_t PixelSampler::place_of(Pixel const& pixel) const {
  Region const region = options_.pixels();
  auto const width = static_cast<std::size_t>(region.x1 - region.x0);
  return static_cast<std::size_t>(pixel.y - region.y0) * width
         + static_cast<std::size_t>(pixel.x - region.x0);
}

template <class Done>
void PixelSampler::trace(Spots const& spots, Done const& done) {
  std::size_t const most = tracer_.batch(), count = spots.count();
  Sampled sampled;
  sampled.bands.resize(options_.spectral_output ? stage_.film_bands() : 0);
  for (std::size_t first = 0; first < count; first += most) {
    std::size_t const some = std::min(most, count - first);
    tracer_.trace(
        {spots.x.data() + first, spots.y.data() + first, some, options_.width, options_.height},
        {spots.key.data() + first, some});
    for (std::size_t k = 0; k < some; ++k) {
      sampled.rgb = tracer_.light_of(k, sampled.bands);
      sampled.lost = tracer_.lost_of(k);
      if (tracer_.counts_rays()) sampled.rays = tracer_.rays_of(k);
      if (options_.rays_of_pixels)
        (*options_.rays_of_pixels)[place_of(spots.pixel[first + k])] +=
            static_cast<float>(tracer_.rays_of(k));
      if (options_.check_finite) check(spots, first + k, k, sampled.rgb);
      done(first + k, sampled);
    }
  }
}

void PixelSampler::take(Sampled* out) {
  if (stage_.lens) return take_through_lens(out);
  trace(spots_, [&](std::size_t spot, Sampled const& sampled) { out[spot] = sampled; });
}

void PixelSampler::take_through_lens(Sampled* out) {
  struct Known {
    std::size_t spot = 0;
    Vec3 sum{0}, squares{0}; ///< of what shows of the rays' light
  };
  std::vector<Known> open(spots_.count());
  for (std::size_t spot = 0; spot < open.size(); ++spot) {
    open[spot].spot = spot;
    out[spot] = {};
    out[spot].bands.resize(options_.spectral_output ? stage_.film_bands() : 0);
  }
  transport::Lens const& lens = *stage_.lens;
  for (std::uint64_t taken = 0; !open.empty();) {
    std::uint64_t const more = lens.next_rays(taken);
    rays_.clear();
    for (Known const& known : open)
      for (std::uint64_t i = 0; i < more; ++i) {
        SampleKey key = spots_.key[known.spot];
        key.lens = taken + i;
        rays_.add(spots_.x[known.spot], spots_.y[known.spot], key, spots_.pixel[known.spot]);
      }
    trace(rays_, [&](std::size_t ray, Sampled const& sampled) {
      Known& known = open[ray / more];
      Vec3 const shown = glm::clamp(sampled.rgb, 0.0, 1.0);
      known.sum += shown;
      known.squares += shown * shown;
      out[known.spot].add(sampled);
      out[known.spot].rays += sampled.rays;
    });
    taken += more;
    auto const n = static_cast<double>(taken);
    std::erase_if(open, [&](Known const& known) {
      bool enough = true;
      for (int i = 0; i < 3; ++i) {
        double const squares = known.squares[i] - known.sum[i] * known.sum[i] / n;
        // What is left of rounding is none.
        double const grain = 1e-12 * known.squares[i];
        enough = enough && lens.enough(taken, squares > grain ? squares : 0);
      }
      if (!enough && taken < lens.rays()) return false;
      out[known.spot].scale(1 / n);
      return true;
    });
  }
}

RandomKey PixelSampler::key_of(Pixel const& pixel) const {
  if (!draws_) return frame_key_;
  return frame_key_.child(static_cast<std::uint64_t>(pixel.y))
      .child(static_cast<std::uint64_t>(pixel.x));
}

void PixelSampler::add_spot(double x, double y, RandomKey key, std::uint64_t number,
                            Pixel const& pixel) {
  spots_.add(x, y,
             SampleKey{key, number, static_cast<std::int64_t>(std::floor(x)),
                       static_cast<std::int64_t>(std::floor(y)), frame_key_},
             pixel);
}

void PixelSampler::add_centre(Pixel const& pixel) {
  spots_.add(pixel.x + 0.5, pixel.y + 0.5,
             SampleKey{key_of(pixel), 0, pixel.x, pixel.y, frame_key_}, pixel);
}

void PixelSampler::centres(std::span<Pixel const> pixels, Sampled* out) {
  spots_.clear();
  for (Pixel const& pixel : pixels) add_centre(pixel);
  take(out);
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
      add_spot(pixel.x + (i + dx) / n, pixel.y + (j + dy) / n, key, index, pixel);
    }
}

void PixelSampler::refined(std::span<Pixel const> pixels, bool middle, Sampled* out) {
  spots_.clear();
  for (Pixel const& pixel : pixels) {
    if (middle) add_centre(pixel);
    add_grid(pixel);
  }
  taken_.resize(spots_.count());
  take(taken_.data());
  std::size_t const each = spots_.count() / pixels.size();
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    Sampled& sum = out[i];
    sum.rgb = Vec3(0);
    sum.bands.assign(taken_[i * each].bands.size(), 0.0);
    for (std::size_t k = 0; k < each; ++k) sum.add(taken_[i * each + k]);
    sum.scale(1.0 / static_cast<double>(each));
  }
}

} // namespace abbe::render
