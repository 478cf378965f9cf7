// SPDX-License-Identifier: MIT
#include "render/marks.hpp"

#include "simd/math.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::render {

double as_seen(double light) {
  return simd::pow(std::clamp(light, 0.0, 1.0), 1 / 2.5);
}

namespace {

void see(std::span<float const> rgb, std::vector<double>& out) {
  out.resize(rgb.size());
  std::transform(rgb.begin(), rgb.end(), out.begin(),
                 [](float v) { return as_seen(static_cast<double>(v)); });
}

double difference(std::vector<double> const& a, std::size_t i, std::vector<double> const& b,
                  std::size_t j) {
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) sum += std::abs(a[3 * i + c] - b[3 * j + c]);
  return sum;
}

} // namespace

std::vector<std::uint8_t> mark_differences(std::span<float const> rgb, std::size_t width,
                                           std::span<float const> above,
                                           std::span<float const> below, double threshold) {
  std::size_t const count = rgb.size() / 3;
  std::vector<std::uint8_t> marks(count, 0);
  std::vector<double> row, last;
  see(above, last);
  for (std::size_t first = 0; first < count; first += width) {
    see(rgb.subspan(3 * first, 3 * width), row);
    for (std::size_t x = 0; x < width; ++x) {
      std::size_t const i = first + x;
      if (x > 0 && difference(row, x, row, x - 1) >= threshold) marks[i] = marks[i - 1] = 1;
      if (last.empty() || !(difference(row, x, last, x) >= threshold)) continue;
      marks[i] = 1;
      if (first > 0) marks[i - width] = 1;
    }
    std::swap(row, last);
  }
  if (below.empty()) return marks;
  see(below, row);
  for (std::size_t x = 0; x < width; ++x)
    if (difference(row, x, last, x) >= threshold) marks[count - width + x] = 1;
  return marks;
}

std::vector<float> contrasts(std::span<float const> rgb, std::size_t width,
                             std::span<float const> above, std::span<float const> below) {
  std::vector<float> out(rgb.size(), 0);
  std::size_t const row = 3 * width;
  auto const look = [&](std::span<float const> here, std::span<float const> there, float* most) {
    for (std::size_t i = 0; i < row; ++i) {
      most[i] = std::max(most[i], std::abs(there[i] - here[i]));
      if (i >= 3) most[i] = std::max(most[i], std::abs(there[i - 3] - here[i]));
      if (i + 3 < row) most[i] = std::max(most[i], std::abs(there[i + 3] - here[i]));
    }
  };
  for (std::size_t first = 0; first < rgb.size(); first += row) {
    auto const here = rgb.subspan(first, row);
    auto const before = first > 0 ? rgb.subspan(first - row, row) : above;
    auto const behind = first + row < rgb.size() ? rgb.subspan(first + row, row) : below;
    look(here, here, out.data() + first);
    if (!before.empty()) look(here, before, out.data() + first);
    if (!behind.empty()) look(here, behind, out.data() + first);
  }
  return out;
}

} // namespace abbe::render
