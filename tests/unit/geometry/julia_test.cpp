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

/// The largest square of a size among the numbers, less the bailout's; of hypercomplex ones.
double reference_value(JuliaRule const& r, Vec3 const& p) {
  Vec4 const& n = r.slice;
  double const w = (r.slice_distance - n.x * p.x - n.y * p.y - n.z * p.z) / n.w;
  Complex a(p.x - w, p.y + p.z), b(p.x + w, p.y - p.z);
  double most = -1e9;
  for (int round = 1;; ++round) {
    most = std::max(most, (std::norm(a) + std::norm(b)) / 2 - 16);
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
