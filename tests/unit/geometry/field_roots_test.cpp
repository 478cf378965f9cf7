// SPDX-License-Identifier: MIT
#include "geometry/field_roots.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace abbe::geometry {
namespace {

/// cos(frequency x): zeros where they are known.
class Wave final : public ScalarField {
public:
  explicit Wave(double frequency) : frequency_(frequency) {}
  double value(Vec3 const& p) const override { return std::cos(frequency_ * p.x); }
  Along along(Vec3 const& o, Vec3 const& d, Interval const& part) const override {
    Interval const angle = Interval(frequency_) * (Interval(o.x) + Interval(d.x) * part);
    // By its slope bound about the middle: rough, but true.
    double const middle = angle.middle(), half = 0.5 * angle.width();
    double const c = std::cos(middle), s = -frequency_ * std::sin(middle) * d.x;
    double const steep = half * frequency_ * frequency_ * std::fabs(d.x) / frequency_;
    return {widened(c - half, c + half, 8), widened(s - steep, s + steep, 8)};
  }
  bool smooth() const override { return true; }
  Vec3 gradient(Vec3 const& p) const override {
    return {-frequency_ * std::sin(frequency_ * p.x), 0, 0};
  }

private:
  double frequency_;
};

TEST(FieldRoots, FindsEachZeroOfAWave) {
  Wave const wave(100);
  FieldLine const line{wave, Vec3(0), Vec3(1, 0, 0), 0, 0, INFINITY};
  std::vector<FieldRoot> roots;
  field_roots(line, 0, 2, roots);
  // pi/200 + k pi/100 < 2: k = 0 ... 63.
  ASSERT_EQ(roots.size(), 64U);
  for (std::size_t k = 0; k < roots.size(); ++k) {
    double const truth = (static_cast<double>(k) + .5) * 3.14159265358979323846 / 100;
    EXPECT_NEAR(roots[k].at, truth, roots[k].error + 1e-15) << k;
    EXPECT_LT(roots[k].error, 1e-13);
    EXPECT_EQ(roots[k].rising, k % 2 == 1);
  }
}

/// Two zeros 2 sqrt(2 h) apart about a crest that the level is h below.
TEST(FieldRoots, FindsCloseZerosDownToTheRoundingOfTheField) {
  Wave const wave(1);
  for (int exponent = 2; exponent <= 14; ++exponent) {
    double const below = std::pow(10.0, -exponent);
    for (double const sign : {-1.0, 1.0}) {
      FieldLine const line{wave, Vec3(0), Vec3(1, 0, 0), 1 + sign * below, 0, INFINITY};
      std::vector<FieldRoot> roots;
      field_roots(line, -1, 1.1, roots);
      EXPECT_EQ(roots.size(), sign < 0 ? 2U : 0U) << "1e-" << exponent;
      for (FieldRoot const& root : roots) {
        double const truth = std::acos(1 - below);
        EXPECT_NEAR(std::fabs(root.at), truth, root.error + 4e-16 / truth) << "1e-" << exponent;
      }
    }
  }
}

TEST(FieldRoots, StopsBeyondWhatIsEnough) {
  Wave const wave(100);
  FieldLine const line{wave, Vec3(0), Vec3(1, 0, 0), 0, 0, 1.0};
  std::vector<FieldRoot> roots;
  field_roots(line, 0, 2, roots);
  ASSERT_FALSE(roots.empty());
  EXPECT_GT(roots.back().at, 1);
  EXPECT_LE((roots.end() - 2)->at, 1);
}

/// A field of x alone: `f` takes an enclosure of x and of its slope to those of the field.
template <class F>
class Profile final : public ScalarField {
public:
  explicit Profile(F f, bool smooth = true) : f_(f), smooth_(smooth) {}
  double value(Vec3 const& p) const override {
    return f_(Interval(p.x), Interval(0)).value.middle();
  }
  Along along(Vec3 const& o, Vec3 const& d, Interval const& part) const override {
    return f_(Interval(o.x) + Interval(d.x) * part, Interval(d.x));
  }
  bool smooth() const override { return smooth_; }
  Vec3 gradient(Vec3 const&) const override { return {0, 0, 0}; }

private:
  F f_;
  bool smooth_;
};
template <class F>
std::vector<FieldRoot> roots_of(Profile<F> const& field, double level, double low, double high) {
  FieldLine const line{field, Vec3(0), Vec3(1, 0, 0), level, 1e-3, INFINITY};
  std::vector<FieldRoot> roots;
  field_roots(line, low, high, roots);
  return roots;
}
void expect_roots(std::vector<FieldRoot> const& roots, std::vector<double> const& truths,
                  double most_error) {
  ASSERT_EQ(roots.size(), truths.size());
  for (std::size_t i = 0; i < roots.size(); ++i) {
    EXPECT_NEAR(roots[i].at, truths[i], roots[i].error) << i;
    EXPECT_LT(roots[i].error, most_error) << i;
    EXPECT_EQ(roots[i].rising, i % 2 == 1) << i;
  }
}
using Along = ScalarField::Along;
Along slope_of_size(Interval const& x, Interval const& d) {
  return {abs(x), x.low >= 0 ? d : x.high <= 0 ? -d : hull(d, -d)};
}

/// Newton's method and chords are at such a root at once, from one side.
TEST(FieldRoots, OfALinearFieldAreKnownToItsRounding) {
  Profile const gable(slope_of_size);
  for (double const level : {1.0, 0.7, 1.0 / 3, 1e-9}) {
    expect_roots(roots_of(gable, level, -3, 2), {-level, level}, 8e-16 * (level + 1e-9));
  }
}

TEST(FieldRoots, AtAKinkAreKnownToItsRounding) {
  // x - 1 up to 1, a tenth of it beyond.
  Profile const kink([](Interval const& x, Interval const& d) {
    Interval const y = x - Interval(1);
    if (y.high <= 0) return Along{-y, -d};
    Interval const flat = Interval(-.1) * y;
    return y.low >= 0
               ? Along{flat, Interval(-.1) * d}
               : Along{hull(-Interval(y.low), Interval(flat.low)), hull(-d, Interval(-.1) * d)};
  });
  expect_roots(roots_of(kink, 0, -3, 4), {1.0}, 1e-14);
}

class Octahedron final : public ScalarField {
public:
  double value(Vec3 const& p) const override {
    return std::fabs(p.x) + std::fabs(p.y) + std::fabs(p.z) - 1;
  }
  Along along(Vec3 const& o, Vec3 const& d, Interval const& part) const override {
    Along sum{Interval(-1), Interval(0)};
    for (int i = 0; i < 3; ++i) {
      Along const one = slope_of_size(Interval(o[i]) + Interval(d[i]) * part, Interval(d[i]));
      sum = {sum.value + one.value, sum.slope + one.slope};
    }
    return sum;
  }
  bool smooth() const override { return true; }
  Vec3 gradient(Vec3 const&) const override { return Vec3(1); }
};

/// A field whose enclosures say nothing, with as many changes of side as there are.
class Unknown final : public ScalarField {
public:
  double value(Vec3 const& p) const override { return std::sin(1e9 * p.x); }
  Along along(Vec3 const& o, Vec3 const& d, Interval const& part) const override {
    ++asked;
    if (part.width() > 0) return {{-1, 1}, Interval::everything()};
    double const here = value(o + part.low * d);
    return {widened(here, here), Interval::everything()};
  }
  bool smooth() const override { return true; }
  Vec3 gradient(Vec3 const&) const override { return {1, 0, 0}; }
  mutable std::size_t asked = 0;
};

TEST(FieldRoots, EndWhereEnclosuresSayNothing) {
  Unknown const field;
  FieldLine const line{field, Vec3(0), Vec3(1, 0, 0), .25, 1e-12, INFINITY};
  std::vector<FieldRoot> roots;
  field_roots(line, -1, 1.1, roots);
  EXPECT_LE(field.asked, 64 * field_pieces);
}

/// A lamp in the plane of a face: sides along its light differ from one double to the next, and a
/// search for all of their changes would not end.
TEST(FieldRoots, AlongAFlatFaceAreFew) {
  Octahedron const field;
  Vec3 const lamp(3, 9, -7);
  for (int i = 1; i <= 200; ++i) {
    double const y = -.3 * std::fmod(i * .618, 1) - .01, z = -.6 * std::fmod(i * .414, 1) - .01;
    Vec3 const on_face(1 + y + z, y, z);
    Vec3 const d = glm::normalize(lamp - on_face);
    FieldLine const line{field, on_face - glm::dot(on_face, d) * d, d, 0, 0, INFINITY};
    std::vector<FieldRoot> roots;
    field_roots(line, -2, 2, roots);
    EXPECT_LE(roots.size(), 40U) << i;
  }
}

TEST(FieldRoots, OfAPlateauAreAtItsEnds) {
  Profile const plateau([](Interval const& x, Interval const& d) {
    Along const size = slope_of_size(x, d);
    Interval const over = size.value - Interval(1);
    return Along{{std::max(over.low, 0.0), std::max(over.high, 0.0)},
                 over.low > 0    ? size.slope
                 : over.high < 0 ? Interval(0)
                                 : hull(size.slope, Interval(0))};
  });
  expect_roots(roots_of(plateau, 0, -3, 2.5), {-1.0, 1.0}, 1e-5);
}

TEST(FieldRoots, OfAJumpAreKnownToTheRoundingOfTheLine) {
  Profile const jump(
      [](Interval const& x, Interval const&) {
        double const low = x.low < 1.0 / 3 ? 1 : -1, high = x.high < 1.0 / 3 ? 1 : -1;
        return Along{{high, low}, low == high ? Interval(0) : Interval::everything()};
      },
      false);
  expect_roots(roots_of(jump, 0, -3, 2), {1.0 / 3}, 1e-14);
}

/// The nearer two roots come to one, the wider their bounds, up to the root of the rounding; they
/// do not reach a third root.
TEST(FieldRoots, OfAGrazeHaveBoundsOfTheRootOfTheRounding) {
  Profile const bowl([](Interval const& x, Interval const& d) {
    return Along{square(x), Interval(2) * x * d};
  });
  for (double const level : {1e-2, 1e-8, 1e-14, 1e-16, 1e-18, 1e-30}) {
    double const root = std::sqrt(level);
    expect_roots(roots_of(bowl, level, -3, 2), {-root, root}, 1e-15 * root + 1e-40);
    // Beside one, the values have the rounding of one.
    Profile const high([](Interval const& x, Interval const& d) {
      return Along{square(x) + Interval(1), Interval(2) * x * d};
    });
    auto const roots = roots_of(high, 1 + level, -3, 2);
    double const rounded = std::sqrt((1 + level) - 1);
    if (rounded == 0) continue;
    expect_roots(roots, {-rounded, rounded}, std::min(1e-15 / rounded, 2e-7));
  }
}

} // namespace
} // namespace abbe::geometry
