// SPDX-License-Identifier: MIT
#include "lang/dual_interval.hpp"

#include "lang/float_functions.hpp"
#include "simd/math.hpp"

#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

namespace abbe::lang {
namespace {

constexpr double pi = 3.14159265358979323846;
/// Units in the last place that functions of simd/math.hpp may be off by.
constexpr int library = 4, library_power = 17;

Interval const everything = Interval::everything();

template <class F>
Interval rising(F const& f, Interval const& x, int off = library) {
  return widened(f(x.low), f(x.high), off);
}
template <class F>
Interval falling(F const& f, Interval const& x, int off = library) {
  return widened(f(x.high), f(x.low), off);
}
double sqrt_of(double x) {
  return std::sqrt(x);
}

/// What is left of x in [low, high], where a function is defined.
Interval within(Interval const& x, double low, double high) {
  Interval const cut{std::max(x.low, low), std::min(x.high, high)};
  return cut.low <= cut.high ? cut : Interval{low, high};
}

/// Does x hold a point of phase + 2 pi k? Errs towards yes.
bool meets(Interval const& x, double phase) {
  double const slack = 1e-15 * (1 + x.size());
  double const first = std::ceil((x.low - slack - phase) / (2 * pi) - 1e-12);
  return phase + 2 * pi * first <= x.high + slack;
}
Interval sine(Interval const& x) {
  if (!(x.size() < 1e12) || x.width() >= 2 * pi) return {-1, 1};
  double const a = simd::sin(x.low), b = simd::sin(x.high);
  Interval result = widened(std::min(a, b), std::max(a, b), library);
  if (meets(x, pi / 2)) result.high = 1;
  if (meets(x, -pi / 2)) result.low = -1;
  return result;
}
Interval cosine(Interval const& x) {
  if (!(x.size() < 1e12) || x.width() >= 2 * pi) return {-1, 1};
  double const a = simd::cos(x.low), b = simd::cos(x.high);
  Interval result = widened(std::min(a, b), std::max(a, b), library);
  if (meets(x, 0)) result.high = 1;
  if (meets(x, pi)) result.low = -1;
  return result;
}
Interval cosine_h(Interval const& x) {
  return rising([](double v) { return simd::cosh(v); }, abs(x));
}

/// x^n for a whole n; x^y else, where x >= 0.
Interval power(Interval const& x, double n) {
  auto const f = [n](double v) { return simd::pow(v, n); };
  if (n == 0) return 1;
  bool const whole = n == std::trunc(n);
  if (whole && n < 0 && x.low <= 0 && x.high >= 0) return everything;
  if (whole && std::fmod(n, 2) != 0)
    return n > 0 || x.low > 0 || x.high < 0
               ? (n > 0 ? rising(f, x, library_power) : falling(f, x, library_power))
               : everything;
  Interval const size = whole ? abs(x) : within(x, 0, std::numeric_limits<double>::infinity());
  return n > 0 ? rising(f, size, library_power) : falling(f, size, library_power);
}

Dual abs_of(Dual const& a, Dual const&) {
  if (a.v.low >= 0) return a;
  if (a.v.high <= 0) return -a;
  return {abs(a.v), hull(a.d, -a.d)};
}
Dual acos_of(Dual const& a, Dual const&) {
  Interval const x = within(a.v, -1, 1);
  Interval const root = rising(sqrt_of, within(Interval(1) - square(x), 0, 1));
  return {falling([](double v) { return simd::acos(v); }, x), -(a.d / root)};
}
Dual asin_of(Dual const& a, Dual const&) {
  Interval const x = within(a.v, -1, 1);
  Interval const root = rising(sqrt_of, within(Interval(1) - square(x), 0, 1));
  return {rising([](double v) { return simd::asin(v); }, x), a.d / root};
}
Dual acosh_of(Dual const& a, Dual const&) {
  Interval const x = within(a.v, 1, everything.high);
  Interval const root = rising(sqrt_of, within(square(x) - Interval(1), 0, everything.high));
  return {rising([](double v) { return std::acosh(v); }, x), a.d / root};
}
Dual asinh_of(Dual const& a, Dual const&) {
  return {rising([](double v) { return std::asinh(v); }, a.v),
          a.d / rising(sqrt_of, square(a.v) + Interval(1))};
}
Dual atan_of(Dual const& a, Dual const&) {
  return {rising([](double v) { return simd::atan(v); }, a.v), a.d / (square(a.v) + Interval(1))};
}
Dual atanh_of(Dual const& a, Dual const&) {
  Interval const x = within(a.v, -1, 1);
  return {rising([](double v) { return std::atanh(v); }, x), a.d / (Interval(1) - square(x))};
}
Dual atan2_of(Dual const& y, Dual const& x) {
  auto const arc = [](double v) { return simd::atan(v); };
  Interval const slope = (x.v * y.d - y.v * x.d) / (square(x.v) + square(y.v));
  if (x.v.low > 0) return {rising(arc, y.v / x.v), slope};
  Interval const quarter = widened(pi / 2, pi / 2);
  if (y.v.low > 0) return {quarter - rising(arc, x.v / y.v), slope};
  if (y.v.high < 0) return {-quarter - rising(arc, x.v / y.v), slope};
  return {widened(-pi, pi), everything};
}
template <double (*step)(double)>
Dual step_of(Dual const& a, Dual const&) {
  Interval const v{step(a.v.low), step(a.v.high)};
  return {v, v.low == v.high ? Interval(0) : everything};
}
Dual cos_of(Dual const& a, Dual const&) {
  return {cosine(a.v), -(sine(a.v) * a.d)};
}
Dual sin_of(Dual const& a, Dual const&) {
  return {sine(a.v), cosine(a.v) * a.d};
}
Dual tan_of(Dual const& a, Dual const&) {
  if (!(a.v.width() < pi) || !(a.v.size() < 1e12) || meets(a.v, pi / 2) || meets(a.v, -pi / 2))
    return {everything, everything};
  Interval const v = rising([](double x) { return simd::tan(x); }, a.v);
  return {v, (square(v) + Interval(1)) * a.d};
}
Dual cosh_of(Dual const& a, Dual const&) {
  return {cosine_h(a.v), rising([](double v) { return simd::sinh(v); }, a.v) * a.d};
}
Dual sinh_of(Dual const& a, Dual const&) {
  return {rising([](double v) { return simd::sinh(v); }, a.v), cosine_h(a.v) * a.d};
}
Dual tanh_of(Dual const& a, Dual const&) {
  Interval const v = rising([](double x) { return simd::tanh(x); }, a.v);
  return {v, (Interval(1) - square(v)) * a.d};
}
Dual exp_of(Dual const& a, Dual const&) {
  Interval const v = rising([](double x) { return simd::exp(x); }, a.v);
  return {v, v * a.d};
}
template <double (*log)(double)>
Dual log_of(Dual const& a, Dual const&) {
  Interval const x = within(a.v, 0, everything.high);
  Interval const scale = rising(log, Interval(2.71828182845904523536));
  return {rising(log, x), a.d * scale / x};
}
Dual mod_of(Dual const& a, Dual const& b) {
  double const first = std::trunc(a.v.low / b.v.low), last = std::trunc(a.v.high / b.v.low);
  if (b.v.low == b.v.high && first == last && std::fabs(first) < 0x1p52)
    return a - Dual{Interval(first) * b.v, Interval(0)};
  double const most = b.v.size();
  return {Interval{a.v.low < 0 ? -most : 0.0, a.v.high > 0 ? most : 0.0}, everything};
}
Dual pow_of(Dual const& a, Dual const& b) {
  if (b.v.low == b.v.high && b.d.low == 0 && b.d.high == 0) {
    double const n = b.v.low;
    return {power(a.v, n), Interval(n) * power(a.v, n - 1) * a.d};
  }
  Dual const exponent = b * log_of<std::log>(a, {});
  return exp_of(exponent, {});
}
Dual sqrt_dual(Dual const& a, Dual const&) {
  Interval const v = rising(sqrt_of, within(a.v, 0, everything.high));
  Interval const root{std::max(v.low, 0.0), v.high};
  return {root, a.d / (Interval(2) * root)};
}
template <int to_degrees>
Dual angle_of(Dual const& a, Dual const&) {
  Interval const factor(to_degrees != 0 ? 180 / pi : pi / 180);
  return {a.v * factor, a.d * factor};
}
Dual square_of(Dual const& a, Dual const&) {
  return square(a);
}

using Function = Dual (*)(Dual const&, Dual const&);
constexpr std::pair<std::string_view, Function> by_name[] = {
    {"abs", abs_of},
    {"acos", acos_of},
    {"acosh", acosh_of},
    {"asin", asin_of},
    {"asinh", asinh_of},
    {"atan", atan_of},
    {"atan2", atan2_of},
    {"atanh", atanh_of},
    {"ceil", step_of<std::ceil>},
    {"cos", cos_of},
    {"cosh", cosh_of},
    {"degrees", angle_of<1>},
    {"exp", exp_of},
    {"floor", step_of<std::floor>},
    {"int", step_of<std::trunc>},
    {"ln", log_of<std::log>},
    {"log", log_of<std::log10>},
    {"mod", mod_of},
    {"pow", pow_of},
    {"radians", angle_of<0>},
    {"sin", sin_of},
    {"sinh", sinh_of},
    {"sqr", square_of},
    {"sqrt", sqrt_dual},
    {"tan", tan_of},
    {"tanh", tanh_of},
};

Dual unknown(Dual const&, Dual const&) {
  return {everything, everything};
}

} // namespace

Dual apply(std::size_t function, Dual const& a, Dual const& b) {
  static std::vector<Function> const table = [] {
    std::vector<Function> functions;
    for (FloatFunction const& plain : float_functions()) {
      Function found = unknown;
      for (auto const& [name, dual] : by_name)
        if (name == plain.name) found = dual;
      functions.push_back(found);
    }
    return functions;
  }();
  Dual const result = table[function](a, b);
  return {result.v, result.v.low <= result.v.high ? result.d : everything};
}

} // namespace abbe::lang
