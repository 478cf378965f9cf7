// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

namespace abbe::transport::caustics {

/// Bands that are looked at together where light changes evenly from one to the next.
inline constexpr std::size_t coarse = 4;
/// How well the others have to tell the middle one, for the rest to be told by all.
inline constexpr double even = 2e-3;

/// How well the light of a band is told, beside that of the lamp if nothing were in its way.
inline constexpr double told_to = 0x1p-10;

/// Of a value at a place among others, by the polynomial through them.
/// @param but number of one that is left out
inline double through(std::span<double const> places, std::span<double const> values, double at,
                      std::size_t but = static_cast<std::size_t>(-1)) {
  double sum = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (i == but) continue;
    double share = values[i];
    for (std::size_t k = 0; k < places.size(); ++k)
      if (k != i && k != but) share *= (at - places[k]) / (places[i] - places[k]);
    sum += share;
  }
  return sum;
}

/// Is each value between the first and the last told by the others?
/// @param enough how far off is no matter
inline bool is_even(std::span<double const> places, std::span<double const> values,
                    double enough = 0) {
  for (std::size_t i = 1; i + 1 < values.size(); ++i)
    if (!(std::abs(through(places, values, places[i], i) - values[i])
          <= even * std::abs(values[i]) + enough))
      return false;
  return true;
}

} // namespace abbe::transport::caustics
