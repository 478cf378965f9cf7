// SPDX-License-Identifier: MIT
#include "base/random.hpp"
#include "optics/fresnel.hpp"
#include "optics/refract.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

namespace abbe::optics {
namespace {

using Quad = boost::multiprecision::cpp_bin_float_quad;

/// Textbook Snell and Fresnel in 113 bits: the ground truth.
struct Truth {
  Quad cos_t = 0, reflectance = 1, transmittance = 0;
  bool total = true;
};
Truth truth(Quad n1, Quad dn, Quad cos_i) {
  Quad const n2 = n1 + dn;
  Quad const eta = n1 / n2;
  Quad const cos2 = 1 - eta * eta * (1 - cos_i * cos_i);
  Truth t;
  if (cos2 <= 0) return t;
  t.total = false;
  t.cos_t = sqrt(cos2);
  Quad const rs = (n1 * cos_i - n2 * t.cos_t) / (n1 * cos_i + n2 * t.cos_t);
  Quad const rp = (n2 * cos_i - n1 * t.cos_t) / (n2 * cos_i + n1 * t.cos_t);
  t.reflectance = (rs * rs + rp * rp) / 2;
  t.transmittance = 1 - t.reflectance;
  return t;
}

double relative(double value, Quad expected) {
  return static_cast<double>(abs((Quad(value) - expected) / expected));
}

TEST(Fresnel, MatchesNormalIncidenceOfCrownGlass) {
  auto const f = fresnel<double>(1.0, 1.5, 1.0);
  EXPECT_NEAR(f.reflectance, 0.04, 4e-17); // ((1.5 - 1)/(1.5 + 1))^2
  EXPECT_NEAR(f.transmittance, 0.96, 4e-16);
  EXPECT_EQ(f.cos_t, 1.0);
}

TEST(Fresnel, NearlyEqualIndicesKeepAllDigits) {
  RandomKey const key(1);
  for (int exponent = 1; exponent <= 14; ++exponent)
    for (int i = 0; i < 2000; ++i) {
      RandomKey const k = key.child(static_cast<std::uint64_t>(exponent * 10000 + i));
      double const n1 = 1 + k.uniform(0);
      double const dn =
          (k.uniform(1) < 0.5 ? -1 : 1) * n1 * std::pow(10.0, -exponent) * (0.5 + k.uniform(2));
      double const cos_i = std::pow(10.0, -6 * k.uniform(3) * k.uniform(3));
      auto const t = truth(n1, dn, cos_i);
      double const sin2 = (1 - cos_i) * (1 + cos_i);
      auto const f = fresnel<double>(n1, n1 + dn, dn, cos_i, sin2);
      if (t.total) {
        ASSERT_TRUE(fresnel<double>(n1, n1 + dn, dn, cos_i, (1 - cos_i) * (1 + cos_i)).total);
        continue;
      }
      // Near the critical angle cos_t is as ill-conditioned as its input: du/u = u / cos_t^2.
      double const condition = 1 + (cos_i * cos_i) / static_cast<double>(t.cos_t * t.cos_t);
      if (condition > 10) continue;
      ASSERT_FALSE(f.total);
      ASSERT_LT(relative(f.cos_t, t.cos_t), 1e-15 * condition);
      // r_p vanishes at Brewster's angle, where only its absolute error is small; r_s does not.
      ASSERT_LT(relative(f.reflectance, t.reflectance), 2e-14 * condition) << dn << ' ' << cos_i;
      ASSERT_LT(relative(f.transmittance, t.transmittance), 4e-15 * condition);
    }
}

TEST(Fresnel, ReflectedPlusTransmittedIsOne) {
  RandomKey const key(2);
  double worst = 0;
  for (int i = 0; i < 1000000; ++i) {
    RandomKey const k = key.child(static_cast<std::uint64_t>(i));
    double const n1 = 1 + 2 * k.uniform(0);
    double const n2 = i % 3 == 0 ? n1 * (1 + 1e-3 * (k.uniform(1) - 0.5)) : 1 + 2 * k.uniform(1);
    auto const f = fresnel<double>(n1, n2, i % 5 == 0 ? std::pow(k.uniform(2), 8) : k.uniform(2));
    ASSERT_GE(f.reflectance, 0);
    ASSERT_GE(f.transmittance, 0);
    worst = std::max(worst, std::abs(f.reflectance + f.transmittance - 1));
  }
  RecordProperty("worst", std::to_string(worst / unit_roundoff));
  EXPECT_LT(worst, 16 * unit_roundoff); // some ten roundings in each of R and T
}

TEST(Fresnel, IsReciprocal) {
  RandomKey const key(3);
  for (int i = 0; i < 10000; ++i) {
    RandomKey const k = key.child(static_cast<std::uint64_t>(i));
    double const n1 = 1 + k.uniform(0), n2 = 1 + k.uniform(1), c = 0.01 + 0.99 * k.uniform(2);
    auto const f = fresnel<double>(n1, n2, c);
    if (f.total || f.cos_t < 0.01) continue;
    auto const back = fresnel<double>(n2, n1, f.cos_t);
    ASSERT_NEAR(back.cos_t, c, 1e-15 / (c * f.cos_t));
    ASSERT_NEAR(back.reflectance, f.reflectance, 1e-14 / (c * f.cos_t));
  }
}

TEST(Fresnel, PolarisedPartVanishesAtBrewster) {
  double const angle = std::atan(1.5);
  auto const f = fresnel<double>(1.0, 1.5, std::cos(angle));
  // Only s is reflected: ((n^2 - 1)/(n^2 + 1))^2 / 2 (Born & Wolf 1.5.3).
  EXPECT_NEAR(f.reflectance, 0.5 * std::pow(1.25 / 3.25, 2), 1e-16);
}

TEST(Fresnel, IsContinuousAcrossTheCriticalAngle) {
  double const cos_c = std::sqrt(1 - 1 / (1.5 * 1.5));
  auto const below = fresnel<double>(1.5, 1.0, cos_c * (1 + 1e-12));
  auto const above = fresnel<double>(1.5, 1.0, cos_c * (1 - 1e-12));
  EXPECT_FALSE(below.total);
  EXPECT_TRUE(above.total);
  EXPECT_EQ(above.reflectance, 1.0);
  EXPECT_EQ(above.transmittance, 0.0);
  EXPECT_NEAR(below.reflectance, 1.0, 1e-5); // 1 - R goes as the root of the distance
  auto const t = truth(1.5, -0.5, cos_c * (1 + 1e-12));
  // cos_t^2 = 1e-12 comes from terms of size 1, so it has four digits.
  EXPECT_LT(relative(below.transmittance, t.transmittance), 1e-3);
}

TEST(Fresnel, GrazingIncidenceKeepsItsDigits) {
  for (double const c : {1e-3, 1e-9, 1e-12, 1e-300, 0.0}) {
    auto const f = fresnel<double>(1.0, 1.5, c);
    EXPECT_FALSE(f.total);
    auto const t = truth(1.0, 0.5, c);
    if (c > 1e-20) {
      // 1 - R itself would have no digit left at 1e-12; the reference has 113 bits.
      EXPECT_LT(relative(f.transmittance, t.transmittance), 1e-14 + 1e-33 / c) << c;
    } else {
      EXPECT_GE(f.transmittance, 0);
    }
    EXPECT_LE(f.reflectance, 1);
    auto const out = fresnel<double>(1.5, 1.0, c);
    EXPECT_TRUE(out.total);
  }
}

TEST(Refract, EqualIndicesPassBitwise) {
  Vec3 const d = glm::normalize(Vec3(0.3, -0.8, 0.1));
  for (Vec3 const& n : {Vec3(0, 1, 0), glm::normalize(Vec3(-0.2, 0.5, 0.01))}) {
    auto const f = fresnel<double>(1.5, 1.5, -glm::dot(d, n));
    EXPECT_EQ(refracted(f, d, n), d);
    EXPECT_EQ(f.reflectance, 0.0);
    EXPECT_EQ(f.transmittance, 1.0);
    EXPECT_EQ(f.cos_t, -glm::dot(d, n));
  }
  auto const grazing = fresnel<double>(1.5, 1.5, 0.0);
  EXPECT_FALSE(grazing.total);
  EXPECT_EQ(grazing.transmittance, 1.0);
}

TEST(Refract, ObeysSnellAndStaysUnit) {
  RandomKey const key(4);
  for (int i = 0; i < 100000; ++i) {
    RandomKey const k = key.child(static_cast<std::uint64_t>(i));
    Vec3 const n = glm::normalize(Vec3(k.uniform(0), k.uniform(1), k.uniform(2)) - 0.5);
    Vec3 d = glm::normalize(Vec3(k.uniform(3), k.uniform(4), k.uniform(5)) - 0.5);
    if (glm::dot(d, n) > 0) d = -d;
    double const n1 = 1 + k.uniform(6), n2 = 1 + k.uniform(7);
    auto const f = fresnel<double>(n1, n2, -glm::dot(d, n));
    if (f.total) continue;
    Vec3 const t = refracted(f, d, n);
    ASSERT_NEAR(glm::dot(t, t), 1, 16 * unit_roundoff);
    // n1 sin i = n2 sin t; near-critical rays lose as much as cos_t does.
    double const tolerance = 2e-15 / std::max(f.cos_t, 1e-8);
    ASSERT_NEAR(n1 * glm::length(glm::cross(d, n)), n2 * glm::length(glm::cross(t, n)), tolerance);
    if (f.cos_t < 1e-3) continue;
    auto const back = fresnel<double>(n2, n1, glm::dot(-t, n) * 1.0);
    Vec3 const again = refracted(back, -t, -n);
    ASSERT_LT(glm::length(again + d), 1e-14 / (f.cos_t * -glm::dot(d, n)));
  }
}

/// Complex Fresnel coefficients, straight from the definition.
double metal_truth(double n, double k, double cos_i) {
  std::complex<long double> const m(n, k);
  std::complex<long double> const root =
      std::sqrt(m * m - std::complex<long double>(1.0L - static_cast<long double>(cos_i) * cos_i));
  long double const c = cos_i;
  long double const rs = std::norm((c - root) / (c + root));
  long double const rp = std::norm((m * m * c - root) / (m * m * c + root));
  return static_cast<double>((rs + rp) / 2);
}

TEST(Conductor, MatchesComplexArithmetic) {
  for (double const n : {0.05, 0.2, 1.0, 1.4, 4.0})
    for (double const k : {0.0, 0.01, 1.0, 3.5, 8.0})
      for (double c = 0; c <= 1; c += 1.0 / 64)
        if (n == 1 && k == 0 && c == 0)
          EXPECT_EQ((conductor_reflectance<double>(n, k, c)), 0);
        else
          EXPECT_NEAR((conductor_reflectance<double>(n, k, c)), metal_truth(n, k, c), 2e-15)
              << n << ' ' << k << ' ' << c;
}

TEST(Conductor, WithoutAbsorptionIsADielectric) {
  for (double c = 0.05; c <= 1; c += 0.05)
    EXPECT_NEAR((conductor_reflectance<double>(1.5, 0, c)),
                (fresnel<double>(1.0, 1.5, c).reflectance), 1e-15);
}

} // namespace
} // namespace abbe::optics
