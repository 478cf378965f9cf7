// SPDX-License-Identifier: MIT
#include "lang/spline.hpp"

#include "lang/interpreter.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace abbe::lang {
namespace {

using Kind = SplineValue::Kind;
using Components = std::array<double, 5>;

std::optional<Kind> accept_kind(Reader& in) {
  if (in.accept("linear_spline")) return Kind::Linear;
  if (in.accept("quadratic_spline")) return Kind::Quadratic;
  if (in.accept("cubic_spline")) return Kind::Cubic;
  if (in.accept("natural_spline")) return Kind::Natural;
  return std::nullopt;
}

/// Second derivatives of one component of the natural spline at all keys: the tridiagonal system.
std::vector<double> curvatures(std::vector<SplineValue::Point> const& p, std::size_t component) {
  std::size_t const n = p.size();
  std::vector<double> second(n, 0), factor(n, 0);
  auto const y = [&](std::size_t i) { return p[i].value.c[component]; };
  for (std::size_t i = 1; i + 1 < n; ++i) {
    double const before = p[i].key - p[i - 1].key;
    double const after = p[i + 1].key - p[i].key;
    double const right = 6 * ((y(i + 1) - y(i)) / after - (y(i) - y(i - 1)) / before);
    double const pivot = 2 * (before + after) - before * factor[i - 1];
    factor[i] = after / pivot;
    second[i] = (right - before * second[i - 1]) / pivot;
  }
  for (std::size_t i = n - 1; i-- > 1;) second[i] -= factor[i] * second[i + 1];
  return second;
}

double natural(std::vector<SplineValue::Point> const& p, std::size_t i, double key,
               std::size_t component) {
  std::vector<double> const second = curvatures(p, component);
  double const h = p[i + 1].key - p[i].key;
  double const a = (p[i + 1].key - key) / h;
  double const b = (key - p[i].key) / h;
  return a * p[i].value.c[component] + b * p[i + 1].value.c[component]
         + ((a * a * a - a) * second[i] + (b * b * b - b) * second[i + 1]) * (h * h) / 6;
}

/// Parabola through three points, Lagrange's form.
double parabola(SplineValue::Point const& p, SplineValue::Point const& q,
                SplineValue::Point const& r, double key, std::size_t c) {
  double const u = key - p.key;
  double const v = key - q.key;
  double const w = key - r.key;
  return p.value.c[c] * (v * w) / ((p.key - q.key) * (p.key - r.key))
         + q.value.c[c] * (u * w) / ((q.key - p.key) * (q.key - r.key))
         + r.value.c[c] * (u * v) / ((r.key - p.key) * (r.key - q.key));
}

/// Cubic Hermite whose slope at a knot is the mean of those of the chords beside it.
double catmull_rom(std::vector<SplineValue::Point> const& p, std::size_t i, double key,
                   std::size_t c) {
  auto const chord = [&](std::size_t k) {
    return (p[k + 1].value.c[c] - p[k].value.c[c]) / (p[k + 1].key - p[k].key);
  };
  double const h = p[i + 1].key - p[i].key;
  double const s = (key - p[i].key) / h;
  double const from = (chord(i - 1) + chord(i)) / 2 * h;
  double const to = (chord(i) + chord(i + 1)) / 2 * h;
  double const s2 = s * s;
  double const s3 = s2 * s;
  return p[i].value.c[c] * (2 * s3 - 3 * s2 + 1) + from * (s3 - 2 * s2 + s)
         + p[i + 1].value.c[c] * (3 * s2 - 2 * s3) + to * (s3 - s2);
}

} // namespace

Numeric SplineValue::at(double key, Kind how) const {
  Numeric n;
  n.size = size;
  if (points.empty()) return n;
  // Cubic pieces need a neighbour on both sides. POV-Ray's splines of fewer points stay in one
  // place.
  if (how == Kind::Cubic && points.size() < 4) {
    Point const& low = points[(points.size() - 1) / 2];
    Point const& high = points[points.size() / 2];
    for (std::size_t c = 0; c < size; ++c) n.c[c] = (low.value.c[c] + high.value.c[c]) / 2;
    return n;
  }
  std::size_t const margin = how == Kind::Cubic ? 1 : 0;
  Point const& first = points[margin];
  Point const& last = points[points.size() - 1 - margin];
  if (!(key > first.key) || points.size() == 1) return n.c = first.value.c, n;
  if (key >= last.key) return n.c = last.value.c, n;
  auto const above = std::upper_bound(points.begin(), points.end(), key,
                                      [](double k, Point const& p) { return k < p.key; });
  auto const i = static_cast<std::size_t>(above - points.begin()) - 1;
  for (std::size_t c = 0; c < size; ++c) {
    double const s = (key - points[i].key) / (points[i + 1].key - points[i].key);
    switch (how) {
    case Kind::Linear:
      n.c[c] = points[i].value.c[c] * (1 - s) + points[i + 1].value.c[c] * s;
      break;
    case Kind::Quadratic:
      if (points.size() < 3)
        n.c[c] = points[i].value.c[c] * (1 - s) + points[i + 1].value.c[c] * s;
      else if (i == 0)
        n.c[c] = parabola(points[0], points[1], points[2], key, c);
      else
        n.c[c] = parabola(points[i - 1], points[i], points[i + 1], key, c);
      break;
    case Kind::Cubic:
      n.c[c] = catmull_rom(points, i, key, c);
      break;
    case Kind::Natural:
      n.c[c] = natural(points, i, key, c);
      break;
    }
  }
  return n;
}

std::shared_ptr<SplineValue> read_spline(Reader& in) {
  auto spline = std::make_shared<SplineValue>();
  if (Value const* const value = in.identifier()) {
    if (auto const* held = std::get_if<std::shared_ptr<SplineValue>>(&value->any)) {
      *spline = **held;
      in.take();
    }
  }
  if (auto const kind = accept_kind(in)) spline->kind = *kind;
  while (!in.at_end()) {
    if (!in.has_value()) {
      in.unexpected("a key and a point of the spline");
      continue;
    }
    double const key = in.number("a key of the spline");
    Numeric const value = in.numeric("a point of the spline");
    spline->size = std::max(spline->size, std::min<std::uint8_t>(value.size, 5));
    auto const place =
        std::lower_bound(spline->points.begin(), spline->points.end(), key,
                         [](SplineValue::Point const& p, double k) { return p.key < k; });
    if (place != spline->points.end() && place->key == key)
      place->value = value;
    else
      spline->points.insert(place, {key, value});
  }
  for (auto& point : spline->points) point.value = point.value.promoted(spline->size);
  if (spline->points.empty()) in.report(Severity::Error, "E0319", "a spline needs a point", {});
  return spline;
}

Numeric call_spline(SplineValue const& spline, ast::Call const& node, Interpreter& in) {
  auto& reader = in.reader;
  Kind kind = spline.kind;
  if (node.arguments.empty() || node.arguments.size() > 2) {
    in.error("E0316", fmt::format("a spline takes 1 to 2 arguments, not {}", node.arguments.size()),
             node.span);
    return poison();
  }
  reader.enter_region(node.arguments[0], node.span);
  double const key = reader.number("the key");
  reader.leave_region();
  if (node.arguments.size() == 2) {
    reader.enter_region(node.arguments[1], node.span);
    if (auto const other = accept_kind(reader))
      kind = *other;
    else
      reader.unexpected("a type of spline");
    reader.leave_region();
  }
  return spline.at(key, kind);
}

} // namespace abbe::lang
