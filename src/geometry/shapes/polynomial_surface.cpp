// SPDX-License-Identifier: MIT
#include "geometry/shapes/polynomial_surface.hpp"

#include "geometry/line.hpp"
#include "geometry/shapes/reading.hpp"
#include "geometry/shapes/start.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::geometry {

namespace {

/// acc <- acc (p + e s) + k, where acc of degree -1 is nothing yet.
template <class N>
struct Accumulator {
  int degree = -1;
  std::array<N, largest_degree + 1> c;

  void times_linear(N const& p, N const& e) {
    if (degree < 0) return;
    auto const top = static_cast<std::size_t>(degree);
    c[top + 1] = e * c[top];
    for (std::size_t i = top; i > 0; --i) c[i] = c[i] * p + c[i - 1] * e;
    c[0] = c[0] * p;
    ++degree;
  }
  void add(double k) {
    if (k == 0 && degree < 0) return;
    c[0] = degree < 0 ? N(k) : c[0] + N(k);
    degree = std::max(degree, 0);
  }
  void add(Accumulator const& other) {
    for (int i = 0; i <= other.degree; ++i) {
      auto const k = static_cast<std::size_t>(i);
      c[k] = i <= degree ? c[k] + other.c[k] : other.c[k];
    }
    degree = std::max(degree, other.degree);
  }
};

/// Where x, y and z along a line are p + e s: polynomials in s of the orders that scenes mostly
/// have, by the same scheme with nothing left to decide.
struct Composer {
  double const* k; ///< the next coefficient
  std::array<double, 3> const &p, &e;

  /// Of the powers of the axes from `Axis` on, of an order that is M - 1.
  template <std::size_t M, std::size_t Axis = 0>
  std::array<double, M> along() {
    return next<M, Axis>(of_order<1, Axis>());
  }

private:
  template <std::size_t M, std::size_t Axis, std::size_t Done>
  std::array<double, M> next(std::array<double, Done> const& f) {
    if constexpr (Done == M) {
      return f;
    } else {
      auto out = of_order<Done + 1, Axis>();
      out[0] = f[0] * p[Axis] + out[0];
      for (std::size_t i = 1; i < Done; ++i) out[i] = f[i] * p[Axis] + f[i - 1] * e[Axis] + out[i];
      out[Done] = f[Done - 1] * e[Axis] + out[Done];
      return next<M, Axis>(out);
    }
  }
  /// What the next powers of the axis are times.
  template <std::size_t M, std::size_t Axis>
  std::array<double, M> of_order() {
    if constexpr (Axis < 2) {
      return along<M, Axis + 1>();
    } else {
      std::array<double, M> constant{};
      constant[0] = *k++;
      return constant;
    }
  }
};

std::size_t coefficient_count(int order) {
  auto const n = static_cast<std::size_t>(order);
  return (n + 1) * (n + 2) * (n + 3) / 6;
}

/// 2^k >= x > 0, the smallest.
double power_of_two_from(double x) {
  return std::exp2(std::ilogb(x) + 1);
}

} // namespace

struct PolynomialSurface::Window {
  Line<double> line;
  Approach<double> near;
  double unit = 1;  ///< of t, a power of two
  double reach = 1; ///< of point + unit direction, per component
};

PolynomialSurface::PolynomialSurface(int order, std::vector<double> coefficients)
    : order_(order), coefficients_(std::move(coefficients)), feature_(1) {
  double largest = 0;
  for (double const k : coefficients_) largest = std::max(largest, std::fabs(k));
  double const scale = std::exp2(-std::ilogb(largest));
  size_.assign(static_cast<std::size_t>(order_) + 1, 0);
  std::size_t next = 0;
  for (int a = order_; a >= 0; --a) {
    for (int b = order_ - a; b >= 0; --b) {
      for (int c = order_ - a - b; c >= 0; --c) {
        coefficients_[next] *= scale;
        size_[static_cast<std::size_t>(a + b + c)] += std::fabs(coefficients_[next++]);
      }
    }
  }
  int top = order_;
  while (top > 0 && size_[static_cast<std::size_t>(top)] == 0) --top;
  // Cauchy's bound of what is not far away, as a power of two: exact, whatever the unit.
  bool any = false;
  int exponent = 0;
  for (int k = 0; k < top; ++k) {
    double const ratio = size_[static_cast<std::size_t>(k)] / size_[static_cast<std::size_t>(top)];
    if (!(ratio > 0) || !std::isfinite(ratio)) continue;
    int const share = top - k, level = std::ilogb(ratio);
    int const root = (level >= 0 ? level / share : -((share - 1 - level) / share)) + 1;
    exponent = any ? std::max(exponent, root) : root;
    any = true;
  }
  feature_ = std::exp2(exponent);
}

double PolynomialSurface::size_within(double reach) const {
  double sum = 0;
  for (std::size_t k = size_.size(); k-- > 0;) sum = sum * reach + size_[k];
  return sum;
}

template <class N>
Polynomial<N> PolynomialSurface::along(std::array<N, 3> const& p, std::array<N, 3> const& e) const {
  if constexpr (std::is_same_v<N, double>) {
    Composer composer{coefficients_.data(), p, e};
    auto const of = [](auto const& c) {
      Polynomial<double> f;
      f.degree = static_cast<int>(c.size()) - 1;
      std::copy(c.begin(), c.end(), f.c.begin());
      return f;
    };
    if (order_ == 3) return of(composer.along<4>());
    if (order_ == 4) return of(composer.along<5>());
  }
  Accumulator<N> in_x, in_y, in_z;
  std::size_t next = 0;
  in_x.degree = -1;
  for (int a = order_; a >= 0; --a) {
    in_y.degree = -1;
    for (int b = order_ - a; b >= 0; --b) {
      in_z.degree = -1;
      for (int c = order_ - a - b; c >= 0; --c) {
        in_z.times_linear(p[2], e[2]);
        in_z.add(coefficients_[next++]);
      }
      in_y.times_linear(p[1], e[1]);
      in_y.add(in_z);
    }
    in_x.times_linear(p[0], e[0]);
    in_x.add(in_y);
  }
  Polynomial<N> f;
  f.degree = std::max(in_x.degree, 0);
  f.c[0] = N(0.0);
  for (int i = 0; i <= in_x.degree; ++i) {
    auto const k = static_cast<std::size_t>(i);
    f.c[k] = in_x.c[k];
  }
  return f;
}

Polynomial<double> PolynomialSurface::compose(Window const& w) const {
  std::array<double, 3> p, e;
  double const o[3] = {w.line.origin.x, w.line.origin.y, w.line.origin.z};
  double const d[3] = {w.line.direction.x, w.line.direction.y, w.line.direction.z};
  double off = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    // Far away, o + t d cancels: so it is made right to its own last digit.
    double const step = w.near.t * d[i];
    Twofold const place = Twofold(o[i]) + Twofold(w.near.t) * Twofold(d[i]);
    p[i] = place.high;
    e[i] = w.unit * d[i];
    off = std::max(off, std::fabs(p[i]) + 0x1p-48 * (std::fabs(o[i]) + std::fabs(step)));
  }
  Polynomial<double> f = along(p, e);
  // Each coefficient comes by at most 3 order multiplications and additions, and what p is off by
  // moves each power by that share of the reach.
  f.error = size_within(w.reach) * unit_roundoff * (8 * (order_ + 2) + 4 * order_ * off / w.reach);
  return f;
}

Polynomial<Twofold> PolynomialSurface::compose_piece(Window const& w, Twofold const& low,
                                                     double width) const {
  std::array<Twofold, 3> p, e;
  double const o[3] = {w.line.origin.x, w.line.origin.y, w.line.origin.z};
  double const d[3] = {w.line.direction.x, w.line.direction.y, w.line.direction.z};
  Twofold const t = Twofold(w.near.t) + Twofold(w.unit) * low;
  double off[3], reach[3];
  for (std::size_t i = 0; i < 3; ++i) {
    Twofold const step = t * Twofold(d[i]);
    p[i] = Twofold(o[i]) + step;
    e[i] = Twofold(width * w.unit) * Twofold(d[i]);
    off[i] = std::fabs(o[i]) + std::fabs(rounded(step)) + std::fabs(w.near.t * d[i]);
    reach[i] = std::fabs(rounded(p[i])) + std::fabs(rounded(e[i])) + 8 * roundoff<Twofold> * off[i];
  }
  Polynomial<Twofold> f = along(p, e);
  // The same, by components; p is off by 4 roundings of its terms.
  Local const size = local<true>({reach[0], reach[1], reach[2]});
  f.error = roundoff<Twofold>
            * (8 * (order_ + 2) * size.value
               + 8 * (size.slope.x * off[0] + size.slope.y * off[1] + size.slope.z * off[2]));
  return f;
}

void PolynomialSurface::find(Ray const& ray, Start const* start, double until, bool all,
                             Crossings& out) const {
  Window w;
  w.line = line_of(ray);
  Vec3 const& d = ray.direction;
  w.near = approach(w.line, -glm::dot(ray.origin, d) / glm::dot(d, d));
  Vec3 const p(w.near.point.x, w.near.point.y, w.near.point.z);
  double const length = vector_length(d), away = vector_length(p);
  double const window = std::max(feature_, away > 0 ? power_of_two_from(away) : 0.0);
  w.unit = window * std::exp2(-std::ilogb(length));
  w.reach = away + 2 * window;

  Wanted wanted;
  if (!all) {
    // By more than the errors of crossings there.
    double const margin = 0x1p-20 * (w.reach + std::fabs(w.near.t) * length) / (w.unit * length);
    wanted = Wanted(-w.near.t / w.unit, (until - w.near.t) / w.unit, margin);
  }
  PolynomialRoots roots;
  if (!line_roots(compose(w), roots, wanted)) {
    PieceMaker const make = [&](Twofold const& low, double width) {
      return compose_piece(w, low, width);
    };
    line_roots(make(Twofold(0.0), 1), make, roots);
  }
  std::size_t const first = out.size();
  for (PolynomialRoot const& root : roots) {
    double const step = root.at * w.unit, t = w.near.t + step;
    Vec3 const at = p + step * d;
    Local const here = local<false>(at);
    Vec3 const size = glm::abs(here.slope);
    auto const moved = [&](lane::Vec<double> const& by) {
      return lane::dot({size.x, size.y, size.z}, by);
    };
    double const off = moved(w.line.origin_rounding + std::fabs(t) * w.line.direction_rounding);
    double error = root.error + root_motion(off, root.slope, root.bend);
    if (all || t + w.unit * error > 0) {
      // The polynomial along the line has the error of all of its window; what is left of the value
      // here, and its rounding, often tell more.
      Local const sizes = local<true>(glm::abs(at));
      Vec3 const place = glm::abs(at) + 2 * std::fabs(step) * glm::abs(d);
      double const left = std::fabs(here.value) + gamma_bound(6 * (order_ + 2)) * sizes.value
                          + moved(w.near.rounding + std::fabs(step) * w.line.direction_rounding)
                          + gamma_bound(2) * glm::dot(sizes.slope, place);
      error = std::min(error, root_motion(left, root.slope, root.bend));
    }
    Crossing c;
    c.t = t;
    c.error = w.unit * error + gamma_bound(2) * (std::fabs(t) + std::fabs(step));
    c.slack = w.unit * root_motion(moved(w.line.slack), root.slope, root.bend);
    c.entering = !root.rising;
    out.push_back(c);
  }
  if (start != nullptr) impose_start(*start, false, first, out);
}

template <bool Sizes>
PolynomialSurface::Local PolynomialSurface::local(Vec3 const& p) const {
  // Horner's scheme with the derivatives carried along.
  double x = 0, x_x = 0, x_y = 0, x_z = 0;
  std::size_t next = 0;
  for (int a = order_; a >= 0; --a) {
    double y = 0, y_y = 0, y_z = 0;
    for (int b = order_ - a; b >= 0; --b) {
      double z = 0, z_z = 0;
      for (int c = order_ - a - b; c >= 0; --c) {
        double const k = coefficients_[next++];
        z_z = z_z * p.z + z;
        z = z * p.z + (Sizes ? std::fabs(k) : k);
      }
      y_y = y_y * p.y + y;
      y_z = y_z * p.y + z_z;
      y = y * p.y + z;
    }
    x_x = x_x * p.x + x;
    x_y = x_y * p.x + y_y;
    x_z = x_z * p.x + y_z;
    x = x * p.x + y;
  }
  return {x, {x_x, x_y, x_z}};
}

Vec3 PolynomialSurface::normal(Vec3 const& point, std::uint32_t) const {
  Vec3 const slope = local<false>(point).slope;
  if (slope == Vec3(0) || !finite(slope)) return {0, 1, 0}; // a singular point has none
  return unit_vector(slope);
}

Bounds PolynomialSurface::bounds() const {
  Bounds all;
  all.infinite = true;
  return all;
}

std::optional<PlacedShape> make_polynomial(int order, std::vector<double> k) {
  if (order < 2 || order > largest_degree || k.size() != coefficient_count(order))
    return std::nullopt;
  bool const all_finite =
      std::all_of(k.begin(), k.end(), [](double c) { return std::isfinite(c); });
  bool const varies = std::any_of(k.begin(), k.end() - 1, [](double c) { return c != 0; });
  if (!all_finite || !varies) return std::nullopt;
  return PlacedShape{std::make_shared<PolynomialSurface>(order, std::move(k)), {}};
}

namespace {

std::optional<PlacedShape> of_coefficients(Parameters& parameters, int order,
                                           std::vector<double> k) {
  if (std::all_of(k.begin(), k.end() - 1, [](double c) { return c == 0; }))
    return left_out(parameters, "E0617", "a polynomial of a constant alone is not drawn");
  return or_report(make_polynomial(order, std::move(k)), parameters, "E0617",
                   "a polynomial surface needs finite coefficients");
}

std::optional<PlacedShape> read_coefficients(Parameters& parameters, int order) {
  std::vector<double> k =
      parameters.components("coefficients", static_cast<int>(coefficient_count(order)));
  (void)parameters.flag("sturm");
  return of_coefficients(parameters, order, std::move(k));
}

/// Place of x^i y^j z^k among the coefficients: by falling powers of x, then y, then z.
std::size_t place_of(int order, int i, int j, int k) {
  // Those of a higher power of x, then of y.
  int const rest = order - i, left = rest - j;
  auto const pairs = [](int n) { return n * (n + 1) / 2; };
  int const by_x = rest * (rest + 1) * (rest + 2) / 6;
  return static_cast<std::size_t>(by_x + pairs(left) + (left - k));
}

} // namespace

std::optional<PlacedShape> read_poly(Parameters& parameters) {
  return read_coefficients(parameters, parameters.integer("order", 2, largest_degree));
}
std::optional<PlacedShape> read_polynomial(Parameters& parameters) {
  int const order = parameters.integer("order", 2, largest_degree);
  std::vector<double> k(coefficient_count(order));
  for (;;) {
    Span const at = parameters.next_span();
    auto const powers = parameters.call("xyz", 3);
    if (powers.empty()) break;
    double const value = parameters.number("coefficient");
    bool const whole = std::all_of(powers.begin(), powers.end(), [&](double power) {
      return power >= 0 && power <= order && power == std::floor(power);
    });
    if (!whole || powers[0] + powers[1] + powers[2] > order) {
      parameters.report(
          Severity::Error, "E0617",
          "the powers of xyz() must be whole numbers that add up to the order at most", at);
      return std::nullopt;
    }
    k[place_of(order, static_cast<int>(powers[0]), static_cast<int>(powers[1]),
               static_cast<int>(powers[2]))] = value;
  }
  (void)parameters.flag("sturm");
  return of_coefficients(parameters, order, std::move(k));
}
std::optional<PlacedShape> read_cubic(Parameters& parameters) {
  return read_coefficients(parameters, 3);
}
std::optional<PlacedShape> read_quartic(Parameters& parameters) {
  return read_coefficients(parameters, 4);
}

} // namespace abbe::geometry
