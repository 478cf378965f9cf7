// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

/// Sums of octaves of noise, each of which the sum so far lets count (Musgrave, in "Texturing and
/// Modeling"): f_ridged_mf and f_hetero_mf of functions.inc. Of numbers and of enclosures alike.
namespace abbe::lang {

/// `internal(59)`, `internal(29)`: their parameters after x, y and z, in their order but for noise.
struct Multifractal {
  double h, lacunarity, octaves, offset, gain;

  /// @param noise of a point given as three T, 0..1
  /// @param clamp to 0..1, @param magnitude |T|, @param number T of a double
  template <class T, class Noise, class Clamp, class Magnitude, class Number>
  T ridged(T x, T y, T z, Noise const& noise, Clamp const& clamp, Magnitude const& magnitude,
           Number const& number) const {
    T sum = number(0), weight = number(1);
    double frequency = 1;
    for (int i = 0; i < whole(octaves); ++i) {
      T const f = number(frequency);
      T const ridge =
          number(offset) - magnitude(number(2) * noise(x * f, y * f, z * f) - number(1));
      T const signal = ridge * ridge * weight;
      sum = sum + signal * number(std::pow(frequency, -h));
      weight = clamp(signal * number(gain));
      frequency *= lacunarity;
    }
    return sum;
  }
  /// `gain` is how often the sum so far weighs on what comes.
  template <class T, class Noise, class Number>
  T hetero(T x, T y, T z, Noise const& noise, Number const& number) const {
    T sum = number(0);
    double frequency = 1;
    for (int i = 0; i < whole(octaves); ++i) {
      T const f = number(frequency);
      T step = (number(2) * noise(x * f, y * f, z * f) - number(1) + number(offset))
               * number(std::pow(frequency, -h));
      for (int k = 0; i > 0 && k < whole(gain); ++k) step = step * sum;
      sum = sum + step;
      frequency *= lacunarity;
    }
    return sum;
  }

private:
  static int whole(double value) { return static_cast<int>(std::clamp(value, 0.0, 100.0)); }
};

} // namespace abbe::lang
