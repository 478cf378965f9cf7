// SPDX-License-Identifier: MIT
#include "geometry/shapes/sor.hpp"

#include "geometry/shapes/close_line.hpp"
#include "geometry/shapes/reading.hpp"
#include "geometry/shapes/start.hpp"
#include "simd/math.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::geometry {

namespace {

/// Largest value of a cubic on [0, 1]: its largest Bernstein coefficient, which is not less.
double largest_of(std::array<double, 4> const& c) {
  double const b1 = c[0] + c[1] / 3, b2 = c[0] + (2 * c[1] + c[2]) / 3;
  return std::max(std::max(c[0], b1), std::max(b2, c[0] + c[1] + c[2] + c[3]));
}

} // namespace

Sor::Sor(std::vector<Piece> pieces, bool open) : pieces_(std::move(pieces)), open_(open) {
  double square = 0;
  for (Piece const& piece : pieces_) {
    square = std::max(square,
                      std::max(largest_of(piece.c), std::max(piece.low_square, piece.high_square)));
  }
  radius_ = std::sqrt(square) * (1 + gamma_bound(16));
  double const height = std::max(std::fabs(pieces_.front().low), std::fabs(pieces_.back().high));
  ball_ = simd::hypot(radius_, height) * (1 + gamma_bound(8));
}

/// One line on its way through the pieces.
struct Sor::Walk {
  CloseLine close;
  Crossings& out;

  /// Is the place where the line is at a height inside of a radius? -1 inside, 1 outside.
  int side(double step, double square) const {
    auto const decide = [&]<class N>(N) {
      auto const p = close.place<N>(step);
      N const x2 = p[0] * p[0], z2 = p[2] * p[2];
      double const size = std::fabs(rounded(p[0])) + std::fabs(rounded(p[2]));
      double const error =
          2 * size * close.place_error<N>(step) + 6 * roundoff<N> * (size * size + square);
      return sign_of(x2 + z2 - N(square), error);
    };
    int const first = decide(double{});
    return first != 0 ? first : decide(Twofold{});
  }

  /// Along step = from + width s.
  template <class N>
  Terms<N, 3> along(Piece const& piece, double from, double width) const {
    auto const p = close.place<N>(from);
    double const off = close.place_error<N>(from);
    auto const linear = [&](std::size_t i) {
      Terms<N, 1> f;
      f.c = {p[i], N(width) * N(close.direction[static_cast<int>(i)])};
      f.error = off + roundoff<N> * std::fabs(rounded(f.c[1]));
      return f;
    };
    Terms<N, 1> const x = linear(0), z = linear(2);
    Terms<N, 1> v = linear(1);
    v.c[0] = v.c[0] - N(piece.low);
    v.error += 2 * roundoff<N> * (std::fabs(rounded(p[1])) + std::fabs(piece.low));
    v = times(N(piece.inverse), v);
    auto const with = [&](auto const& f, std::size_t i) {
      return sum_of(product(f, v), constant(N(piece.c[i])));
    };
    auto const square = with(with(with(constant(N(piece.c[3])), 2), 1), 0);
    return sum_of(sum_of(product(x, x), product(z, z)), -square);
  }
};

bool Sor::piece_crossings(Walk& walk, std::size_t k, bool all) const {
  Piece const& piece = pieces_[k];
  CloseLine const& close = walk.close;
  double const y = close.point.y, speed = close.direction.y;
  bool const up = speed > 0;
  double from = -close.half, to = close.half;
  int first = 1, last = 1;
  if (speed == 0) {
    if (!(piece.low <= y && y < piece.high)) return false;
  } else {
    double const enter = ((up ? piece.low : piece.high) - y) / speed;
    double const leave = ((up ? piece.high : piece.low) - y) / speed;
    if (!all && close.near.t + leave < -close.margin()) return false;
    if (enter > from) {
      from = enter;
      first = walk.side(enter, up ? piece.low_square : piece.high_square);
    }
    if (leave < to) {
      to = leave;
      last = walk.side(leave, up ? piece.high_square : piece.low_square);
    }
  }
  double const width = to - from;
  if (!(width > 0)) return false;
  PolynomialRoots roots;
  Wanted const wanted = all ? Wanted() : close.ahead(from, width);
  if (!unit_roots(walk.along<double>(piece, from, width), first, last, roots, wanted))
    unit_roots(walk.along<Twofold>(piece, from, width), first, last, roots);
  bool done = false;
  for (PolynomialRoot const& root : roots) {
    Vec3 const at = close.at(from + width * root.at);
    walk.out.push_back(
        close.crossing(from, width, root, gradient(at, piece), static_cast<std::uint32_t>(k + 2)));
    done = done || (!all && close.is_first_before(walk.out.back(), to));
  }
  return done;
}

void Sor::find(Ray const& ray, bool all, Crossings& out) const {
  Walk walk{CloseLine(ray, ball_), out};
  CloseLine const& close = walk.close;
  if (!(close.half > 0)) return;
  bool const up = close.direction.y > 0;
  std::size_t const n = pieces_.size();
  auto const lid = [&](bool high, bool entering) {
    if (close.direction.y == 0) return;
    double const height = high ? pieces_.back().high : pieces_.front().low;
    double const step = (height - close.point.y) / close.direction.y;
    if (!(std::fabs(step) < close.half)) return;
    double const square = high ? pieces_.back().high_square : pieces_.front().low_square;
    if (walk.side(step, square) > 0) return;
    Crossing c = close.lid(1, height, high ? 1 : 0);
    c.entering = entering;
    c.visible = !open_;
    out.push_back(c);
  };
  lid(!up, true);
  for (std::size_t i = 0; i < n; ++i)
    if (piece_crossings(walk, up ? i : n - 1 - i, all)) return;
  lid(up, false);
}

void Sor::crossings(Ray const& ray, Start const* start, Crossings& out) const {
  std::size_t const first = out.size();
  find(ray, true, out);
  if (start != nullptr) impose_start(*start, false, first, out);
}

void Sor::crossings_ahead(Ray const& ray, Start const* start, double, Crossings& out) const {
  if (start != nullptr) return crossings(ray, start, out);
  find(ray, false, out);
}

bool Sor::inside(Vec3 const& point) const {
  for (Piece const& piece : pieces_) {
    if (!(piece.low <= point.y && point.y <= piece.high)) continue;
    double const v = (point.y - piece.low) * piece.inverse;
    double const square = ((piece.c[3] * v + piece.c[2]) * v + piece.c[1]) * v + piece.c[0];
    return point.x * point.x + point.z * point.z < square;
  }
  return false;
}

Vec3 Sor::gradient(Vec3 const& point, Piece const& piece) const {
  double const v = (point.y - piece.low) * piece.inverse;
  double const slope = (3 * piece.c[3] * v + 2 * piece.c[2]) * v + piece.c[1];
  return {2 * point.x, -slope * piece.inverse, 2 * point.z};
}

Vec3 Sor::normal(Vec3 const& point, std::uint32_t face) const {
  if (face < 2) return {0, face == 0 ? -1 : 1, 0};
  Vec3 const slope = gradient(point, pieces_[face - 2]);
  return slope == Vec3(0) ? Vec3(0, 1, 0) : unit_vector(slope);
}

Bounds Sor::bounds() const {
  return {
      {-radius_, pieces_.front().low, -radius_}, {radius_, pieces_.back().high, radius_}, false};
}

std::optional<Vec2> Sor::uv(Vec3 const& point, std::uint32_t) const {
  double const low = pieces_.front().low, high = pieces_.back().high;
  double const turn = simd::atan2(point.z, point.x) / 6.283185307179586476925286766559;
  return Vec2(turn < 0 ? turn + 1 : turn, (point.y - low) / (high - low));
}

std::optional<PlacedShape> make_sor(std::vector<Vec2> points, bool open) {
  std::size_t const n = points.size();
  if (n < 4) return std::nullopt;
  double largest = 0;
  for (Vec2 const& p : points) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || p.x < 0) return std::nullopt;
  }
  for (std::size_t i = 1; i + 2 < n; ++i) {
    if (!(points[i].y < points[i + 1].y)) return std::nullopt;
  }
  if (points[0].y == points[2].y || points[n - 1].y == points[n - 3].y) return std::nullopt;
  double const middle = points[1].y * 0.5 + points[n - 2].y * 0.5;
  for (std::size_t i = 1; i + 1 < n; ++i) {
    largest = std::max(largest, std::max(points[i].x, std::fabs(points[i].y - middle)));
  }
  if (!usable_size(largest)) return std::nullopt;
  double const unit = std::exp2(std::ilogb(largest));
  for (Vec2& p : points) p = Vec2(p.x / unit, (p.y - middle) / unit);

  auto const slope = [&](std::size_t i) {
    Vec2 const chord = points[i + 1] - points[i - 1];
    return 2 * points[i].x * (chord.x / chord.y);
  };
  std::vector<Sor::Piece> pieces;
  for (std::size_t i = 1; i + 2 < n; ++i) {
    Sor::Piece piece;
    piece.low = points[i].y;
    piece.high = points[i + 1].y;
    double const tall = piece.high - piece.low;
    piece.inverse = 1 / tall;
    piece.low_square = points[i].x * points[i].x;
    piece.high_square = points[i + 1].x * points[i + 1].x;
    double const rise = piece.high_square - piece.low_square;
    double const a = slope(i) * tall, b = slope(i + 1) * tall;
    piece.c = {piece.low_square, a, 3 * rise - 2 * a - b, a + b - 2 * rise};
    if (!std::isfinite(piece.inverse) || !std::isfinite(piece.c[2] + piece.c[3]))
      return std::nullopt;
    pieces.push_back(piece);
  }
  Transform const placement =
      Transform::scaling(Vec3(unit)).then(Transform::translation({0, middle, 0}));
  return PlacedShape{std::make_shared<Sor>(std::move(pieces), open), placement};
}

std::optional<PlacedShape> read_sor(Parameters& parameters) {
  auto points = read_points(parameters, 4);
  if (!points) return std::nullopt;
  bool open = false;
  for (;;) {
    if (auto const flag = parameters.flag("open")) {
      open = *flag;
    } else if (!parameters.flag("sturm")) {
      break;
    }
  }
  return or_report(make_sor(std::move(*points), open), parameters, "E0618",
                   "a sor needs radii that are not negative, not all zero, and ascending heights");
}

} // namespace abbe::geometry
