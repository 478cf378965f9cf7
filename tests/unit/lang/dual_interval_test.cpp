// SPDX-License-Identifier: MIT
#include "lang/dual_interval.hpp"

#include "lang/float_functions.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace abbe::lang {
namespace {

class Dice {
public:
  double number(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }

private:
  std::mt19937_64 engine_{7};
};

/// What the functions give at places of an interval lies in its enclosure; so do the chords' slopes
/// (to what subtraction leaves of them), where the enclosure is finite.
TEST(DualInterval, HoldsValuesAndSlopesOfAllFunctions) {
  Dice dice;
  auto const functions = float_functions();
  for (std::size_t i = 0; i < functions.size(); ++i) {
    FloatFunction const& f = functions[i];
    for (int n = 0; n < 400; ++n) {
      double const scale = std::pow(10.0, dice.number(-2, 1));
      double const low = dice.number(-scale, scale), width = dice.number(0, scale);
      double const other =
          f.name == "pow" && n % 2 == 0 ? std::round(dice.number(-3, 5)) : dice.number(.5, 3);
      Dual const a{{low, low + width}, Interval(1)}, b{Interval(other), Interval(0)};
      Dual const result = apply(i, a, b);
      for (int k = 0; k < 20; ++k) {
        double const x = low + width * (k / 20.0), h = width * 1e-4;
        double const y = f.compute(x, other), next = f.compute(x + h, other);
        if (!std::isfinite(y)) continue; // not defined there
        EXPECT_TRUE(result.v.holds(y))
            << f.name << "(" << x << ", " << other << ") = " << y << " not in [" << result.v.low
            << ", " << result.v.high << "]";
        if (!(h > 0) || !std::isfinite(next)) continue;
        double const slope = (next - y) / h;
        double const blur = 1e-12 + 4e-16 * (std::fabs(x) + std::fabs(y) + std::fabs(next)) / h;
        EXPECT_TRUE(result.d.low - blur <= slope && slope <= result.d.high + blur)
            << f.name << "'(" << x << ", " << other << ") = " << slope << " not in ["
            << result.d.low << ", " << result.d.high << "]";
      }
    }
  }
}

TEST(DualInterval, IsTightForASinglePlace) {
  auto const functions = float_functions();
  for (std::size_t i = 0; i < functions.size(); ++i) {
    double const x = functions[i].name == "acosh" ? 1.7 : .7;
    Dual const result = apply(i, {Interval(x), Interval(1)}, {Interval(1.5), Interval(0)});
    EXPECT_LT(result.v.width(), 1e-13) << functions[i].name;
    EXPECT_LT(result.d.width(), 1e-12) << functions[i].name;
  }
}

} // namespace
} // namespace abbe::lang
