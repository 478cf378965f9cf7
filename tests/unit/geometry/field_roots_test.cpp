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

} // namespace
} // namespace abbe::geometry
