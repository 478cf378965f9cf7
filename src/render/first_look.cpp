// SPDX-License-Identifier: MIT
#include "render/first_look.hpp"

#include "render/marks.hpp"
#include "render/shown_error.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::render {
namespace {

Vec3 vector(float const* values) {
  return {values[0], values[1], values[2]};
}

} // namespace

void FirstLook::put(std::size_t pixel, FirstSamples const& samples) {
  rays[pixel] = static_cast<float>(samples.rays);
  for (std::size_t c = 0; c < 3; ++c)
    squares[3 * pixel + c] = static_cast<float>(samples.squares[static_cast<int>(c)]);
}

std::vector<std::uint8_t> FirstLook::unknown(std::span<float const> rgb, std::size_t width,
                                             std::span<float const> above,
                                             std::span<float const> below, Samples const& samples,
                                             plan::WorkingSpace const& space) {
  contrast_ = contrasts(rgb, width, above, below);
  // One sample that stands apart from the others is what may cover more of the pixel.
  for (std::size_t i = 0; i < contrast_.size(); ++i)
    contrast_[i] = std::max(contrast_[i], std::sqrt(squares[i]));
  std::vector<std::uint8_t> marks(rays.size());
  double const n = samples.least;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    Vec3 const unseen = missed(vector(&contrast_[3 * i]), samples.least);
    Vec3 const spread =
        n > 1 ? vector(&squares[3 * i]) / (n * (n - 1)) : Vec3(0); // of one nothing is known
    double const error =
        shown_error(vector(&rgb[3 * i]), glm::sqrt(spread + unseen * unseen), space);
    marks[i] = error >= tolerance(samples, static_cast<double>(rays[i]));
  }
  return marks;
}

KnownPixel FirstLook::pixel(std::size_t pixel, float const* rgb, Samples const& samples) const {
  KnownPixel known;
  known.count = samples.least;
  known.sum = static_cast<double>(samples.least) * vector(rgb);
  known.rays = static_cast<double>(rays[pixel]);
  known.contrast = vector(&contrast_[3 * pixel]);
  known.quarters[0] = known.sum;
  return known;
}

} // namespace abbe::render
