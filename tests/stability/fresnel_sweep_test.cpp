// SPDX-License-Identifier: MIT
#include "optics/fresnel.hpp"
#include "optics/refract.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <rapidcheck.h>

/// Fresnel and Snell at their edges, against the textbook formulas in 100 digits.
namespace abbe::optics {
namespace {

using Exact = boost::multiprecision::cpp_bin_float_100;
constexpr double ulp = std::numeric_limits<double>::epsilon();

/// Reflectance of unpolarised light (Born & Wolf 1.5.2), of just these inputs.
Exact exact_reflectance(double n1, Exact const& n2, double cos_i) {
  Exact const c(cos_i), first(n1);
  Exact const eta = first / n2;
  Exact const cos2_t = 1 - eta * eta * (1 - c * c);
  if (cos2_t <= 0) return 1;
  Exact const t = sqrt(cos2_t);
  Exact const s = (first * c - n2 * t) / (first * c + n2 * t);
  Exact const p = (n2 * c - first * t) / (n2 * c + first * t);
  return (s * s + p * p) / 2;
}

Interface<double> at(double n1, double n2, double dn, double cos_i) {
  return fresnel<double>(n1, n2, dn, cos_i, (1 - cos_i) * (1 + cos_i));
}

double off_one(Interface<double> const& f) {
  return std::fabs(f.reflectance + f.transmittance - 1);
}

TEST(IndexMatchedStack, ReflectanceKeepsThirteenDigits) {
  for (int exponent = 2; exponent <= 14; ++exponent) {
    for (double const n1 : {1.0, 1.33, 1.5168, 2.417}) {
      double const dn = n1 * std::pow(10.0, -exponent);
      for (int k = 0; k <= 60; ++k) {
        // cos_i from 1 to 1e-6; where cos_i is no more than the square root of dn the ray turns
        // away.
        double const cos_i = std::pow(10.0, -0.1 * k);
        for (double const signed_dn : {dn, -dn}) {
          Exact const n2 = Exact(n1) + Exact(signed_dn);
          Exact const truth = exact_reflectance(n1, n2, cos_i);
          auto const f = at(n1, n1 + signed_dn, signed_dn, cos_i);
          if (truth == 1) {
            EXPECT_TRUE(f.total);
            continue;
          }
          // Near the critical angle R has infinite slope: the error of cos_t^2 is that of its
          // terms.
          double const n = static_cast<double>(n2);
          double const cos2_t = f.cos_t * f.cos_t, term = std::fabs(signed_dn * (n1 + n)) / (n * n);
          double const condition = std::max(1.0, term / cos2_t);
          Exact const error = abs(Exact(f.reflectance) - truth) / truth;
          EXPECT_LT(static_cast<double>(error), 1e-13 * condition)
              << "n1 " << n1 << " dn " << signed_dn << " cos_i " << cos_i;
        }
      }
    }
  }
}

TEST(GrazingSweep, ReflectanceRisesSteadilyToOne) {
  double before = 0;
  for (int k = 0; k <= 3000; ++k) {
    double const cos_i = std::pow(10.0, -0.1 * k);
    auto const f = at(1, 1.5, 0.5, cos_i);
    ASSERT_TRUE(std::isfinite(f.reflectance) && std::isfinite(f.transmittance));
    EXPECT_LE(off_one(f), 4 * ulp) << cos_i;
    // Past Brewster's angle.
    if (cos_i < 0.5) {
      EXPECT_GE(f.reflectance, before - 4 * ulp) << cos_i;
      before = f.reflectance;
    }
  }
  EXPECT_EQ(at(1, 1.5, 0.5, 0).reflectance, 1);
}

TEST(CriticalAngle, IsReachedContinuouslyFromBothSides) {
  for (double const n1 : {1.0003, 1.33, 1.5168, 2.417}) {
    double const critical = std::sqrt((n1 - 1) * (n1 + 1)) / n1;
    double before = 1;
    for (int k = -3000; k <= 3000; ++k) {
      // Distances from 1e-16 to 1e-1 of the critical cosine on either side.
      double const away = std::pow(10.0, -16 + 15.0 * std::abs(k) / 3000);
      double const cos_i = k < 0 ? critical * (1 - away) : k > 0 ? critical * (1 + away) : critical;
      auto const f = at(n1, 1, 1 - n1, cos_i);
      ASSERT_TRUE(std::isfinite(f.reflectance) && std::isfinite(f.bend));
      EXPECT_LE(off_one(f), 4 * ulp);
      if (k < 0 && away > 1e-14) {
        EXPECT_TRUE(f.total);
      }
      // Close to it cos_t = sqrt(2 (n1^2 - 1) away), and T of either polarisation is at most
      // 4 n1^2 cos_t / sqrt(n1^2 - 1); cos_i and cos_t^2 are off by some ulp, relative to 1.
      if (k > 0) {
        double const blurred = away + 8 * ulp / (critical * critical);
        EXPECT_LE(1 - f.reflectance, 4 * n1 * n1 * std::sqrt(2 * blurred) * (1 + away));
        // Up to Brewster's angle, where parallel light starts to return again.
        if (away > 1e-13 && cos_i < n1 / std::sqrt(1 + n1 * n1)) {
          EXPECT_LE(f.reflectance, before + 4 * ulp);
          before = f.reflectance;
        }
      }
    }
  }
}

TEST(BrewsterSweep, ParallelLightVanishesSmoothly) {
  // R = rs^2 / 2 there; the exact value to each side.
  double const n = 1.5168, brewster = 1 / std::sqrt(1 + n * n);
  for (int k = -400; k <= 400; ++k) {
    double const away = std::pow(10.0, -16 + 15.0 * std::abs(k) / 400);
    double const cos_i = brewster * (k < 0 ? 1 - away : 1 + away);
    auto const f = at(1, n, n - 1, cos_i);
    Exact const truth = exact_reflectance(1, n, cos_i);
    EXPECT_LT(static_cast<double>(abs(Exact(f.reflectance) - truth) / truth), 1e-14);
    EXPECT_LE(off_one(f), 4 * ulp);
  }
}

TEST(Interface, ConservesEnergyForAnyIndices) {
  EXPECT_TRUE(rc::check("R + T = 1 within 4 ulp, finite", [] {
    auto const unit = [] {
      return static_cast<double>(*rc::gen::inRange<std::int64_t>(0, std::int64_t{1} << 53))
             * 0x1p-53;
    };
    double const n1 = 1 + 4 * unit() * unit(), n2 = 1 + 4 * unit() * unit();
    double const cos_i = std::pow(unit(), 1 + 6 * unit());
    auto const f = at(n1, n2, n2 - n1, cos_i);
    RC_ASSERT(std::isfinite(f.reflectance) && std::isfinite(f.transmittance));
    RC_ASSERT(f.reflectance >= 0 && f.transmittance >= 0);
    RC_ASSERT(off_one(f) <= 4 * ulp);
  }));
}

TEST(Interface, IsReversible) {
  EXPECT_TRUE(rc::check("there and back is the direction", [] {
    auto const unit = [] {
      return static_cast<double>(*rc::gen::inRange<std::int64_t>(1, std::int64_t{1} << 53))
             * 0x1p-53;
    };
    double const n1 = 1 + unit(), n2 = 1 + unit();
    double const angle = 1.57 * unit();
    Vec3 const d(std::sin(angle), -std::cos(angle), 0), up(0, 1, 0);
    auto const there = at(n1, n2, n2 - n1, std::cos(angle));
    RC_PRE(!there.total && there.cos_t > 1e-3);
    Vec3 const t = refracted(there, d, up);
    auto const back = fresnel<double>(n2, n1, n1 - n2, -t.y, t.x * t.x);
    RC_ASSERT(!back.total);
    Vec3 const again = refracted(back, -t, -up);
    // Rounding of t.x moves the angle by ulp / cos.
    RC_ASSERT(glm::length(again + d) <= 8 * ulp / (there.cos_t * std::cos(angle)));
  }));
}

} // namespace
} // namespace abbe::optics
