// SPDX-License-Identifier: MIT
#include "simd/math.hpp"

#include "simd/native.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <cstring>
#include <functional>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace abbe::simd {
namespace {

using Exact = boost::multiprecision::cpp_bin_float_50;

/// |value - exact| in units of the last place of `value`.
double error_ulp(double value, Exact const& exact) {
  double const unit = std::nextafter(std::fabs(value), INFINITY) - std::fabs(value);
  return static_cast<double>(abs(Exact(value) - exact) / unit);
}

/// Largest error over arguments evenly spread in [low, high], or in their logarithm.
double worst(std::function<double(double)> const& f, std::function<Exact(Exact)> const& exact,
             double low, double high, bool by_logarithm = false) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> even(by_logarithm ? std::log(low) : low,
                                              by_logarithm ? std::log(high) : high);
  double most = 0;
  for (int i = 0; i < 1500; ++i) {
    double const x = by_logarithm ? std::exp(even(random)) : even(random);
    most = std::max(most, error_ulp(f(x), exact(Exact(x))));
  }
  return most;
}

#define ABBE_EXACT(name) [](Exact const& x) { return Exact(boost::multiprecision::name(x)); }

TEST(SimdMath, ExpAndLogAreWithinOneUnit) {
  EXPECT_LT(worst(exp<double>, ABBE_EXACT(exp), -700, 700), 1);
  EXPECT_LT(worst(exp<double>, ABBE_EXACT(exp), 1e-12, 1, true), 1);
  EXPECT_LT(worst(log<double>, ABBE_EXACT(log), 1e-300, 1e300, true), 1);
  EXPECT_LT(worst(log<double>, ABBE_EXACT(log), 0.5, 2), 1);
  EXPECT_LT(worst(log10<double>, ABBE_EXACT(log10), 1e-300, 1e300, true), 1);
  EXPECT_LT(error_ulp(exp(-740.0), boost::multiprecision::exp(Exact(-740))), 1); // subnormal
  EXPECT_LT(error_ulp(log(0x1.8p-1070), boost::multiprecision::log(Exact(0x1.8p-1070))), 1);
}

TEST(SimdMath, TrigonometryIsWithinItsBounds) {
  EXPECT_LT(worst(sin<double>, ABBE_EXACT(sin), -7, 7), 1);
  EXPECT_LT(worst(sin<double>, ABBE_EXACT(sin), 1, 1e6, true), 1);
  EXPECT_LT(worst(cos<double>, ABBE_EXACT(cos), -7, 7), 1);
  EXPECT_LT(worst(cos<double>, ABBE_EXACT(cos), 1, 1e6, true), 1);
  EXPECT_LT(worst(tan<double>, ABBE_EXACT(tan), -7, 7), 2);
  EXPECT_LT(worst(atan<double>, ABBE_EXACT(atan), -4, 4), 2);
  EXPECT_LT(worst(atan<double>, ABBE_EXACT(atan), 1e-9, 1e9, true), 2);
  EXPECT_LT(worst(asin<double>, ABBE_EXACT(asin), -1, 1), 2);
  EXPECT_LT(worst(acos<double>, ABBE_EXACT(acos), -1, 1), 2.5);
}

TEST(SimdMath, LargeAnglesAreReducedExactly) {
  using Long = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<420>>;
  // 6381956970095103 2^797 is the double nearest to a multiple of pi/2 (Muller 2006, 11.1).
  for (double const x : {0x1p20, 1234567.875, 1e9, -3e15, 0x1p55 + 8, 1e22, -1e100, 1.7e308,
                         std::ldexp(6381956970095103.0, 797), 0x1.fffffffffffffp1023}) {
    Long const exact_sin = boost::multiprecision::sin(Long(x)),
               exact_cos = boost::multiprecision::cos(Long(x));
    EXPECT_LT(error_ulp(sin(x), Exact(exact_sin)), 1) << x;
    EXPECT_LT(error_ulp(cos(x), Exact(exact_cos)), 1) << x;
  }
  // Nearly a multiple of pi/2 below 2^20, where digits cancel.
  for (int n = 1; n < 400000; n += 997) {
    double const x = n * 1.5707963267948966;
    EXPECT_LT(error_ulp(sin(x), boost::multiprecision::sin(Exact(x))), 1) << n;
    EXPECT_LT(error_ulp(cos(x), boost::multiprecision::cos(Exact(x))), 1) << n;
  }
}

TEST(SimdMath, PowerIsWithinItsBounds) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> base(-30, 30), result(-40, 40), wide(-700, 700);
  double common = 0, far = 0;
  for (int i = 0; i < 2000; ++i) {
    double const x = std::exp(base(random));
    double const y = result(random) / std::log(x), z = wide(random) / std::log(x);
    common = std::max(common, error_ulp(pow(x, y), boost::multiprecision::pow(Exact(x), Exact(y))));
    far = std::max(far, error_ulp(pow(x, z), boost::multiprecision::pow(Exact(x), Exact(z))));
  }
  EXPECT_LT(common, 1.5);
  EXPECT_LT(far, 15);
  // A highlight's: a cosine near 1 to a large power.
  EXPECT_LT(error_ulp(pow(1 - 1e-9, 1e6), boost::multiprecision::pow(Exact(1 - 1e-9), Exact(1e6))),
            1);
}

TEST(SimdMath, TheOthersAreWithinFourUnits) {
  EXPECT_LT(worst(cbrt, ABBE_EXACT(cbrt), 1e-300, 1e300, true), 1);
  EXPECT_LT(worst(sinh, ABBE_EXACT(sinh), -3, 3), 2);
  EXPECT_LT(worst(sinh, ABBE_EXACT(sinh), 1e-9, 700, true), 2.5);
  EXPECT_LT(worst(cosh, ABBE_EXACT(cosh), -30, 30), 2);
  EXPECT_LT(worst(tanh, ABBE_EXACT(tanh), -3, 3), 2.5);
  EXPECT_LT(worst(asinh, ABBE_EXACT(asinh), 1e-9, 1e30, true), 4);
  EXPECT_LT(worst(acosh, ABBE_EXACT(acosh), 1.0001, 1e10, true), 4);
  EXPECT_LT(worst(atanh, ABBE_EXACT(atanh), -0.999, 0.999), 4);
  EXPECT_LT(worst(expm1, ABBE_EXACT(expm1), -3, 3), 4);
  EXPECT_LT(worst(expm1, ABBE_EXACT(expm1), 1e-12, 1, true), 4);
  EXPECT_EQ(cbrt(27.0), 3);
  EXPECT_EQ(cbrt(-0x1p-1074), -std::cbrt(0x1p-1074));
  EXPECT_EQ(hypot(0x1.8p1022, 0x1p1023), 0x1.4p1023);
  EXPECT_EQ(hypot(3 * 0x1p-1074, 4 * 0x1p-1074), 5 * 0x1p-1074);
  EXPECT_EQ(sinh(711.0) < INFINITY, false);
}

/// The same value, or both no number; zeros by their sign.
void expect_same(double value, double expected, double x, double y = 0) {
  if (std::isnan(expected))
    EXPECT_TRUE(std::isnan(value)) << x << ", " << y << ": " << value;
  else
    EXPECT_TRUE(value == expected && std::signbit(value) == std::signbit(expected))
        << x << ", " << y << ": " << value << ", not " << expected;
}

TEST(SimdMath, SpecialValuesAreThoseOfC) {
  double const inf = INFINITY, nan = NAN;
  for (double const x :
       {0.0, -0.0, inf, -inf, nan, 1.0, -1.0, 1e-320, 2.0, -2.0, 1000.0, -1000.0}) {
    if (x == 0 || !std::isfinite(x) || std::fabs(x) == 1000) expect_same(exp(x), std::exp(x), x);
    if (x <= 0 || !std::isfinite(x) || x == 1) expect_same(log(x), std::log(x), x);
    if (x == 0 || !std::isfinite(x)) {
      expect_same(sin(x), std::sin(x), x);
      expect_same(cos(x), std::cos(x), x);
      expect_same(tan(x), std::tan(x), x);
      expect_same(cbrt(x), std::cbrt(x), x);
      expect_same(sinh(x), std::sinh(x), x);
      expect_same(tanh(x), std::tanh(x), x);
      expect_same(atan(x), std::atan(x), x);
    }
    if (std::fabs(x) > 1 || std::fabs(x) == 1 || x == 0) {
      expect_same(asin(x), std::asin(x), x);
      expect_same(acos(x), std::acos(x), x);
    }
    for (double const y :
         {0.0, -0.0, inf, -inf, nan, 1.0, -1.0, 3.0, -3.0, 2.0, 0.5, -0.5, 1e300}) {
      if (!std::isfinite(x) || x == 0 || !std::isfinite(y) || y == 0 || std::fabs(y) == 1e300)
        expect_same(pow(x, y), std::pow(x, y), x, y);
      if (!std::isfinite(x) || x == 0 || !std::isfinite(y) || y == 0)
        expect_same(atan2(y, x), std::atan2(y, x), y, x);
    }
  }
  expect_same(pow(-2.0, 3.0), -8, -2, 3);
  expect_same(pow(-2.0, 4.0), 16, -2, 4);
  expect_same(pow(-2.0, 0.5), nan, -2, 0.5);
}

struct AllFunctions {
  static constexpr std::size_t count = 10;
  template <class L>
  static void run(double const* x, double const* y, std::size_t size, double* out) {
    in_lanes<L>(size, [&]<class Lanes>(std::size_t at) {
      Lanes const a = load<Lanes>(x + at), b = load<Lanes>(y + at);
      Lanes const results[count] = {exp(a), log(a), log10(a),    pow(a, b), sin(a),
                                    cos(a), tan(a), atan2(a, b), asin(a),   acos(a)};
      for (std::size_t i = 0; i < count; ++i) store(out + i * size + at, results[i]);
    });
  }
};

TEST(SimdMath, EveryWidthGivesTheSameBits) {
  std::mt19937_64 random(11);
  std::vector<double> x, y;
  for (int i = 0; i < 4096; ++i) {
    double const scale = std::ldexp(1.0, static_cast<int>(random() % 80) - 40);
    x.push_back((static_cast<double>(random() % 2000001) - 1000000) * 1e-6 * (i % 3 ? 1 : scale));
    y.push_back((static_cast<double>(random() % 2000001) - 1000000) * 1e-5);
  }
  double const inf = INFINITY, nan = NAN;
  for (double const special : {0.0, -0.0, inf, -inf, nan, 1e308, -1e-320, 5e-324}) {
    x[static_cast<std::size_t>(random() % x.size())] = special;
    y[static_cast<std::size_t>(random() % y.size())] = special;
  }
  std::size_t const all = x.size() * AllFunctions::count;
  std::vector<double> one(all), four(all), native(all);
  AllFunctions::run<double>(x.data(), y.data(), x.size(), one.data());
  AllFunctions::run<Double4>(x.data(), y.data(), x.size(), four.data());
  Native<AllFunctions> const widest;
  widest(x.data(), y.data(), x.size(), native.data());
  auto const same = [](double a, double b) {
    return std::isnan(a) ? std::isnan(b) : std::memcmp(&a, &b, sizeof a) == 0;
  };
  for (std::size_t i = 0; i < all; ++i) {
    EXPECT_TRUE(same(one[i], four[i])) << i / x.size() << " " << x[i % x.size()];
    EXPECT_TRUE(same(one[i], native[i])) << i / x.size() << " " << x[i % x.size()];
  }
}

} // namespace
} // namespace abbe::simd
