// SPDX-License-Identifier: MIT
#include "exact_line.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::geometry::exact {

namespace {

std::int64_t square_of(std::int64_t x) {
  return x * x;
}

/// a t^2 + 2 b t + c of a constraint along the line, times unit^2; a == 0: 2 b t + c.
struct Polynomial {
  Integer a, b, c, discriminant;
  std::size_t body = 0, constraint = 0;
  double size = 0; ///< of its gradient times the direction's largest component, about
};

/// One root of a polynomial.
struct Root {
  double t = 0, error = 0;
  Polynomial const* of = nullptr;
};

Polynomial along(Constraint const& k, IntegerLine const& line) {
  Polynomial p;
  Integer const unit = IntegerLine::unit;
  for (std::size_t i = 0; i < 3; ++i) {
    Integer const o = line.origin[i], d = line.direction[i], s = k.square[i], l = k.linear[i];
    p.a += s * d * d;
    p.b += 2 * s * o * d + l * d * unit;
    p.c += s * o * o + l * o * unit;
  }
  p.c += Integer(k.constant) * unit * unit;
  // 2 b, kept even for quadrics and as it is for planes.
  p.a *= 2;
  p.c *= 2;
  p.discriminant = p.b * p.b - p.a * p.c;
  return p;
}

double number(Integer const& x) {
  return static_cast<double>(x);
}

/// Appends the roots; `off`: what the value of the polynomial may be off by.
/// @return false when a little rounding makes roots of none, or none of two
bool solve(Polynomial const& p, double off, std::vector<Root>& out) {
  if (p.a == 0) {
    if (p.b == 0) return std::fabs(number(p.c)) > off;
    out.push_back({number(-p.c) / (2 * number(p.b)), off / (2 * std::fabs(number(p.b))), &p});
    return true;
  }
  double const a = number(p.a), b = number(p.b), c = number(p.c);
  double const disc = number(p.discriminant);
  if (std::fabs(disc) <= 2 * std::fabs(a) * off) return false;
  if (p.discriminant < 0) return true;
  double const root = std::sqrt(disc);
  double const q = -(b + (b < 0 ? -root : root));
  double const error = off / root;
  // b is exact: no cancellation in q, and the other root is c / q.
  out.push_back({q / a, error, &p});
  out.push_back({q == 0 ? q / a : c / q, error, &p});
  return true;
}

/// Is the root of `x` exactly a root of `y` as well?
bool equal(Root const& x, Root const& y) {
  Polynomial const &p = *x.of, &q = *y.of;
  if (p.a * q.b == q.a * p.b && p.a * q.c == q.a * p.c && p.b * q.c == q.b * p.c) return true;
  // A linear one's root is rational: put it into the other.
  Polynomial const& line = p.a == 0 ? p : q;
  Polynomial const& other = p.a == 0 ? q : p;
  if (line.a != 0) return false; // two different quadrics: told apart, or in doubt
  Integer const top = -line.c, bottom = 2 * line.b;
  return other.a * top * top + 2 * other.b * top * bottom + other.c * bottom * bottom == 0;
}

bool value(CsgTree const& tree, std::vector<int> const& broken) {
  bool result = false;
  if (tree.op == CsgTree::Op::Primitive) {
    result = broken[tree.primitive] == 0;
  } else {
    result = tree.op != CsgTree::Op::Merge;
    for (std::size_t i = 0; i < tree.children.size(); ++i) {
      bool const in = value(tree.children[i], broken);
      if (tree.op == CsgTree::Op::Merge) result = result || in;
      if (tree.op == CsgTree::Op::Intersection) result = result && in;
      if (tree.op == CsgTree::Op::Difference) result = result && (i == 0 ? in : !in);
    }
  }
  return result != tree.inverse;
}

/// Is the constraint broken at t = -infinity?
bool broken_far_behind(Polynomial const& p) {
  if (p.a != 0) return p.a > 0;
  if (p.b != 0) return p.b < 0;
  return p.c > 0;
}

Constraint plane(int axis, std::int64_t sign, std::int64_t at) {
  Constraint k;
  k.linear[static_cast<std::size_t>(axis)] = sign;
  k.constant = -sign * at;
  return k;
}

} // namespace

Body box(Point const& low, Point const& high) {
  Body body;
  for (int i = 0; i < 3; ++i) {
    body.constraints.push_back(plane(i, -1, low[static_cast<std::size_t>(i)]));
    body.constraints.push_back(plane(i, 1, high[static_cast<std::size_t>(i)]));
  }
  return body;
}

Body half_space(Point const& normal, std::int64_t level) {
  return {{Constraint{{}, normal, -level}}};
}

Body sphere(Point const& centre, std::int64_t radius) {
  Constraint k;
  for (std::size_t i = 0; i < 3; ++i) {
    k.square[i] = 1;
    k.linear[i] = -2 * centre[i];
    k.constant += square_of(centre[i]);
  }
  k.constant -= square_of(radius);
  return {{k}};
}

Body cylinder(int axis, Point const& middle, std::int64_t low, std::int64_t high,
              std::int64_t radius) {
  return cone(axis, middle, low, radius, high, radius);
}

Body cone(int axis, Point const& middle, std::int64_t low, std::int64_t low_radius,
          std::int64_t high, std::int64_t high_radius) {
  // h^2 |p - middle|^2 across <= (r0 h + (y - low)(r1 - r0))^2, h = high - low.
  std::int64_t const h = high - low, rate = high_radius - low_radius;
  Constraint k;
  for (std::size_t i = 0; i < 3; ++i) {
    if (static_cast<int>(i) == axis) continue;
    k.square[i] = h * h;
    k.linear[i] = -2 * h * h * middle[i];
    k.constant += h * h * square_of(middle[i]);
  }
  std::int64_t const at_zero = low_radius * h - low * rate;
  auto const y = static_cast<std::size_t>(axis);
  k.square[y] = -square_of(rate);
  k.linear[y] = -2 * rate * at_zero;
  k.constant -= square_of(at_zero);
  return {{k, plane(axis, -1, low), plane(axis, 1, high)}};
}

Answer follow(IntegerLine const& line, std::vector<Body> const& bodies, CsgTree const& tree,
              double rounding) {
  Answer answer;
  std::vector<Polynomial> polynomials;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (Constraint const& k : bodies[i].constraints) {
      polynomials.push_back(along(k, line));
      polynomials.back().body = i;
      // How steep the constraint is within the lattice's reach of 32.
      for (std::size_t j = 0; j < 3; ++j) {
        polynomials.back().size += std::fabs(2 * 32.0 * static_cast<double>(k.square[j]))
                                   + std::fabs(static_cast<double>(k.linear[j]));
      }
    }
  }
  constexpr double unit = static_cast<double>(IntegerLine::unit);
  std::vector<Root> roots;
  std::vector<int> broken(bodies.size(), 0);
  for (Polynomial const& p : polynomials) {
    broken[p.body] += broken_far_behind(p) ? 1 : 0;
    if (!solve(p, 2 * p.size * rounding * unit * unit, roots)) answer.doubtful = true;
  }
  std::sort(roots.begin(), roots.end(), [](Root const& a, Root const& b) { return a.t < b.t; });
  std::vector<bool> is_broken(polynomials.size());
  for (std::size_t i = 0; i < polynomials.size(); ++i) {
    is_broken[i] = broken_far_behind(polynomials[i]);
  }
  bool inside = value(tree, broken);
  bool started = false;
  for (std::size_t i = 0; i < roots.size();) {
    if (!started && roots[i].t > 0) {
      answer.inside_at_start = inside;
      started = true;
    }
    if (std::fabs(roots[i].t) <= roots[i].error) answer.doubtful = true;
    std::size_t last = i;
    for (; last < roots.size(); ++last) {
      double const apart = roots[last].t - roots[i].t;
      if (apart > roots[last].error + roots[i].error) break;
      if (last > i && !equal(roots[i], roots[last])) {
        answer.doubtful = true;
        break;
      }
      auto const number = static_cast<std::size_t>(roots[last].of - polynomials.data());
      is_broken[number] = !is_broken[number];
      broken[roots[last].of->body] += is_broken[number] ? 1 : -1;
      answer.coincident += last > i && roots[last].of->body != roots[i].of->body ? 1 : 0;
    }
    bool const now = value(tree, broken);
    if (now != inside && roots[i].t > 0) answer.changes.push_back({roots[i].t, now});
    inside = now;
    i = last;
    if (answer.doubtful) return answer;
  }
  if (!started) answer.inside_at_start = inside;
  return answer;
}

} // namespace abbe::geometry::exact
