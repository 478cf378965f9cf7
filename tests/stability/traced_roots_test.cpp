// SPDX-License-Identifier: MIT
#include "geometry/placed.hpp"
#include "lang/evaluate.hpp"

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <random>
#include <vector>

/// Shapes whose surface is searched along the line, against the functions that they are the zeros
/// of, in 50 digits: each root is within its error, its error is of the order of rounding where the
/// line does not graze, and between roots the line is on the side that they say.
namespace abbe::geometry {
namespace {

using Wide = boost::multiprecision::cpp_bin_float_50;

/// At most 0 inside; in doubles, and in 50 digits.
struct Truth {
  std::function<double(std::array<double, 3> const&)> near;
  std::function<Wide(std::array<Wide, 3> const&)> exact;
};
template <class F>
Truth truth(F f) {
  return {f, f};
}

template <class T>
T square(T const& x) {
  return x * x;
}

/// A point of the curve that POV-Ray makes of four points, c0 + c1 u + ..., and its slope.
template <class T>
struct Curve {
  std::array<T, 4> c;
  T at(T const& u) const { return ((c[3] * u + c[2]) * u + c[1]) * u + c[0]; }
  T slope(T const& u) const { return (3 * c[3] * u + 2 * c[2]) * u + c[1]; }
  T bend(T const& u) const { return 6 * c[3] * u + 2 * c[2]; }
};
template <class T>
Curve<T> cubic(double a, double b, double c, double d) {
  T const left = (T(c) - a) / 2, right = (T(d) - b) / 2, rise = T(c) - b;
  return {{T(b), left, 3 * rise - 2 * left - right, left + right - 2 * rise}};
}
template <class T>
Curve<T> b_spline(double a, double b, double c, double d) {
  return {{(a + 4 * T(b) + c) / 6, (T(c) - a) / 2, (a - 2 * T(b) + c) / 2,
           (d - T(a) + 3 * (T(b) - c)) / 6}};
}

using Points2 = std::vector<std::array<double, 2>>;
using Points4 = std::vector<std::array<double, 4>>;

/// Inside of a cubic_spline whose heights ascend, and of its lids.
Truth lathe_of(Points2 const& p) {
  return truth([p]<class T>(std::array<T, 3> const& at) {
    using std::sqrt;
    std::size_t const n = p.size();
    T const low = p[1][1] - at[1], high = at[1] - p[n - 2][1];
    T const beyond = low > high ? low : high;
    if (beyond > 0) return beyond;
    std::size_t k = 0;
    while (k + 5 <= n && T(p[k + 2][1]) < at[1]) ++k;
    auto const r = cubic<T>(p[k][0], p[k + 1][0], p[k + 2][0], p[k + 3][0]);
    auto const y = cubic<T>(p[k][1], p[k + 1][1], p[k + 2][1], p[k + 3][1]);
    T u = 0.5;
    for (int i = 0; i < 12; ++i) u -= (y.at(u) - at[1]) / y.slope(u);
    T const side = sqrt(square(at[0]) + square(at[2])) - r.at(u);
    return side > beyond ? side : beyond;
  });
}

Truth sor_of(Points2 const& p) {
  return truth([p]<class T>(std::array<T, 3> const& at) {
    std::size_t const n = p.size();
    T const low = p[1][1] - at[1], high = at[1] - p[n - 2][1];
    T const beyond = low > high ? low : high;
    if (beyond > 0) return beyond;
    std::size_t k = 1;
    while (k + 3 < n && T(p[k + 1][1]) < at[1]) ++k;
    T const tall = T(p[k + 1][1]) - p[k][1], v = (at[1] - p[k][1]) / tall;
    auto const slope = [&](std::size_t i) {
      return 2 * p[i][0] * (T(p[i + 1][0]) - p[i - 1][0]) / (T(p[i + 1][1]) - p[i - 1][1]) * tall;
    };
    T const from = square(T(p[k][0])), rise = square(T(p[k + 1][0])) - from;
    T const a = slope(k), b = slope(k + 1);
    T const radius2 = ((a + b - 2 * rise) * v + 3 * rise - 2 * a - b) * v * v + a * v + from;
    T const side = square(at[0]) + square(at[2]) - radius2;
    return side > beyond ? side : beyond;
  });
}

template <class T>
using Spline = Curve<T> (*)(double, double, double, double);
/// The least of |p - c(u)|^2 - r(u)^2.
template <class T>
T sweep_at(Spline<T> spline, Points4 const& p, std::array<T, 3> const& at) {
  T least = 1e30;
  for (std::size_t k = 0; k + 3 < p.size(); ++k) {
    std::array<Curve<T>, 4> c;
    for (std::size_t i = 0; i < 4; ++i)
      c[i] = spline(p[k][i], p[k + 1][i], p[k + 2][i], p[k + 3][i]);
    auto const value = [&](T const& u) {
      T sum = -square(c[3].at(u));
      for (std::size_t i = 0; i < 3; ++i) sum += square(at[i] - c[i].at(u));
      return sum;
    };
    constexpr int parts = 24;
    std::array<T, parts + 1> g;
    for (int i = 0; i <= parts; ++i) g[static_cast<std::size_t>(i)] = value(T(i) / parts);
    for (std::size_t i = 0; i <= parts; ++i) {
      if (g[i] < least) least = g[i];
      if ((i > 0 && g[i - 1] < g[i]) || (i < parts && g[i + 1] < g[i])) continue;
      T u = T(static_cast<int>(i)) / parts;
      for (int step = 0; step < 9; ++step) {
        T first = -c[3].at(u) * c[3].slope(u);
        T second = -square(c[3].slope(u)) - c[3].at(u) * c[3].bend(u);
        for (std::size_t j = 0; j < 3; ++j) {
          first -= (at[j] - c[j].at(u)) * c[j].slope(u);
          second += square(c[j].slope(u)) - (at[j] - c[j].at(u)) * c[j].bend(u);
        }
        u -= first / second;
      }
      if (u > 0 && u < 1) {
        T const v = value(u);
        if (v < least) least = v;
      }
    }
  }
  return least;
}

struct Case {
  char const* name;
  std::string text;
  Truth truth;
  double most = 100; ///< roundings of the line's length in the error
};

std::vector<Case> cases() {
  using std::abs, std::cos, std::max, std::pow, std::sin, std::sqrt;
  std::vector<Case> all;
  auto const add = [&](char const* name, std::string text, Truth t, double most = 100) {
    all.push_back({name, std::move(text), std::move(t), most});
  };
  auto const isosurface = [&](char const* name, std::string const& function, Truth t) {
    add(name, "isosurface { function { " + function + " } contained_by { sphere { 0, 2 } } }",
        std::move(t));
  };
  isosurface("octahedron", "abs(x) + abs(y) + abs(z) - 1",
             truth([]<class T>(std::array<T, 3> const& p) -> T {
               return abs(p[0]) + abs(p[1]) + abs(p[2]) - 1;
             }));
  isosurface("cube", "max(abs(x), abs(y), abs(z)) - .75",
             truth([]<class T>(std::array<T, 3> const& p) -> T {
               return max(T(abs(p[0])), max(T(abs(p[1])), T(abs(p[2])))) - 0.75;
             }));
  isosurface("torus by sqrt", "sqrt(pow(sqrt(x*x + z*z) - .75, 2) + y*y) - .25",
             truth([]<class T>(std::array<T, 3> const& p) -> T {
               T const ring = sqrt(square(p[0]) + square(p[2])) - 0.75;
               return sqrt(square(ring) + square(p[1])) - 0.25;
             }));
  isosurface("waves", "y + .25*sin(4*x)*cos(3*z) + (x*x + y*y + z*z - 1)",
             truth([]<class T>(std::array<T, 3> const& p) -> T {
               return p[1] + sin(T(4 * p[0])) * cos(T(3 * p[2])) / 4
                      + (square(p[0]) + square(p[1]) + square(p[2]) - 1);
             }));
  auto const superellipsoid = [&](char const* name, std::string const& text, double e, double n) {
    add(name, "superellipsoid { <" + text + "> }",
        truth([e, n]<class T>(std::array<T, 3> const& p) -> T {
          auto const power = [](T const& x, double k) -> T {
            return x == 0 ? T(0) : T(pow(x, T(k)));
          };
          T const x = abs(p[0]), y = abs(p[1]), z = abs(p[2]);
          return power(T(power(x, 2 / e) + power(y, 2 / e)), e / n) + power(z, 2 / n) - 1;
        }));
  };
  superellipsoid("boxy superellipsoid", ".25, .5", .25, .5);
  superellipsoid("round and sharp superellipsoid", "1, 2", 1, 2);
  superellipsoid("hollow superellipsoid", "4, 2", 4, 2);
  add("blob",
      "blob { threshold .5 sphere { <-.5, 0, 0>, 1, 1 } sphere { <.5, .25, 0>, .5, 1.5 } "
      "sphere { <0, -.25, .25>, .5, -.75 } cylinder { -x, x, .5, .75 } }",
      truth([]<class T>(std::array<T, 3> const& p) -> T {
        auto const density = [](T const& distance2, double radius, double strength) -> T {
          T const rest = 1 - distance2 / (radius * radius);
          return rest > 0 ? T(strength * square(rest)) : T(0);
        };
        auto const ball = [&](double x, double y, double z, double radius, double strength) -> T {
          return density(square(T(p[0] - x)) + square(T(p[1] - y)) + square(T(p[2] - z)), radius,
                         strength);
        };
        T const over = max(T(abs(p[0]) - 1), T(0));
        return 0.5 - ball(-.5, 0, 0, 1, 1) - ball(.5, .25, 0, .5, 1.5)
               - ball(0, -.25, .25, .5, -.75)
               - density(square(over) + square(p[1]) + square(p[2]), .5, .75);
      }),
      4000); // the coefficients of a sum of components are larger than the sum

  Points2 const profile{{.25, -1.25}, {.5, -1}, {1, -.5}, {.5, .25}, {.75, .75}, {.25, 1}};
  std::string points;
  for (auto const& p : profile)
    points += ", <" + std::to_string(p[0]) + "," + std::to_string(p[1]) + ">";
  add("lathe", "lathe { cubic_spline 6" + points + " }", lathe_of(profile), 4000);
  add("sor", "sor { 6" + points + " }", sor_of(profile), 1000);
  Points4 const balls{{-1.5, -.5, 0, .25},
                      {-.75, 0, .25, .5},
                      {0, -.25, 0, .25},
                      {.75, .5, -.25, .375},
                      {1, 0, 0, .25}};
  std::string spheres;
  for (auto const& p : balls)
    spheres += ", <" + std::to_string(p[0]) + "," + std::to_string(p[1]) + ","
               + std::to_string(p[2]) + ">, " + std::to_string(p[3]);
  add("sphere_sweep, cubic_spline", "sphere_sweep { cubic_spline 5" + spheres + " }",
      {[balls](auto const& p) { return sweep_at<double>(cubic<double>, balls, p); },
       [balls](auto const& p) { return sweep_at<Wide>(cubic<Wide>, balls, p); }});
  add("poly of order 6",
      "poly { 6, <1, 0,0,0,0,0,0,0,0,0, 0,0,0,0,0,0,0,0,0,0, 0,0,0,0,0,0,0,0,0,0, "
      "0,0,0,0,0,0,0,0,0,0, 0,0,0,0,0,0,0,0,0,0, 0,0,0,0,0,0, 1, 0,0,0,0,0,0,0,0,0,0, "
      "0,0,0,0,0,0,0,0,0,0, 1,0,0,0,0,0,-.125> }",
      truth([]<class T>(std::array<T, 3> const& p) -> T {
        T sum = -0.125;
        for (T const& x : p) sum += square(T(x * x * x));
        return sum;
      }));
  add("quartic",
      "quartic { <1, 0, 0, 0, 2, 0, 0, 2, 0, -1.25, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 2, 0, "
      "1, "
      "0, 0, 0, 0, 1, 0, -1.25, 0, .25> }",
      truth([]<class T>(std::array<T, 3> const& p) -> T { // a torus of radii .75 and .25
        T const ring = square(p[0]) + square(p[2]), whole = ring + square(p[1]);
        return square(T(whole + 0.5)) - 2.25 * ring;
      }));
  return all;
}

struct Line {
  Vec3 origin, direction;
  template <class T>
  std::array<T, 3> at(T const& t) const {
    return {origin.x + t * direction.x, origin.y + t * direction.y, origin.z + t * direction.z};
  }
};

class SearchedRoots : public ::testing::TestWithParam<Case> {};

TEST_P(SearchedRoots, AreWithinTheirErrorsWhichAreOfTheOrderOfRounding) {
  Case const& c = GetParam();
  lang::EvaluateOptions options;
  options.stdlib_dir = ABBE_STDLIB_DIR;
  auto const evaluated = lang::evaluate_text("test.scn", c.text, options);
  ASSERT_TRUE(evaluated.ok()) << c.text;
  ASSERT_EQ(evaluated.scene.objects.size(), 1U);
  auto const& object = evaluated.scene.objects.front();
  Placed const placed(object.shape, object.placement);
  std::mt19937_64 dice(7);
  auto const number = [&] { return 2 * (static_cast<double>(dice() >> 11) * 0x1p-53) - 1; };
  int roots = 0;
  double widest = 0;
  for (int i = 0; i < 300; ++i) {
    Vec3 const aim(number(), number(), number()), from(number(), number(), number());
    Vec3 const d = glm::normalize(from);
    Line const line{aim - (i % 3 == 0 ? .25 : 4.0) * d, d};
    Crossings found;
    placed.shape().crossings(placed.to_object({line.origin, line.direction}), nullptr, found);
    std::sort(found.begin(), found.end(), [](auto const& a, auto const& b) { return a.t < b.t; });
    double before = -8;
    for (std::size_t k = 0; k <= found.size(); ++k) {
      double const next = k < found.size() ? found[k].t : 8;
      bool const inside = k > 0 && found[k - 1].entering;
      for (int part = 1; part < 16; ++part) {
        double const t = before + (next - before) * part / 16;
        double const value = c.truth.near(line.at(t));
        if (std::fabs(value) > 1e-12) {
          ASSERT_EQ(value < 0, inside) << "line " << i << " at " << t;
        }
      }
      before = next;
    }
    for (std::size_t k = 0; k < found.size(); ++k) {
      Crossing const& root = found[k];
      bool const close = (k > 0 && root.t - found[k - 1].t < 4 * root.error)
                         || (k + 1 < found.size() && found[k + 1].t - root.t < 4 * root.error);
      if (close) continue;
      ++roots;
      Wide const low = c.truth.exact(line.at(Wide(root.t) - root.error));
      Wide const high = c.truth.exact(line.at(Wide(root.t) + root.error));
      EXPECT_TRUE(root.entering ? low > 0 && high < 0 : low < 0 && high > 0)
          << "line " << i << " at " << root.t << " error " << root.error;
      // How fast it passes through the surface, by the neighbourhood.
      double const h = 1e-5;
      auto const at = [&](double t, Vec3 const& beside) {
        Line const other{line.origin + beside, line.direction};
        return c.truth.near(other.at(t));
      };
      Vec3 slope;
      for (int axis = 0; axis < 3; ++axis) {
        Vec3 side(0);
        side[axis] = h;
        slope[axis] = (at(root.t, side) - at(root.t, -side)) / (2 * h);
      }
      double const speed = std::fabs(glm::dot(slope, d)) / std::sqrt(glm::dot(slope, slope));
      if (speed < .1) continue;
      widest = std::max(widest, root.error * speed / (unit_roundoff * (4 + std::fabs(root.t))));
    }
  }
  RecordProperty("widest", std::to_string(widest));
  EXPECT_GT(roots, 150);
  EXPECT_LT(widest, c.most) << "roundings";
}

INSTANTIATE_TEST_SUITE_P(All, SearchedRoots, ::testing::ValuesIn(cases()), [](auto const& given) {
  std::string name = given.param.name;
  std::erase_if(name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); });
  return name;
});

} // namespace
} // namespace abbe::geometry
