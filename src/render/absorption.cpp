// SPDX-License-Identifier: MIT
#include "render/absorption.hpp"

#include "simd/native.hpp"

#include <iterator>

namespace abbe::render {
namespace {

/// exp(-depth): depth = k ln 2 + r with ln 2 in two parts (Cody and Waite 1980), the series of
/// exp(-r) to its 13th power, which leaves 4e-18 for |r| <= ln 2 / 2.
template <class L>
L attenuation(L const& depth) {
  constexpr double ln2_high = 6.93147180369123816490e-01; // its last 21 bits are zero
  constexpr double ln2_low = 1.90821492927058770002e-10;
  constexpr double per_ln2 = 1.44269504088896338700;
  constexpr double shift = 0x1.8p52;
  constexpr double deepest = 708; // exp(-708) is the last normal number, about
  L const zero(0.0), one(1.0);
  L const x = lane::select(L(deepest) < depth, L(deepest), depth);
  L const shifted = L(shift) - x * L(per_ln2);
  L const k = shifted - L(shift); // a whole number
  L const r = (-x - k * L(ln2_high)) - k * L(ln2_low);
  constexpr double inverse_factorial[] = {1.0 / 6227020800,
                                          1.0 / 479001600,
                                          1.0 / 39916800,
                                          1.0 / 3628800,
                                          1.0 / 362880,
                                          1.0 / 40320,
                                          1.0 / 5040,
                                          1.0 / 720,
                                          1.0 / 120,
                                          1.0 / 24,
                                          1.0 / 6,
                                          0.5,
                                          1.0};
  L series(inverse_factorial[0]);
  for (std::size_t i = 1; i < std::size(inverse_factorial); ++i)
    series = series * r + L(inverse_factorial[i]);
  L const value = (one + series * r) * lane::power_of_two(shifted);
  return lane::select(L(deepest) < depth, zero, value);
}

struct Absorb {
  template <class L>
  static void run(double const* depths, std::size_t count, double* values) {
    lane::in_lanes<L>(count, [&]<class Lanes>(std::size_t at) {
      Lanes const left = attenuation(lane::load<Lanes>(depths + at));
      if (at + lane::width<Lanes> <= count)
        return lane::store(values + at, lane::load<Lanes>(values + at) * left);
      double rest[lane::width<Lanes>];
      lane::store(rest, left);
      for (std::size_t i = at; i < count; ++i) values[i] *= rest[i - at];
    });
  }
};

simd::Native<Absorb> const absorb;

} // namespace

double transmittance(double optical_depth) {
  return attenuation(optical_depth);
}

void absorb_lanes(double* depths, std::size_t count, double* values) {
  for (std::size_t i = count; i % 4 != 0; ++i) depths[i] = 0;
  absorb(depths, count, values);
}

} // namespace abbe::render
