// SPDX-License-Identifier: MIT
#include "render/marks.hpp"
#include "render/pixel_sampler.hpp"
#include "transport/cut_light.hpp"

#include <cmath>

namespace abbe::render {
namespace {

/// So many corners are kept, and those of the pixels in work.
constexpr std::size_t most_kept = std::size_t{1} << 14;

} // namespace

std::uint32_t PixelSampler::corner(std::int64_t x, std::int64_t y, Pixel const& pixel) {
  auto const key = frame_key_.child(static_cast<std::uint64_t>(y) + 0x100000000ULL)
                       .child(static_cast<std::uint64_t>(x));
  auto const fresh = static_cast<std::uint32_t>(corners_.size());
  std::uint32_t const number =
      corner_numbers_.find_or_add(key.bits(), fresh, [&](std::uint32_t known) {
        return corners_[known].x == x && corners_[known].y == y;
      });
  if (number == fresh) {
    auto const scale = static_cast<double>(grid_);
    corners_.push_back({x, y, {}, Vec3(0)});
    add_spot(static_cast<double>(x) / scale, static_cast<double>(y) / scale, key, 0, pixel);
  }
  return number;
}

void PixelSampler::take_corners() {
  taken_.resize(spots_.count());
  take(taken_.data());
  auto corner = corners_.end() - static_cast<std::ptrdiff_t>(spots_.count());
  for (Sampled& sampled : taken_) {
    for (int c = 0; c < 3; ++c) corner->seen[c] = as_seen(sampled.rgb[c]);
    corner->sampled = std::move(sampled);
    ++corner;
  }
  spots_.clear();
}

bool PixelSampler::uneven(Cell const& cell) const {
  auto const differ = [&](std::uint32_t i, std::uint32_t j) {
    Vec3 const &a = corners_[i].seen, &b = corners_[j].seen;
    double difference = 0;
    for (int c = 0; c < 3; ++c) difference += std::abs(a[c] - b[c]);
    return difference >= options_.anti_aliasing.threshold;
  };
  for (int i = 0; i < 4; ++i)
    for (int j = i + 1; j < 4; ++j)
      if (differ(cell.corners[i], cell.corners[j])) return true;
  return false;
}

void PixelSampler::divide(std::size_t number) {
  auto const first = static_cast<std::uint32_t>(cells_.size());
  cells_[number].parts = first;
  Cell const whole = cells_[number];
  auto const& c = whole.corners;
  std::int64_t const x = whole.x, y = whole.y, h = whole.size / 2;
  auto const at = [&](std::int64_t dx, std::int64_t dy) {
    return corner(x + dx, y + dy, whole.pixel);
  };
  std::uint32_t const top = at(h, 0), left = at(0, h), middle = at(h, h), right = at(2 * h, h),
                      bottom = at(h, 2 * h);
  cells_.push_back({x, y, h, whole.pixel, {c[0], top, left, middle}});
  cells_.push_back({x + h, y, h, whole.pixel, {top, c[1], middle, right}});
  cells_.push_back({x, y + h, h, whole.pixel, {left, middle, c[2], bottom}});
  cells_.push_back({x + h, y + h, h, whole.pixel, {middle, right, bottom, c[3]}});
}

Sampled PixelSampler::mean(Cell const& cell) const {
  Sampled sum = cell.parts == 0 ? corners_[cell.corners[0]].sampled : mean(cells_[cell.parts]);
  for (std::uint32_t i = 1; i < 4; ++i) {
    if (cell.parts == 0)
      sum.add(corners_[cell.corners[i]].sampled);
    else
      sum.add(mean(cells_[cell.parts + i]));
  }
  sum.scale(0.25);
  return sum;
}

void PixelSampler::subdivided(std::span<Pixel const> pixels, Sampled* out) {
  if (corners_.size() > most_kept) {
    corners_.clear();
    corner_numbers_ = {};
  }
  spots_.clear();
  cells_.clear();
  for (Pixel const& pixel : pixels) {
    std::int64_t const x = pixel.x * grid_, y = pixel.y * grid_;
    std::int64_t const right = x + grid_, bottom = y + grid_;
    cells_.push_back({x,
                      y,
                      grid_,
                      pixel,
                      {corner(x, y, pixel), corner(right, y, pixel), corner(x, bottom, pixel),
                       corner(right, bottom, pixel)}});
  }
  take_corners();
  // Cells of one size after the other, so that many samples are taken together.
  for (std::size_t begin = 0; begin < cells_.size() && cells_[begin].size > 1;) {
    std::size_t const end = cells_.size();
    for (std::size_t i = begin; i < end; ++i)
      if (uneven(cells_[i])) divide(i);
    take_corners();
    begin = end;
  }
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    out[i] = mean(cells_[i]);
    lost_ += CutLight::units_of(out[i].lost);
  }
}

} // namespace abbe::render
