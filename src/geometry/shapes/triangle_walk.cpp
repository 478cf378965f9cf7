// SPDX-License-Identifier: MIT
#include "geometry/shapes/triangle_walk.hpp"

#include "simd/native.hpp"

#include <bit>

namespace abbe::geometry {

template <class L>
unsigned TriangleWalk::hit(std::uint32_t first, std::uint32_t count) const {
  constexpr std::size_t width = simd::width<L>;
  Corners const* face[width];
  for (std::size_t k = 0; k < width; ++k) face[k] = faces_ + first + (k < count ? k : count - 1);
  struct Flat {
    L x, y;
  };
  auto const flat = [&](std::size_t corner) {
    auto const along = [&](int axis) {
      auto const of = [&](std::size_t k) { return vertices_[(*face[k])[corner]][axis]; };
      return L(of(0), of(1), of(2), of(3)) - L(line_.point[axis]);
    };
    L const z = along(line_.kz);
    return Flat{along(line_.kx) - L(line_.sx) * z, along(line_.ky) - L(line_.sy) * z};
  };
  Flat const a = flat(0), b = flat(1), c = flat(2);
  auto const edge = [](Flat const& p, Flat const& q) { return p.x * q.y - p.y * q.x; };
  L const zero(0.0), u = edge(b, c), v = edge(c, a), w = edge(a, b);
  // On an edge, up to what hit_triangle() finds in more digits.
  auto const left = both(both(zero <= u, zero <= v), zero <= w);
  auto const right = both(both(u <= zero, v <= zero), w <= zero);
  auto const in = either(left, right);
  if (none(in)) return 0;
  alignas(64) double is[width];
  store(is, select(in, L(1.0), zero));
  unsigned out = 0;
  for (std::size_t k = 0; k < count; ++k) out |= (is[k] != 0 ? 1U : 0U) << k;
  return out;
}

struct TriangleWalk::Search {
  template <class L>
  static bool run(TriangleWalk& walk, double to) {
    for (;;) {
      // A line whose numbers are too large for any axis to be tested meets the empty boxes too.
      while (walk.leaf_.count == 0)
        if (!walk.walk_.next_in<L>(to, walk.leaf_)) return false;
      auto const count = std::min(walk.leaf_.count, std::uint32_t{simd::width<L>});
      walk.first_ = walk.leaf_.first;
      walk.hits_ = walk.hit<L>(walk.first_, count);
      walk.leaf_ = {walk.first_ + count, walk.leaf_.count - count};
      if (walk.hits_ != 0) return true;
    }
  }
};

bool TriangleWalk::next(double to, std::uint32_t& face) {
  static constexpr simd::Native<Search, 4> search;
  if (hits_ == 0 && !search(*this, to)) return false;
  face = first_ + static_cast<std::uint32_t>(std::countr_zero(hits_));
  hits_ &= hits_ - 1;
  return true;
}

} // namespace abbe::geometry
