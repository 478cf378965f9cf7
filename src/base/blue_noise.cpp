// SPDX-License-Identifier: MIT
#include "base/blue_noise.hpp"

#include "base/random.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace abbe {
namespace {

constexpr int size = 64;
constexpr int cells = size * size;

/// Pixels that are set, and at each pixel how crowded it is: the sum of Gaussians about them.
class Pattern {
public:
  Pattern() {
    constexpr double sigma = 1.5; // Ulichney's choice
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        double const dx = std::min(x, size - x), dy = std::min(y, size - y);
        // A whole number: sums are then the same in any order.
        gauss_[at(x, y)] =
            std::llround(std::exp(-(dx * dx + dy * dy) / (2 * sigma * sigma)) * 0x1p40);
      }
  }

  bool is_set(int cell) const { return set_[static_cast<std::size_t>(cell)]; }
  void put(int cell, bool on) {
    set_[static_cast<std::size_t>(cell)] = on;
    int const cx = cell % size, cy = cell / size;
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        auto const g = gauss_[at((x - cx + size) % size, (y - cy + size) % size)];
        crowd_[at(x, y)] += on ? g : -g;
      }
  }
  int tightest_cluster() const { return extreme(true); }
  int largest_void() const { return extreme(false); }

private:
  static std::size_t at(int x, int y) { return static_cast<std::size_t>(y * size + x); }
  int extreme(bool of_set) const {
    int best = -1;
    for (int i = 0; i < cells; ++i) {
      auto const k = static_cast<std::size_t>(i);
      if (set_[k] != of_set) continue;
      auto const value = of_set ? -crowd_[k] : crowd_[k];
      if (best < 0 || value < (of_set ? -1 : 1) * crowd_[static_cast<std::size_t>(best)]) best = i;
    }
    return best;
  }

  std::array<std::int64_t, cells> gauss_{}, crowd_{};
  std::array<bool, cells> set_{};
};

std::vector<double> make() {
  Pattern pattern;
  RandomKey const key(0);
  int const first = cells / 10;
  for (int n = 0; n < first;) {
    int const cell = static_cast<int>(key.uniform(static_cast<std::uint64_t>(n)) * cells);
    int free = cell;
    while (pattern.is_set(free)) free = (free + 1) % cells;
    pattern.put(free, true);
    ++n;
  }
  for (;;) { // until the tightest cluster, taken out, leaves the largest void
    int const from = pattern.tightest_cluster();
    pattern.put(from, false);
    int const to = pattern.largest_void();
    pattern.put(to, true);
    if (to == from) break;
  }
  std::vector<double> rank(cells);
  Pattern thinning = pattern;
  for (int n = first - 1; n >= 0; --n) {
    int const cell = thinning.tightest_cluster();
    thinning.put(cell, false);
    rank[static_cast<std::size_t>(cell)] = n;
  }
  for (int n = first; n < cells; ++n) {
    int const cell = pattern.largest_void();
    pattern.put(cell, true);
    rank[static_cast<std::size_t>(cell)] = n;
  }
  for (double& r : rank) r = (r + 0.5) / cells;
  return rank;
}

} // namespace

double blue_noise(std::int64_t x, std::int64_t y) {
  static std::vector<double> const mask = make();
  auto const wrapped = [](std::int64_t v) { return ((v % size) + size) % size; };
  return mask[static_cast<std::size_t>(wrapped(y) * size + wrapped(x))];
}

} // namespace abbe
