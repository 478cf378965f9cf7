// SPDX-License-Identifier: MIT
#include "simd/math.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>

namespace abbe::simd {
namespace {

__extension__ typedef unsigned __int128 Wide;

/// 2/pi, behind the point, 64 bits each.
constexpr std::uint64_t two_over_pi[] = {
    0xa2f9836e4e441529, 0xfc2757d1f534ddc0, 0xdb6295993c439041, 0xfe5163abdebbc561,
    0xb7246e3a424dd2e0, 0x06492eea09d1921c, 0xfe1deb1cb129a73e, 0xe88235f52ebb4484,
    0xe99c7026b45f7e41, 0x3991d639835339f4, 0x9c845f8bbdf9283b, 0x1ff897ffde05980f,
    0xef2f118b5a0a6d1f, 0x6d367ecf27cb09b7, 0x4f463f669e5fea2d, 0x7527bac7ebe5f17b,
    0x3d0739f78a5292ea, 0x6bfb5fb11f8d5d08, 0x56033046fc7b6bab, 0xf0cfbc209af4361d};

/// 64 bits of 2/pi from bit `first` behind the point on; zeros before it.
std::uint64_t bits_from(int first) {
  auto const word = [](int i) {
    return i < 0 || i >= static_cast<int>(std::size(two_over_pi)) ? 0 : two_over_pi[i];
  };
  int const i = first >= 0 ? first / 64 : -((63 - first) / 64), rest = first - 64 * i;
  return rest == 0 ? word(i) : word(i) << rest | word(i + 1) >> (64 - rest);
}

/// log(1 + x), to the digits of a small x.
double log1p(double x) {
  if (std::fabs(x) > 0.25) return log(1 + x);
  double const s = x / (2 + x), z = s * s;
  constexpr double series[] = {1.0 / 3,  1.0 / 5,  1.0 / 7,  1.0 / 9,  1.0 / 11,
                               1.0 / 13, 1.0 / 15, 1.0 / 17, 1.0 / 19, 1.0 / 21};
  double const square = 0.5 * x * x;
  return x - (square - s * (square + 2 * z * detail::polynomial(series, z)));
}

/// sinh by its series. @pre |x| <= 0.5
double small_sinh(double x) {
  constexpr double series[] = {1.0 / 6,        1.0 / 120,        1.0 / 5040,         1.0 / 362880,
                               1.0 / 39916800, 1.0 / 6227020800, 1.0 / 1307674368000};
  return x + x * (x * x * detail::polynomial(series, x * x));
}

} // namespace

namespace detail {

Reduced<double> reduce_large(double x) {
  auto const bits = std::bit_cast<std::uint64_t>(x);
  int const power = static_cast<int>(bits >> 52 & 0x7ff) - 1075; // |x| = whole 2^power
  std::uint64_t const whole = (bits & 0x000fffffffffffff) | 0x0010000000000000;
  // whole times the bits of 2/pi that stand for 2 and less, modulo 4: two bits, the point, 190
  // bits.
  int const first = power - 2;
  Wide const low = Wide{whole} * bits_from(first + 128),
             middle = Wide{whole} * bits_from(first + 64) + (low >> 64);
  std::uint64_t const top = whole * bits_from(first) + static_cast<std::uint64_t>(middle >> 64);
  int quadrant = static_cast<int>(top >> 62);
  // The fraction, 128 bits of it, to the nearest multiple.
  Wide fraction = (Wide{top} << 64 | static_cast<std::uint64_t>(middle)) << 2
                  | static_cast<std::uint64_t>(low) >> 62;
  bool const over = fraction >> 127 != 0;
  if (over) {
    fraction = -fraction;
    quadrant = (quadrant + 1) & 3;
  }
  double const high = static_cast<double>(fraction);
  // What is rounded off may be of either sign.
  Wide const back = high < 0x1p128 ? static_cast<Wide>(high) : Wide{0};
  double const low_part = fraction >= back && high < 0x1p128
                              ? static_cast<double>(fraction - back)
                              : -static_cast<double>(back - fraction);
  double const sign = over != (x < 0) ? -0x1p-128 : 0x1p-128;
  constexpr double half_pi = 0x1.921fb54442d18p+0, half_pi_low = 0x1.1a62633145c07p-54;
  double const h = high * sign, product = h * half_pi;
  auto const [r, r_low] = fast_sum(product, product_error(h, half_pi, product)
                                                + (h * half_pi_low + low_part * sign * half_pi));
  return {r, r_low, static_cast<double>(x < 0 ? -quadrant & 3 : quadrant)};
}

} // namespace detail

double cbrt(double x) {
  double const size = std::fabs(x);
  if (!(size > 0 && size < detail::largest)) return x;
  auto const log_x = detail::log_of(size);
  double const root = detail::exp_of(log_x.high / 3, log_x.low / 3);
  // One step of Newton's, with the square and the cube in twice the digits.
  double const scale = size < 0x1p-900 || size > 0x1p900 ? root : 1;
  double const y = root / scale, value = size / scale / scale / scale;
  double const square = y * y, square_low = product_error(y, y, square);
  double const cube = square * y, cube_low = product_error(square, y, cube) + square_low * y;
  double const better = root - scale * (((cube - value) + cube_low) / (3 * square));
  return x < 0 ? -better : better;
}

double sinh(double x) {
  double const size = std::fabs(x);
  if (!(size > 0.5)) return small_sinh(x);
  double const half = exp(0.5 * size); // exp(size) may be too large by itself
  double const value = size > 40 ? 0.5 * half * half : 0.5 * (exp(size) - exp(-size));
  return x < 0 ? -value : value;
}

double cosh(double x) {
  double const size = std::fabs(x), half = exp(0.5 * size);
  return size > 40 ? 0.5 * half * half : 0.5 * (exp(size) + exp(-size));
}

double tanh(double x) {
  double const size = std::fabs(x);
  if (!(size > 0.5)) return small_sinh(x) / cosh(x);
  double const value = 1 - 2 / (exp(2 * size) + 1);
  return x < 0 ? -value : value;
}

double asinh(double x) {
  double const size = std::fabs(x), square = size * size;
  if (!(size > 0)) return x;
  double const value = size > 0x1p28 ? log(size) + 0x1.62e42fefa39efp-1
                                     : log1p(size + square / (1 + std::sqrt(1 + square)));
  return x < 0 ? -value : value;
}

double acosh(double x) {
  if (x > 0x1p28) return log(x) + 0x1.62e42fefa39efp-1;
  double const over = x - 1; // NaN of a root below
  return log1p(over + std::sqrt(2 * over + over * over));
}

double atanh(double x) {
  double const size = std::fabs(x);
  double const value = 0.5 * log1p(2 * size / (1 - size));
  return x < 0 ? -value : value;
}

double expm1(double x) {
  return std::fabs(x) < 1 ? 2 * exp(0.5 * x) * small_sinh(0.5 * x) : exp(x) - 1;
}

double hypot(double x, double y) {
  double const high = std::max(std::fabs(x), std::fabs(y)),
               low = std::min(std::fabs(x), std::fabs(y));
  if (!(high > 0 && high < detail::largest)) return high + low;
  if (high > 0x1p-300 && high < 0x1p500) return std::sqrt(high * high + low * low);
  // By powers of two: scaled sides give the scaled length, bit by bit.
  if (high < 0x1p-900) return 0x1p-200 * hypot(0x1p200 * high, 0x1p200 * low);
  if (high > 0x1p900) return 0x1p200 * hypot(0x1p-200 * high, 0x1p-200 * low);
  double const unit = power_of_two(detail::shift - exponent(high));
  double const a = high * unit, b = low * unit;
  return std::sqrt(a * a + b * b) / unit;
}

} // namespace abbe::simd
