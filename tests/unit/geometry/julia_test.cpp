// SPDX-License-Identifier: MIT
#include "geometry/shapes/julia.hpp"
#include "scene.hpp"

#include <cmath>
#include <complex>
#include <gtest/gtest.h>

namespace abbe::geometry::test {
namespace {

using Function = JuliaRule::Function;
using Complex = std::complex<double>;

JuliaRule rule(bool quaternion, Function function, int rounds) {
  JuliaRule out;
  out.quaternion = quaternion;
  out.function = function;
  out.c = {-.2, .35, .15, .1};
  out.rounds = rounds;
  out.power = {2.5, .3};
  double const size = std::sqrt(.1 * .1 + .2 * .2 + .3 * .3 + .7 * .7);
  out.slice = Vec4(.1, .2, .3, .7) / size;
  out.slice_distance = .1;
  return out;
}

/// By the library's own functions of complex numbers.
Complex reference(JuliaRule const& r, Complex z) {
  switch (r.function) {
  case Function::Sqr:
  case Function::Cube:
    return z * z;
  case Function::Exp:
    return std::exp(z);
  case Function::Reciprocal:
    return 1.0 / z;
  case Function::Sin:
    return std::sin(z);
  case Function::Cos:
    return std::cos(z);
  case Function::Sinh:
    return std::sinh(z);
  case Function::Cosh:
    return std::cosh(z);
  case Function::Tan:
    return std::tan(z);
  case Function::Tanh:
    return std::tanh(z);
  case Function::Asin:
    return std::asin(z);
  case Function::Acos:
    return std::acos(z);
  case Function::Atan:
    return std::atan(z);
  case Function::Asinh:
    return std::asinh(z);
  case Function::Acosh:
    return std::acosh(z);
  case Function::Atanh:
    return std::atanh(z);
  case Function::Ln:
    return std::log(z);
  case Function::Power:
    return std::pow(z, r.power);
  }
  return 0;
}

/// The largest square of a size among hypercomplex numbers, less the bailout's. Of squares it is
/// the last: from beyond the bailout none comes back.
double reference_value(JuliaRule const& r, Vec3 const& p) {
  Vec4 const& n = r.slice;
  double const w = (r.slice_distance - n.x * p.x - n.y * p.y - n.z * p.z) / n.w;
  Complex a(p.x - w, p.y + p.z), b(p.x + w, p.y - p.z);
  double most = -1e9;
  for (int round = 1;; ++round) {
    double const own = (std::norm(a) + std::norm(b)) / 2 - 16;
    most = r.function == Function::Sqr ? own : std::max(most, own);
    if (round == r.rounds || most > 0) return most;
    a = reference(r, a) + Complex(r.c.x - r.c.w, r.c.y + r.c.z);
    b = reference(r, b) + Complex(r.c.x + r.c.w, r.c.y - r.c.z);
  }
}

TEST(Julia, HypercomplexNumbersAreTwoComplexOnes) {
  Dice dice(11);
  for (int f = 0; f <= static_cast<int>(Function::Power); ++f) {
    JuliaRule const r = rule(false, static_cast<Function>(f), 3);
    JuliaField const field(r);
    int inside = 0;
    for (int i = 0; i < 300; ++i) {
      Vec3 const p = dice.in_cube(1.5);
      double const wanted = reference_value(r, p);
      inside += wanted < 0 ? 1 : 0;
      if (wanted < 1e3) {
        EXPECT_NEAR(field.value(p), wanted, 1e-9 * (1 + std::fabs(wanted))) << f;
      }
    }
    EXPECT_GT(inside, 20) << f;
  }
}

/// The square of a quaternion h = a + v is a^2 - |v|^2 + 2 a v, its cube a^3 - 3 a |v|^2 + (3 a^2 -
/// |v|^2) v.
TEST(Julia, QuaternionsAreSquaredAndCubed) {
  Dice dice(12);
  for (bool const cube : {false, true}) {
    JuliaRule r = rule(true, cube ? Function::Cube : Function::Sqr, 2);
    r.slice = {0, 0, 0, 1};
    r.slice_distance = 0;
    JuliaField const field(r);
    double const bailout = 1 + std::sqrt(.2 * .2 + .35 * .35 + .15 * .15 + .1 * .1);
    EXPECT_NEAR(r.bailout(), bailout, 1e-15);
    for (int i = 0; i < 200; ++i) {
      Vec3 const p = dice.in_cube(.7);
      double const a = p.x, v2 = p.y * p.y + p.z * p.z;
      double const real = cube ? a * a * a - 3 * a * v2 : a * a - v2,
                   along = cube ? 3 * a * a - v2 : 2 * a;
      Vec4 const h(real + r.c.x, along * p.y + r.c.y, along * p.z + r.c.z, r.c.w);
      double const wanted = h.x * h.x + h.y * h.y + h.z * h.z + h.w * h.w - bailout * bailout;
      EXPECT_NEAR(field.value(p), wanted, 1e-13);
    }
  }
}

TEST(Julia, EnclosuresHoldValuesAndSlopes) {
  Dice dice(13);
  auto const check = [&](JuliaRule const& r, char const* what, int f) {
    JuliaField const field(r);
    int useful = 0;
    for (int i = 0; i < 400; ++i) {
      Vec3 const origin = dice.in_cube(1.2), direction = dice.direction();
      double const width = std::pow(2.0, -dice.number(2, 14));
      auto const over = field.along(origin, direction, {0, width});
      for (int k = 0; k <= 16; ++k) {
        double const t = width * k / 16, value = field.value(origin + t * direction);
        // Far above, only the sign counts.
        bool const held = over.value.holds(value) || (over.value.low > 0 && value > 0)
                          || (over.value.high > 0 && value > 1);
        EXPECT_TRUE(held) << what << f << " " << value;
        if (over.value.low > 0 || !std::isfinite(over.slope.low + over.slope.high)) continue;
        double const step = 1e-7;
        double const slope = (field.value(origin + (t + step) * direction)
                              - field.value(origin + (t - step) * direction))
                             / (2 * step);
        double const room = 1e-4 * (1 + std::fabs(slope));
        if (value < 0) {
          EXPECT_TRUE(over.slope.low - room <= slope && slope <= over.slope.high + room)
              << what << f << " " << slope;
        }
        useful += over.slope.holds(0) ? 0 : 1;
      }
    }
    EXPECT_GT(useful, 100) << what << f;
  };
  for (int f = 0; f <= static_cast<int>(Function::Power); ++f)
    check(rule(false, static_cast<Function>(f), 3), "hypercomplex ", f);
  check(rule(true, Function::Sqr, 5), "quaternion ", 0);
  check(rule(true, Function::Cube, 4), "quaternion ", 1);
}

/// Each of the kernels against what is said of one piece, and against the field itself.
TEST(Julia, PiecesSideBySideHoldWhatOneByOneDo) {
  Dice dice(15);
  auto const check = [&](JuliaRule const& r, char const* what) {
    JuliaField const field(r);
    ASSERT_EQ(field.side_by_side(), LinePieces::most);
    int useful = 0;
    for (int i = 0; i < 300; ++i) {
      Vec3 const origin = dice.in_cube(1.2), direction = dice.direction();
      double const width = std::pow(2.0, -dice.number(2, 18));
      LinePieces pieces;
      pieces.count = 1 + i % LinePieces::most;
      for (int k = 0; k < LinePieces::most; ++k) {
        pieces.low[k] = width * std::min(k, pieces.count - 1);
        pieces.high[k] = pieces.low[k] + width;
      }
      field.along_each(origin, direction, pieces);
      for (int k = 0; k < pieces.count; ++k) {
        Interval const part(pieces.low[k], pieces.high[k]);
        auto const one = field.along(origin, direction, part);
        Interval const value(pieces.value_low[k], pieces.value_high[k]),
            middle(pieces.middle_low[k], pieces.middle_high[k]);
        double const here = field.value(origin + part.middle() * direction);
        if (value.low > 0) {
          EXPECT_GT(here, 0) << what;
          continue;
        }
        EXPECT_TRUE(middle.holds(here) || (middle.high > 0 && here > 0)) << what << here;
        for (int j = 0; j <= 8; ++j) {
          double const there = field.value(origin + (part.low + width * j / 8) * direction);
          EXPECT_TRUE(value.holds(there) || (value.high > 0 && there > 0)) << what << there;
        }
        if (here >= 0 || !std::isfinite(one.slope.size())) continue;
        double const step = 1e-7, t = part.middle();
        double const slope = (field.value(origin + (t + step) * direction)
                              - field.value(origin + (t - step) * direction))
                             / (2 * step);
        double const room = 1e-4 * (1 + std::fabs(slope));
        EXPECT_LE(pieces.slope_low[k] - room, slope) << what;
        EXPECT_GE(pieces.slope_high[k] + room, slope) << what;
        EXPECT_LE(value.width(), 1.001 * one.value.width() + 1e-9) << what;
        useful += pieces.slope_low[k] > 0 || pieces.slope_high[k] < 0 ? 1 : 0;
      }
    }
    EXPECT_GT(useful, 50) << what;
  };
  check(rule(true, Function::Sqr, 6), "squares ");
  check(rule(true, Function::Cube, 5), "cubes ");
  check(rule(false, Function::Sqr, 6), "pairs ");
  JuliaRule far = rule(false, Function::Sqr, 2);
  far.c = {-4.3, .3, .1, 0};
  check(far, "returning pairs ");
}

TEST(Julia, GradientsAreThoseOfTheField) {
  Dice dice(16);
  for (JuliaRule const& r : {rule(true, Function::Sqr, 5), rule(true, Function::Cube, 4),
                             rule(false, Function::Sqr, 5), rule(false, Function::Exp, 3)}) {
    JuliaField const field(r);
    for (int i = 0; i < 100; ++i) {
      Vec3 const p = dice.in_cube(.6), gradient = field.gradient(p);
      if (field.value(p) > 0) continue;
      for (int axis = 0; axis < 3; ++axis) {
        Vec3 step(0);
        step[axis] = 1e-6;
        double const wanted = (field.value(p + step) - field.value(p - step)) / 2e-6;
        EXPECT_NEAR(gradient[axis], wanted, 1e-4 * (1 + std::fabs(wanted)));
      }
    }
  }
}

/// A ray that starts on the surface finds what it would find if all of its line were looked at.
TEST(Julia, WhatLiesAheadOfAStartIsWhatTheWholeLineHolds) {
  Dice dice(17);
  auto const shape = *make_julia_fractal(rule(true, Function::Sqr, 6), 100);
  auto const first_ahead = [](Crossings& of) {
    std::sort(of.begin(), of.end(), [](auto const& a, auto const& b) { return a.t < b.t; });
    for (Crossing const& c : of)
      if (c.t > 0) return c;
    return Crossing{};
  };
  int found = 0, starts = 0;
  for (int i = 0; i < 400; ++i) {
    Vec3 const direction = dice.direction();
    Ray ray = ray_from(dice.in_cube(.8) - 5.0 * direction, direction);
    Crossings out;
    shape.shape->crossings_ahead(ray, nullptr, 1e9, out);
    if (out.empty()) continue;
    ++starts;
    ray.origin = ray.origin + out[0].t * direction;
    ray.origin_error = Vec3(1e-15);
    Vec3 const normal = shape.shape->normal(ray.origin, out[0].face);
    ray.direction = dice.direction();
    Start const start{out[0].face, glm::dot(normal, ray.direction) < 0};
    Crossings all, ahead;
    shape.shape->crossings(ray, &start, all);
    shape.shape->crossings_ahead(ray, &start, 1e9, ahead);
    Crossing const wanted = first_ahead(all), own = first_ahead(ahead);
    EXPECT_NEAR(own.t, wanted.t, 2 * (own.error + wanted.error)) << i;
    EXPECT_EQ(own.entering, wanted.entering) << i;
    found += wanted.t > 0 ? 1 : 0;
  }
  EXPECT_GT(starts, 100);
  EXPECT_GT(found, 50);
}

TEST(Julia, NoPassageOfTheSurfaceIsMissed) {
  Dice dice(14);
  for (bool const quaternion : {true, false}) {
    JuliaRule const r = rule(quaternion, Function::Sqr, 6);
    JuliaField const field(r);
    auto const shape = *make_julia_fractal(r, 100);
    int hits = 0;
    for (int i = 0; i < 300; ++i) {
      Vec3 const direction = dice.direction();
      Ray const ray = ray_from(dice.in_cube(.8) - 5.0 * direction, direction);
      Crossings out;
      shape.shape->crossings(ray, nullptr, out);
      std::sort(out.begin(), out.end(), [](auto const& a, auto const& b) { return a.t < b.t; });
      ASSERT_EQ(out.size() % 2, 0U);
      std::size_t next = 0;
      for (int k = 0; k < 4000; ++k) {
        double const t = 2 + k * .0015;
        while (next < out.size() && out[next].t < t) ++next;
        bool const near = (next < out.size() && out[next].t - t < 1e-9)
                          || (next > 0 && t - out[next - 1].t < 1e-9);
        bool const inside = next % 2 != 0;
        if (!near) {
          EXPECT_EQ(field.value(ray.origin + t * direction) < 0, inside) << i << " " << t;
        }
        hits += inside ? 1 : 0;
      }
    }
    EXPECT_GT(hits, 1000);
  }
}

} // namespace
} // namespace abbe::geometry::test
