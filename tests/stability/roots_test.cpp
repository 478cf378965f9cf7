// SPDX-License-Identifier: MIT
#include "geometry/roots.hpp"
#include "geometry/shapes/polynomial_surface.hpp"
#include "geometry/shapes/sphere.hpp"
#include "geometry/shapes/torus.hpp"

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <vector>

/// Numbers of roots against exact rational arithmetic on the same doubles.
namespace abbe::geometry {
namespace {

using Integer = boost::multiprecision::cpp_int;
using Rational = boost::multiprecision::cpp_rational;
using Exact = std::vector<Rational>; // a polynomial, ascending powers

class Dice {
public:
  explicit Dice(unsigned seed) : engine_(seed) {}
  double number(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  Vec3 direction() {
    for (;;) {
      double const x = number(-1, 1), y = number(-1, 1), z = number(-1, 1);
      double const length = std::sqrt(x * x + y * y + z * z);
      if (length > 0.1 && length < 1) return Vec3(x, y, z) / length;
    }
  }

private:
  std::mt19937_64 engine_;
};

Exact product(Exact const& a, Exact const& b) {
  Exact out(a.size() + b.size() - 1, Rational(0));
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) out[i + j] += a[i] * b[j];
  return out;
}

/// Without the common divisor of its coefficients, which grow fast otherwise.
void make_primitive(std::vector<Integer>& p) {
  while (!p.empty() && p.back() == 0) p.pop_back();
  Integer divisor = 0;
  for (auto const& c : p) divisor = gcd(divisor, c);
  if (divisor > 1)
    for (auto& c : p) c /= divisor;
}

/// Distinct real roots of all t, by Sturm's theorem; its chain in integers.
int distinct_roots(Exact const& rational) {
  Integer common = 1;
  for (auto const& c : rational) common = lcm(common, denominator(c));
  std::vector<Integer> p;
  for (auto const& c : rational) p.push_back(numerator(c) * (common / denominator(c)));
  make_primitive(p);
  if (p.size() < 2) return 0;
  std::vector<Integer> derivative;
  for (std::size_t i = 1; i < p.size(); ++i) derivative.push_back(p[i] * static_cast<int>(i));
  make_primitive(derivative);
  std::vector<std::vector<Integer>> chain{p, derivative};
  while (chain.back().size() > 1) {
    std::vector<Integer> rest = chain[chain.size() - 2];
    std::vector<Integer> const& by = chain.back();
    Integer const whole = abs(by.back());
    while (rest.size() >= by.size()) {
      Integer const factor = by.back() < 0 ? Integer(-rest.back()) : rest.back();
      std::size_t const shift = rest.size() - by.size();
      for (auto& c : rest) c *= whole; // positive: signs stay
      for (std::size_t i = 0; i < by.size(); ++i) rest[shift + i] -= factor * by[i];
      while (!rest.empty() && rest.back() == 0) rest.pop_back();
    }
    make_primitive(rest);
    if (rest.empty()) break;
    for (auto& c : rest) c = -c;
    chain.push_back(rest);
  }
  auto const changes = [&](bool at_plus) {
    int count = 0, last = 0;
    for (auto const& q : chain) {
      int sign = q.back() > 0 ? 1 : -1;
      if (!at_plus && q.size() % 2 == 0) sign = -sign;
      if (last != 0 && sign != last) ++count;
      last = sign;
    }
    return count;
  };
  return changes(false) - changes(true);
}

std::array<Rational, 3> exact(Vec3 const& v) {
  return {Rational(v.x), Rational(v.y), Rational(v.z)};
}
/// |p(t)|^2 over some of the components.
Exact square_of(Ray const& ray, std::initializer_list<int> axes) {
  auto const o = exact(ray.origin), d = exact(ray.direction);
  Exact out(3, Rational(0));
  for (int const i : axes) {
    auto const k = static_cast<std::size_t>(i);
    out[0] += o[k] * o[k];
    out[1] += 2 * o[k] * d[k];
    out[2] += d[k] * d[k];
  }
  return out;
}

int found(Shape const& shape, Ray const& ray) {
  Crossings out;
  shape.crossings(ray, nullptr, out);
  return static_cast<int>(out.size());
}

/// A line through two places `apart` from one another on the unit sphere, seen from `distance`.
Ray chord_of_sphere(Dice& dice, double apart, double distance) {
  Vec3 const a = dice.direction();
  Vec3 const tangent = glm::normalize(glm::cross(a, dice.direction()));
  double const half = apart / 2;
  Vec3 const middle = a * std::sqrt((1 - half) * (1 + half));
  return {middle - tangent * distance, tangent, Vec3(0)};
}

TEST(Roots, OfASphereAreCountedExactlyDownToTheRoundingOfTheRay) {
  Dice dice(1);
  Sphere const sphere;
  for (double const distance : {3.0, 1e3, 1e6}) {
    for (int exponent = 1; exponent <= 7; ++exponent) {
      double const apart = std::pow(10.0, -exponent);
      int wrong = 0, doubtful = 0;
      for (int i = 0; i < 400; ++i) {
        // Just inside or just outside the silhouette.
        Ray ray = chord_of_sphere(dice, apart, distance);
        Vec3 const middle = ray.origin + ray.direction * distance;
        if (i % 2) ray.origin += glm::normalize(middle) * (apart * apart / 4);
        Exact p = square_of(ray, {0, 1, 2});
        p[0] -= 1;
        // The margin by which the line hits or misses, of the squared distance.
        Rational const margin = (p[1] * p[1] - 4 * p[0] * p[2]) / (4 * p[2]);
        double const size = std::fabs(static_cast<double>(margin));
        bool const right = found(sphere, ray) == distinct_roots(p);
        // What closest approach in doubles can tell: a few roundings of the unit radius, and of the
        // place on a line of this length.
        if (size < 0x1p-50 + 0x1p-50 * distance)
          ++doubtful;
        else if (!right)
          ++wrong;
      }
      EXPECT_EQ(wrong, 0) << "separation " << apart << ", distance " << distance;
      // Close by, down to 1e-6 none is in doubt.
      if (distance < 10 && exponent < 7) {
        EXPECT_EQ(doubtful, 0);
      }
    }
  }
}

Exact torus_polynomial(Ray const& ray, double major, double minor) {
  // (|p|^2 + R^2 - r^2)^2 - 4 R^2 (x^2 + z^2)
  Rational const R(major), r(minor);
  Exact all = square_of(ray, {0, 1, 2});
  all[0] += R * R - r * r;
  Exact out = product(all, all);
  Exact const ring = square_of(ray, {0, 2});
  for (std::size_t i = 0; i < 3; ++i) out[i] -= 4 * R * R * ring[i];
  return out;
}

Vec3 on_torus(double major, double minor, double around, double tube) {
  double const rho = major + minor * std::cos(tube);
  return {rho * std::cos(around), minor * std::sin(tube), rho * std::sin(around)};
}

TEST(Roots, OfATorusAreCountedExactlyForCloseRoots) {
  Dice dice(2);
  for (double const minor : {0.5, 0.1, 1e-2}) {
    Torus const torus(1, minor);
    for (int exponent = 1; exponent <= 7; ++exponent) {
      double const apart = minor * std::pow(10.0, -exponent);
      int wrong = 0;
      for (int i = 0; i < 60; ++i) {
        // Through two places of one cross-section of the tube, `apart` from one another.
        double const around = dice.number(0, 6.28), tube = dice.number(0, 6.28);
        Vec3 const a = on_torus(1, minor, around, tube);
        Vec3 const b = on_torus(1, minor, around, tube + apart / minor);
        Vec3 const d = glm::normalize(b - a);
        Ray const ray{a - d * 3.0, d, Vec3(0)};
        int const truth = distinct_roots(torus_polynomial(ray, 1, minor));
        if (found(torus, ray) != truth) ++wrong;
      }
      RecordProperty("wrong_" + std::to_string(minor) + "_1e-" + std::to_string(exponent), wrong);
      // The depth of such a chord is apart^2 / (8 minor); the ray's own place is rounded to 2^-52
      // or so.
      double const depth = apart * apart / (8 * minor);
      if (depth > 0x1p-48) {
        EXPECT_EQ(wrong, 0) << "minor " << minor << ", separation " << apart;
      }
    }
  }
}

TEST(Roots, OfAThinTorusFarAwayAreTheExactOnes) {
  Dice dice(3);
  for (double const minor : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
    Torus const torus(1, minor);
    for (double const distance : {3.0, 1e2, 1e4, 1e6}) {
      int wrong = 0;
      for (int i = 0; i < 80; ++i) {
        Vec3 const at = on_torus(1, 0, dice.number(0, 6.28), 0);
        Vec3 const d = dice.direction();
        Vec3 const side = glm::normalize(glm::cross(d, dice.direction()));
        // Two of three aim at the tube.
        Vec3 const aim = at + side * (minor * dice.number(0, 1.5));
        Ray const ray{aim - d * distance, d, Vec3(0)};
        int const truth = distinct_roots(torus_polynomial(ray, 1, minor));
        if (found(torus, ray) == truth) continue;
        // A line that passes the silhouette closer than the rounding of its own far origin is in
        // doubt: a tube wider or narrower by that has another count.
        double const blur = 0x1p-50 * distance;
        if (distinct_roots(torus_polynomial(ray, 1, minor - blur))
            == distinct_roots(torus_polynomial(ray, 1, minor + blur)))
          ++wrong;
      }
      EXPECT_EQ(wrong, 0) << "minor " << minor << ", distance " << distance;
    }
  }
}

/// The polynomial with these roots, its coefficients rounded to doubles.
std::vector<double> with_roots(std::vector<double> const& roots) {
  std::vector<double> c{1};
  for (double const root : roots) {
    c.push_back(0);
    for (std::size_t i = c.size(); i-- > 0;) c[i] = (i > 0 ? c[i - 1] : 0) - root * c[i];
  }
  return c;
}
int found(std::vector<double> const& c) {
  auto const make = [&]<class N>(N) {
    Polynomial<N> f;
    f.degree = static_cast<int>(c.size()) - 1;
    for (std::size_t i = 0; i < c.size(); ++i) f.c[i] = N(c[i]);
    return f;
  };
  PolynomialRoots roots;
  if (!line_roots(make(double{}), roots)) line_roots(make(Twofold{}), {}, roots);
  return roots.count;
}

/// Sturm's count of the very doubles: whether rounding parted or joined close roots is theirs to
/// say.
TEST(Roots, OfPolynomialsAreCountedExactlyDownToASeparationOf1em7) {
  Dice dice(4);
  for (int const degree : {2, 3, 4, 6, 10}) {
    for (int exponent = 1; exponent <= 7; ++exponent) {
      double const apart = std::pow(10.0, -exponent);
      int wrong = 0;
      for (int i = 0; i < 40; ++i) {
        double const scale = dice.number(.25, 4);
        std::vector<double> roots;
        while (static_cast<int>(roots.size()) + 2 <= degree) {
          double const root = scale * dice.number(-1, 1);
          roots.push_back(root);
          roots.push_back(root * (1 + apart));
        }
        if (static_cast<int>(roots.size()) < degree) roots.push_back(scale * dice.number(-1, 1));
        std::vector<double> const c = with_roots(roots);
        if (found(c) != distinct_roots(Exact(c.begin(), c.end()))) ++wrong;
      }
      EXPECT_EQ(wrong, 0) << "degree " << degree << ", separation " << apart;
    }
  }
}

/// Pairs of roots `apart` (of themselves) from one another, magnitudes anywhere in 10^-range to
/// 10^range, both signs.
std::vector<double> wide_pairs(Dice& dice, int degree, double apart, double range) {
  std::vector<double> roots;
  while (static_cast<int>(roots.size()) < degree) {
    double const sign = dice.number(-1, 1) < 0 ? -1 : 1;
    roots.push_back(sign * std::pow(10.0, dice.number(-range, range)));
    if (static_cast<int>(roots.size()) < degree) roots.push_back(roots.back() * (1 + apart));
  }
  return roots;
}

TEST(Roots, OfVeryDifferentMagnitudeAreCountedExactly) {
  Dice dice(6);
  for (double const range : {3.0, 6.0}) {
    for (int const degree : {2, 3, 4, 5, 6, 8, 10, 13, 16, 20}) {
      for (int exponent = 1; exponent <= 7; ++exponent) {
        int wrong = 0;
        for (int i = 0; i < (degree > 10 ? 2 : 12); ++i) { // Sturm's chains grow fast
          std::vector<double> const c =
              with_roots(wide_pairs(dice, degree, std::pow(10.0, -exponent), range));
          if (found(c) != distinct_roots(Exact(c.begin(), c.end()))) ++wrong;
        }
        EXPECT_EQ(wrong, 0) << "degree " << degree << ", separation 1e-" << exponent << ", 1e+-"
                            << range;
      }
    }
  }
}

/// The same as surfaces, planes x = root: counts of the line as given, which runs at a slant.
TEST(Roots, OfSurfacesOfVeryDifferentSizeAreCountedExactly) {
  Dice dice(7);
  for (int const degree : {2, 4, 7, 10, 14, 20}) {
    for (int exponent = 1; exponent <= 7; exponent += 2) {
      int wrong = 0;
      for (int i = 0; i < (degree > 10 ? 2 : 20); ++i) {
        std::vector<double> const c =
            with_roots(wide_pairs(dice, degree, std::pow(10.0, -exponent), 6));
        std::vector<double> k; // of x^degree, then of what has y or z in it as well, and so on
        for (int a = degree; a >= 0; --a) {
          for (int rest = (degree - a + 1) * (degree - a + 2) / 2; rest > 1; --rest) k.push_back(0);
          k.push_back(c[static_cast<std::size_t>(a)]);
        }
        Ray const ray{dice.direction() * std::pow(10.0, dice.number(-3, 3)), dice.direction(),
                      Vec3(0)};
        Rational const o(ray.origin.x), d(ray.direction.x);
        Exact along{Rational(0)};
        for (int a = degree; a >= 0; --a) {
          along = product(along, Exact{o, d});
          along[0] += Rational(c[static_cast<std::size_t>(a)]);
        }
        if (found(*make_polynomial(degree, k)->shape, ray) != distinct_roots(along)) ++wrong;
      }
      EXPECT_EQ(wrong, 0) << "degree " << degree << ", separation 1e-" << exponent;
    }
  }
}

/// A torus as a quartic, its coefficients exact: chords near its silhouettes, near and far.
TEST(Roots, OfAQuarticAreCountedExactlyForTheRayAsGiven) {
  Dice dice(5);
  std::vector<double> k(35);
  k[0] = k[20] = k[30] = 1;
  k[4] = k[7] = k[23] = 2;
  k[9] = k[32] = -2.5;
  k[25] = 1.5;
  k[34] = .5625;
  auto const torus = make_polynomial(4, k)->shape;
  for (double const distance : {3.0, 1e3, 1e6}) {
    for (int exponent = 1; exponent <= 7; ++exponent) {
      double const apart = std::pow(10.0, -exponent);
      int wrong = 0;
      for (int i = 0; i < 40; ++i) {
        double const around = dice.number(0, 6.28), tube = dice.number(0, 6.28);
        Vec3 const a = on_torus(1, .5, around, tube), b = on_torus(1, .5, around, tube + apart);
        Vec3 const d = glm::normalize(b - a);
        Ray const ray{a - d * distance, d, Vec3(0)};
        if (found(*torus, ray) != distinct_roots(torus_polynomial(ray, 1, .5))) ++wrong;
      }
      EXPECT_EQ(wrong, 0) << "separation " << apart << ", distance " << distance;
    }
  }
}

} // namespace
} // namespace abbe::geometry
