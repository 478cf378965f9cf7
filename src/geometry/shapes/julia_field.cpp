// SPDX-License-Identifier: MIT
#include "geometry/shapes/julia_field.hpp"

#include "geometry/shapes/julia_lanes.hpp"
#include "simd/math.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace abbe::geometry {

namespace {

using Complex = std::complex<double>;
using Function = JuliaRule::Function;

constexpr double infinite = std::numeric_limits<double>::infinity();
/// Bound of the rounding of a few operations.
constexpr double grain = 16 * 0x1p-53;

double size_of(Vec4 const& a) {
  return std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z + a.w * a.w);
}
double size_of(Complex const& a) {
  return std::sqrt(a.real() * a.real() + a.imag() * a.imag());
}
/// Quaternions: ij = k, jk = i, ki = j.
Vec4 product(Vec4 const& a, Vec4 const& b) {
  return {
      a.x * b.x - a.y * b.y - a.z * b.z - a.w * b.w, a.x * b.y + a.y * b.x + a.z * b.w - a.w * b.z,
      a.x * b.z - a.y * b.w + a.z * b.x + a.w * b.y, a.x * b.w + a.y * b.z - a.z * b.y + a.w * b.x};
}
Vec4 square(Vec4 const& a) {
  double const twice = 2 * a.x;
  return {a.x * a.x - a.y * a.y - a.z * a.z - a.w * a.w, twice * a.y, twice * a.z, twice * a.w};
}
Vec4 cube(Vec4 const& a) {
  double const vv = a.y * a.y + a.z * a.z + a.w * a.w, aa = a.x * a.x, along = 3 * aa - vv;
  return {a.x * (aa - 3 * vv), along * a.y, along * a.z, along * a.w};
}
Complex times(Complex const& a, Complex const& b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}
Complex inverse(Complex const& a) {
  double const square = a.real() * a.real() + a.imag() * a.imag();
  return {a.real() / square, -a.imag() / square};
}
Complex exp_of(Complex const& a) {
  double const size = simd::exp(a.real());
  return {size * simd::cos(a.imag()), size * simd::sin(a.imag())};
}
Complex ln_of(Complex const& a) {
  return {simd::log(simd::hypot(a.real(), a.imag())), simd::atan2(a.imag(), a.real())};
}
Complex root_of(Complex const& a) {
  double const size = simd::hypot(a.real(), a.imag());
  double const re = std::sqrt(std::max(0.0, (size + a.real()) / 2)),
               im = std::sqrt(std::max(0.0, (size - a.real()) / 2));
  return {re, std::copysign(im, a.imag())};
}
Complex sin_of(Complex const& a) {
  return {simd::sin(a.real()) * simd::cosh(a.imag()), simd::cos(a.real()) * simd::sinh(a.imag())};
}
Complex cos_of(Complex const& a) {
  return {simd::cos(a.real()) * simd::cosh(a.imag()), -simd::sin(a.real()) * simd::sinh(a.imag())};
}
Complex turned(Complex const& a) { // times i
  return {-a.imag(), a.real()};
}
Complex turned_back(Complex const& a) {
  return {a.imag(), -a.real()};
}
Complex asin_of(Complex const& a) {
  // -i ln(i a + sqrt(1 - a^2))
  return turned_back(ln_of(turned(a) + root_of(1.0 - times(a, a))));
}
Complex asinh_of(Complex const& a) {
  return ln_of(a + root_of(1.0 + times(a, a)));
}
Complex acosh_of(Complex const& a) {
  return ln_of(a + times(root_of(a + 1.0), root_of(a - 1.0)));
}
Complex atanh_of(Complex const& a) {
  return (ln_of(1.0 + a) - ln_of(1.0 - a)) * 0.5;
}

/// A function at the middle of a disc, with its slope there, and the largest sizes of slope and
/// bend on the disc.
struct Local {
  Complex value, slope;
  double steep = infinite, bend = infinite;
};

/// Does the disc come to the real axis left of `low` or right of `high`?
bool cut(Complex const& middle, double radius, double low, double high) {
  bool const near = std::fabs(middle.imag()) <= radius;
  return near && (middle.real() - radius <= low || middle.real() + radius >= high);
}

Local local(JuliaRule const& rule, Complex const& z, double r) {
  Local out;
  double const size = size_of(z), clear = size - r; // from zero
  // Where f' = 1 / sqrt(q): q at least the product of the ways to the two points where it is zero.
  auto const by_roots = [&](Complex const& a, Complex const& b, Complex const& q) {
    double const least = (size_of(z - a) - r) * (size_of(z - b) - r);
    out.slope = inverse(root_of(q));
    if (!(size_of(z - a) > r && size_of(z - b) > r)) return;
    out.steep = 1 / std::sqrt(least);
    out.bend = (size + r) * out.steep / least;
  };
  auto const by_quotient = [&](Complex const& f, Complex const& divisor, double most) {
    out.value = f;
    out.slope = inverse(times(divisor, divisor));
    double const least = size_of(divisor) - r * most;
    if (!(least > 0)) return;
    out.steep = 1 / (least * least);
    out.bend = 2 * most / least * out.steep;
  };
  switch (rule.function) {
  case Function::Sqr:
  case Function::Cube:
    return {times(z, z), z * 2.0, 2 * (size + r), 2};
  case Function::Exp:
    out.value = out.slope = exp_of(z);
    out.steep = out.bend = simd::exp(z.real() + r);
    return out;
  case Function::Reciprocal:
    out.value = inverse(z);
    out.slope = -times(out.value, out.value);
    if (clear > 0) {
      out.steep = 1 / (clear * clear);
      out.bend = 2 * out.steep / clear;
    }
    return out;
  case Function::Sin:
  case Function::Cos: {
    bool const sine = rule.function == Function::Sin;
    out.value = sine ? sin_of(z) : cos_of(z);
    out.slope = sine ? cos_of(z) : -sin_of(z);
    out.steep = out.bend = simd::cosh(std::fabs(z.imag()) + r);
    return out;
  }
  case Function::Sinh:
  case Function::Cosh: {
    Complex const sh = turned_back(sin_of(turned(z))), ch = cos_of(turned(z));
    bool const sine = rule.function == Function::Sinh;
    out.value = sine ? sh : ch;
    out.slope = sine ? ch : sh;
    out.steep = out.bend = simd::cosh(std::fabs(z.real()) + r);
    return out;
  }
  case Function::Tan: {
    Complex const cosine = cos_of(z);
    by_quotient(times(sin_of(z), inverse(cosine)), cosine, simd::cosh(std::fabs(z.imag()) + r));
    return out;
  }
  case Function::Tanh: {
    Complex const cosine = cos_of(turned(z));
    by_quotient(times(turned_back(sin_of(turned(z))), inverse(cosine)), cosine,
                simd::cosh(std::fabs(z.real()) + r));
    return out;
  }
  case Function::Asin:
  case Function::Acos: {
    bool const sine = rule.function == Function::Asin;
    by_roots(1.0, -1.0, 1.0 - times(z, z));
    out.value = asin_of(z);
    if (!sine) {
      out.value = 1.57079632679489661923 - out.value;
      out.slope = -out.slope;
    }
    if (cut(z, r, -1, 1)) out.steep = infinite;
    return out;
  }
  case Function::Asinh:
    by_roots({0, 1}, {0, -1}, 1.0 + times(z, z));
    out.value = asinh_of(z);
    if (cut(turned(z), r, -1, 1)) out.steep = infinite;
    return out;
  case Function::Acosh:
    by_roots(1.0, -1.0, times(z, z) - 1.0);
    out.value = acosh_of(z);
    out.slope = times(inverse(root_of(z + 1.0)), inverse(root_of(z - 1.0)));
    if (std::fabs(z.imag()) <= r && z.real() - r <= 1) out.steep = infinite;
    return out;
  case Function::Atan:
  case Function::Atanh: {
    bool const circular = rule.function == Function::Atan;
    Complex const w = circular ? turned(z) : z;
    out.value = circular ? turned_back(atanh_of(w)) : atanh_of(w);
    out.slope = inverse(1.0 - times(w, w));
    double const least = (size_of(w - 1.0) - r) * (size_of(w + 1.0) - r);
    if (size_of(w - 1.0) > r && size_of(w + 1.0) > r && !cut(w, r, -1, 1)) {
      out.steep = 1 / least;
      out.bend = 2 * (size + r) * out.steep * out.steep;
    }
    return out;
  }
  case Function::Ln:
    out.value = ln_of(z);
    out.slope = inverse(z);
    if (clear > 0 && !cut(z, r, 0, infinite)) {
      out.steep = 1 / clear;
      out.bend = out.steep * out.steep;
    }
    return out;
  case Function::Power: {
    Complex const l = ln_of(z), w = rule.power;
    out.value = exp_of(times(w, l));
    out.slope = times(w, exp_of(times(w - 1.0, l)));
    if (clear > 0 && !cut(z, r, 0, infinite)) {
      auto const most = [&](Complex const& e) {
        return simd::exp(times(e, l).real() + size_of(e) * r / clear);
      };
      out.steep = size_of(w) * most(w - 1.0);
      out.bend = size_of(w) * size_of(w - 1.0) * most(w - 2.0);
    }
    return out;
  }
  }
  return out;
}

/// Certainly above zero: where a number is too large already.
constexpr ScalarField::Along outside{{1e-300, infinite}, Interval::everything()};

} // namespace

double JuliaRule::bailout() const {
  return quaternion ? 1 + size_of(c) : 4;
}

double JuliaRule::reach() const {
  double const most = bailout();
  if (function != Function::Sqr && function != Function::Cube) return most;
  // Of two complex numbers that join to one of size s, each is of size s sqrt(2) at most.
  double const added[2] = {quaternion ? size_of(c) : std::hypot(c.x - c.w, c.y + c.z),
                           quaternion ? 0 : std::hypot(c.x + c.w, c.y - c.z)};
  double own[2] = {most, most};
  for (int k = 0; k < 2; ++k) {
    double& size = own[k];
    if (!quaternion) size *= 1.4142135623730951;
    for (int round = 1; round < rounds; ++round)
      size = function == Function::Sqr ? std::sqrt(size + added[k]) : std::cbrt(size + added[k]);
  }
  double const joined = std::sqrt((own[0] * own[0] + own[1] * own[1]) / 2);
  return std::min(most, (quaternion ? own[0] : joined) * (1 + 1e-9));
}

JuliaField::JuliaField(JuliaRule const& rule) : rule_(rule) {
  limit_ = rule.bailout() * rule.bailout();
  // Of quaternions, because the bailout is 1 + |c|. Of a pair one is larger than 4, and of its
  // square c takes no more than 4: what is left is larger than 8.
  returns_ =
      !rule.quaternion
      && (rule.function != Function::Sqr || std::hypot(rule.c.x - rule.c.w, rule.c.y + rule.c.z) > 4
          || std::hypot(rule.c.x + rule.c.w, rule.c.y - rule.c.z) > 4);
}

Vec4 JuliaField::lifted(Vec3 const& p) const {
  Vec4 const& n = rule_.slice;
  return {p.x, p.y, p.z, (rule_.slice_distance - n.x * p.x - n.y * p.y - n.z * p.z) / n.w};
}

bool JuliaField::smooth() const {
  return rule_.rounds <= 12 && polynomial();
}

void JuliaField::along_each(Vec3 const& origin, Vec3 const& direction, LinePieces& pieces) const {
  if (!polynomial()) return ScalarField::along_each(origin, direction, pieces);
  Vec4 const& n = rule_.slice;
  double const slant = glm::dot(Vec3(n), direction) / n.w;
  JuliaLine const line{lifted(origin),
                       Vec4(direction, -slant),
                       rule_.c,
                       rule_.rounds,
                       limit_,
                       grain / std::fabs(n.w),
                       glm::dot(glm::abs(origin), Vec3(1)) + std::fabs(rule_.slice_distance),
                       glm::dot(glm::abs(direction), Vec3(1))};
  auto const kind = returns_                           ? JuliaLine::Kind::ReturningPairs
                    : !rule_.quaternion                ? JuliaLine::Kind::Pairs
                    : rule_.function == Function::Cube ? JuliaLine::Kind::Cubes
                                                       : JuliaLine::Kind::Squares;
  julia_along_each(kind, line, pieces);
}

ScalarField::Along JuliaField::quaternions(Vec4 h, double r, Vec4 d) const {
  bool const cube = rule_.function == Function::Cube;
  double dr = 0; // of the derivative
  for (int round = 1;; ++round) {
    double const size = size_of(h), low = std::max(0.0, size * (1 - grain) - r),
                 high = size * (1 + grain) + r;
    if (round == rule_.rounds) {
      double const inner = h.x * d.x + h.y * d.y + h.z * d.z + h.w * d.w, fast = size_of(d);
      double const off = size * dr + fast * r + r * dr + grain * size * fast;
      return {widened(low * low - limit_, high * high - limit_, 4),
              widened(2 * (inner - off), 2 * (inner + off), 4)};
    }
    if (low * low > limit_ * (1 + grain)) return outside;
    double const fast = size_of(d);
    Vec4 const hh = square(h);
    if (cube) {
      dr = 3 * ((fast + dr) * high * high - fast * size * size) + grain * fast * size * size * 3;
      d = product(product(d, h) + product(h, d), h) + product(hh, d);
      h = product(hh, h);
      r = high * high * high - size * size * size + grain * size * size * size;
    } else {
      dr = 2 * ((fast + dr) * high - fast * size) + grain * fast * size * 2;
      d = product(d, h) + product(h, d);
      h = hh;
      r = (2 * size + r) * r + grain * size * size;
    }
    h += rule_.c;
    r += grain * limit_;
  }
}

ScalarField::Along JuliaField::complex_pairs(Vec4 const& h, double radius, Vec4 const& d) const {
  // Both complex numbers of h = x + i y + j z + k w, and of what is added.
  auto const first = [](Vec4 const& v) { return Complex(v.x - v.w, v.y + v.z); };
  auto const second = [](Vec4 const& v) { return Complex(v.x + v.w, v.y - v.z); };
  Complex z[2] = {first(h), second(h)}, slope[2] = {first(d), second(d)};
  Complex const c[2] = {first(rule_.c), second(rule_.c)};
  double r[2] = {2 * radius, 2 * radius}, slope_r[2] = {0, 0};
  ScalarField::Along out{{-infinite, -infinite}, {infinite, -infinite}};
  for (int round = 1;; ++round) {
    // |h|^2 is half of the sum of both.
    Interval square(0), rate(0);
    for (int k = 0; k < 2; ++k) {
      double const size = size_of(z[k]), fast = size_of(slope[k]);
      double const low = std::max(0.0, size * (1 - grain) - r[k]), high = size * (1 + grain) + r[k];
      square = square + widened(low * low / 2, high * high / 2, 2);
      double const inner = z[k].real() * slope[k].real() + z[k].imag() * slope[k].imag();
      double const off = size * slope_r[k] + fast * r[k] + r[k] * slope_r[k] + grain * size * fast;
      rate = rate + widened(inner - off, inner + off, 2);
    }
    Interval const value = square - Interval(limit_);
    if (!(value.low <= value.high)) return {Interval::everything(), Interval::everything()};
    if (value.low > 0) return outside;
    // The largest of all: the slope is that of any that may be it.
    if (returns_ || round == rule_.rounds) {
      if (value.high >= out.value.low) {
        bool const alone = value.low > out.value.high;
        out.slope = alone ? rate : hull(out.slope, rate);
      }
      out.value = {std::max(out.value.low, value.low), std::max(out.value.high, value.high)};
    }
    if (round == rule_.rounds) return out;
    for (int k = 0; k < 2; ++k) {
      Local const f = local(rule_, z[k], r[k]);
      double const fast = size_of(slope[k]), steep = size_of(f.slope);
      double const f_r = f.bend * r[k];
      slope_r[k] = steep * slope_r[k] + f_r * (fast + slope_r[k]) + grain * steep * fast;
      slope[k] = times(f.slope, slope[k]);
      r[k] = f.steep * r[k] + grain * (size_of(f.value) + 16 + steep * size_of(z[k]));
      z[k] = f.value + c[k];
      if (!(r[k] < infinite) || !(slope_r[k] < infinite))
        return {Interval::everything(), Interval::everything()};
    }
  }
}

ScalarField::Along JuliaField::along(Vec3 const& origin, Vec3 const& direction,
                                     Interval const& part) const {
  double const middle = part.middle(), half = part.width() * 0.5;
  Vec3 const point = origin + middle * direction;
  Vec4 const h = lifted(point);
  Vec4 const& n = rule_.slice;
  Vec4 const d(direction, -(n.x * direction.x + n.y * direction.y + n.z * direction.z) / n.w);
  Vec3 const far = glm::abs(origin) + std::fabs(middle) * glm::abs(direction);
  double const rounding =
      grain * (far.x + far.y + far.z + std::fabs(rule_.slice_distance)) / std::fabs(n.w);
  double const radius = half * size_of(d) * (1 + grain) + rounding;
  return rule_.quaternion ? quaternions(h, radius, d) : complex_pairs(h, radius, d);
}

double JuliaField::value(Vec3 const& point) const {
  Vec4 h = lifted(point);
  if (rule_.quaternion) {
    for (int round = 1;; ++round) {
      double const above = h.x * h.x + h.y * h.y + h.z * h.z + h.w * h.w - limit_;
      if (round == rule_.rounds || above > 0) return above;
      h = (rule_.function == Function::Cube ? cube(h) : square(h)) + rule_.c;
    }
  }
  auto const pair = [](Vec4 const& v, int k) {
    return k == 0 ? Complex(v.x - v.w, v.y + v.z) : Complex(v.x + v.w, v.y - v.z);
  };
  auto const next = [&](Complex const& a) {
    return rule_.function == Function::Sqr ? times(a, a) : local(rule_, a, 0).value;
  };
  Complex z[2] = {pair(h, 0), pair(h, 1)};
  double most = -infinite;
  for (int round = 1;; ++round) {
    double square = 0;
    for (Complex const& a : z) square += (a.real() * a.real() + a.imag() * a.imag()) / 2;
    if (!(square - limit_ <= 0)) return std::isfinite(square) ? square - limit_ : limit_;
    most = returns_ ? std::max(most, square - limit_) : square - limit_;
    if (round == rule_.rounds) return most;
    for (int k = 0; k < 2; ++k) z[k] = next(z[k]) + pair(rule_.c, k);
  }
}

Vec3 JuliaField::quaternion_gradient(Vec3 const& point) const {
  Vec4 h = lifted(point);
  Vec3 const slant = Vec3(rule_.slice) / -rule_.slice.w;
  Vec4 rate[3] = {{1, 0, 0, slant.x}, {0, 1, 0, slant.y}, {0, 0, 1, slant.z}};
  bool const cube = rule_.function == Function::Cube;
  for (int round = 1; round < rule_.rounds; ++round) {
    double const vv = h.y * h.y + h.z * h.z + h.w * h.w, aa = h.x * h.x;
    double const along = cube ? 3 * aa - vv : 2 * h.x;
    for (Vec4& d : rate) {
      // Of a + v: (a^2 - v^2) + 2 a v, or (a^3 - 3 a v^2) + (3 a^2 - v^2) v.
      double const inner = h.y * d.y + h.z * d.z + h.w * d.w;
      double const turn = cube ? 6 * h.x * d.x - 2 * inner : 2 * d.x;
      double const real = cube ? 3 * (aa - vv) * d.x - 6 * h.x * inner : 2 * (h.x * d.x - inner);
      d = {real, turn * h.y + along * d.y, turn * h.z + along * d.z, turn * h.w + along * d.w};
    }
    h = Vec4(cube ? h.x * (aa - 3 * vv) : aa - vv, along * h.y, along * h.z, along * h.w) + rule_.c;
  }
  auto const of = [&](Vec4 const& d) {
    double const out = 2 * (h.x * d.x + h.y * d.y + h.z * d.z + h.w * d.w);
    return std::isfinite(out) ? out : 0;
  };
  return {of(rate[0]), of(rate[1]), of(rate[2])};
}

/// Of squares of which the last counts.
Vec3 JuliaField::pair_gradient(Vec3 const& point) const {
  Vec4 const h = lifted(point), c = rule_.c;
  Vec3 const slant = Vec3(rule_.slice) / -rule_.slice.w;
  Vec3 out(0);
  for (double const sign : {-1.0, 1.0}) {
    auto const half = [&](Vec4 const& v) { return Complex(v.x + sign * v.w, v.y - sign * v.z); };
    Complex z = half(h), rate[3] = {half({1, 0, 0, slant.x}), half({0, 1, 0, slant.y}),
                                    half({0, 0, 1, slant.z})};
    for (int round = 1; round < rule_.rounds; ++round) {
      for (Complex& d : rate) d = times(z, d) * 2.0;
      z = times(z, z) + half(c);
    }
    for (int i = 0; i < 3; ++i) {
      double const own = z.real() * rate[i].real() + z.imag() * rate[i].imag();
      if (std::isfinite(own)) out[i] += own;
    }
  }
  return out;
}

Vec3 JuliaField::gradient(Vec3 const& point) const {
  if (rule_.quaternion) return quaternion_gradient(point);
  if (!returns_) return pair_gradient(point);
  Vec3 out(0);
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 direction(0);
    direction[axis] = 1;
    Interval const slope = along(point, direction, Interval(0)).slope;
    if (std::isfinite(slope.low) && std::isfinite(slope.high)) out[axis] = slope.middle();
  }
  return out;
}

} // namespace abbe::geometry
