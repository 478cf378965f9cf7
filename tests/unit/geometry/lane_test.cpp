// SPDX-License-Identifier: MIT
#include "geometry/shapes/quadric_kernel.hpp"
#include "scene.hpp"

#include <bit>
#include <gtest/gtest.h>

namespace abbe::geometry::test {
namespace {
using lane::Double4;

template <class L>
Line<L> pack(std::vector<Line<double>> const& lines) {
  auto const four = [&](auto get) {
    return Double4(get(lines[0]), get(lines[1]), get(lines[2]), get(lines[3]));
  };
  auto const vec = [&](auto member) {
    return lane::Vec<Double4>{four([&](auto const& l) { return (l.*member).x; }),
                              four([&](auto const& l) { return (l.*member).y; }),
                              four([&](auto const& l) { return (l.*member).z; })};
  };
  return {vec(&Line<double>::origin), vec(&Line<double>::direction),
          vec(&Line<double>::origin_rounding), vec(&Line<double>::direction_rounding),
          vec(&Line<double>::slack)};
}

void same_bits(double a, double b) {
  EXPECT_EQ(std::bit_cast<std::uint64_t>(a + 0.0), std::bit_cast<std::uint64_t>(b + 0.0));
}
void same(Root<double> const& a, Root<Double4> const& b, int i) {
  same_bits(a.t, lane::get(b.t, i));
  if (!std::isfinite(a.t)) return;
  same_bits(a.error, lane::get(b.error, i));
  same_bits(a.slack, lane::get(b.slack, i));
}

std::vector<Line<double>> four_lines(Dice& dice, int round) {
  std::vector<Line<double>> lines;
  for (int i = 0; i < 4; ++i) {
    Vec3 direction = dice.direction();
    if (round % 7 == 0) direction[dice.below(3)] = 0;
    if (round % 11 == 0) direction = Vec3(0, 1, 0);
    double const far = round % 3 == 0 ? 1e6 : 2.0;
    Ray ray{dice.in_cube(1.2) - far * direction, direction, Vec3(1e-15)};
    ray.origin_rounding = Vec3(1e-16);
    ray.direction_rounding = Vec3(2e-16);
    lines.push_back(line_of(ray));
  }
  return lines;
}

/// Scalar and four lanes must agree in every bit (law 2).
TEST(Lanes, KernelsGiveTheBitsOfScalars) {
  Dice dice(1);
  for (int round = 0; round < 2000; ++round) {
    auto const lines = four_lines(dice, round);
    Line<Double4> const packed = pack<Double4>(lines);
    auto const check = [&](auto const& kernel) {
      Slice<Double4> const all = kernel(packed);
      for (int i = 0; i < 4; ++i) {
        Slice<double> const one = kernel(lines[static_cast<std::size_t>(i)]);
        same(one.in, all.in, i);
        same(one.out, all.out, i);
        same_bits(one.in_face, lane::get(all.in_face, i));
        same_bits(one.out_face, lane::get(all.out_face, i));
      }
    };
    check([]<class L>(Line<L> const& l) { return kernels::sphere(l); });
    check([]<class L>(Line<L> const& l) { return kernels::cube(l); });
    check([]<class L>(Line<L> const& l) { return kernels::cylinder(l); });
    check([]<class L>(Line<L> const& l) { return kernels::cone(l, L(0.6), L(-0.4)); });
    check([]<class L>(Line<L> const& l) {
      return kernels::half_space(l, lane::Vec<L>{L(0.6), L(0.0), L(0.8)}, L(0.0));
    });
    auto const quadric = []<class L>(Line<L> const& l) {
      L const k[10] = {L(1), L(-2), L(1.5), L(.3), L(0), L(.1), L(.2), L(0), L(-1), L(-1)};
      return kernels::quadric(l, k);
    };
    auto const all = quadric(packed);
    for (int i = 0; i < 4; ++i) {
      auto const one = quadric(lines[static_cast<std::size_t>(i)]);
      same_bits(one.exists, lane::get(all.exists, i));
      if (one.exists == 0) continue;
      same(one.low, all.low, i);
      same(one.high, all.high, i);
    }
  }
}

TEST(Lanes, ProductErrorIsExact) {
  Dice dice(2);
  for (int i = 0; i < 10000; ++i) {
    double const a = dice.number(-3, 3), b = dice.number(-1e5, 1e5), p = a * b;
    // fma computes a b - p with one rounding, and the true difference is a double.
    EXPECT_EQ(lane::product_error(a, b, p), std::fma(a, b, -p));
  }
}

} // namespace
} // namespace abbe::geometry::test
