// SPDX-License-Identifier: MIT
#include "geometry/shapes/sphere_sweep.hpp"

#include "geometry/shapes/close_line.hpp"
#include "geometry/shapes/reading.hpp"
#include "geometry/shapes/start.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::geometry {

namespace {

using Piece = SphereSweep::Piece;

/// The part of the line within the balls of a stretch of u.
struct Cover {
  Crossing in, out;
};

Vec3 centre_at(Piece const& piece, double u) {
  return {piece.at(0, u), piece.at(1, u), piece.at(2, u)};
}

} // namespace

/// A line beside the pieces, its direction scaled by a power of two to about 1.
struct SphereSweep::Walk {
  CloseLine close;
  double unit;
  Vec3 d;
  std::vector<Cover> covers{};

  Walk(Ray const& ray, double ball) : close(ray, ball) {
    unit = std::exp2(-std::ilogb(vector_length(ray.direction)));
    d = ray.direction * unit;
  }

  /// Centre less the line's point, along a piece whose coordinates are of a degree.
  template <class N, int Degree>
  std::array<Terms<N, Degree>, 3> from_line(Piece const& piece) const {
    std::array<Terms<N, Degree>, 3> result;
    auto const p = close.place<N>(0.0);
    double const off = close.place_error<N>(0.0);
    for (std::size_t k = 0; k < 3; ++k)
      result[k] = sum_of(piece.terms<N, Degree>(k), constant(-p[k], off));
    return result;
  }
  /// |d|^2 r^2 - |d x (centre - point)|^2: positive where the ball meets the line.
  template <class N, int Degree>
  Terms<N, 2 * Degree> meeting(Piece const& piece) const {
    auto const from = from_line<N, Degree>(piece);
    auto const radius = piece.terms<N, Degree>(3);
    N const x(d.x), y(d.y), z(d.z);
    auto const across = [&](std::size_t i, std::size_t j, N const& di, N const& dj) {
      auto const f = sum_of(times(di, from[j]), -times(dj, from[i]));
      return product(f, f);
    };
    auto const miss = sum_of(sum_of(across(1, 2, y, z), across(2, 0, z, x)), across(0, 1, x, y));
    return sum_of(times(x * x + y * y + z * z, product(radius, radius)), -miss);
  }
  /// Zero where dt/du is: a C'^2 - 4 b b' C' + 4 b'^2 C, of a t^2 - 2 b t + C = 0.
  template <class N, int Degree>
  auto turning(Piece const& piece) const {
    auto const from = from_line<N, Degree>(piece);
    auto const radius = piece.terms<N, Degree>(3);
    N const dir[3] = {N(d.x), N(d.y), N(d.z)};
    auto b = times(dir[0], from[0]);
    auto c = product(from[0], from[0]);
    for (std::size_t k = 1; k < 3; ++k) {
      b = sum_of(b, times(dir[k], from[k]));
      c = sum_of(c, product(from[k], from[k]));
    }
    c = sum_of(c, -product(radius, radius));
    N const a = dir[0] * dir[0] + dir[1] * dir[1] + dir[2] * dir[2];
    auto const b1 = derivative_of(b);
    auto const c1 = derivative_of(c);
    auto const first = product(c1, sum_of(times(a, c1), -times(N(4.0), product(b, b1))));
    return sum_of(first, times(N(4.0), product(product(b1, b1), c)));
  }

  /// Where the line enters and leaves the ball of u; false when it misses it.
  bool ball(Piece const& piece, double u, std::uint32_t face, Crossing& in, Crossing& out) const;
  void stretch(Piece const& piece, PolynomialRoots const& turns, double low, double high,
               std::uint32_t face);
  void add_piece(Piece const& piece, std::uint32_t face);
  template <int Degree>
  void add_piece_of(Piece const& piece, std::uint32_t face);
};

bool SphereSweep::Walk::ball(Piece const& piece, double u, std::uint32_t face, Crossing& in,
                             Crossing& out) const {
  bool const ends = u == 0 || u == 1;
  auto const& end = u == 0 ? piece.begin : piece.end;
  Vec3 const centre = ends ? Vec3(end[0], end[1], end[2]) : centre_at(piece, u);
  double const radius = std::fabs(ends ? end[3] : piece.at(3, u));
  Vec3 const from = close.point - centre;
  double const a = glm::dot(d, d), middle = -glm::dot(from, d) / a;
  Vec3 const at = from + middle * d;
  double const distance = vector_length(at);
  double const room = (radius - distance) * (radius + distance);
  if (!(room > 0)) return false;
  double const root = std::sqrt(room * a), half = root / a;
  double const off = close.place_error<double>(0)
                     + gamma_bound(16)
                           * (lane::sum(lane::abs(close.near.point)) + radius + std::fabs(centre.x)
                              + std::fabs(centre.y) + std::fabs(centre.z));
  auto const make = [&](double step, bool entering) {
    Crossing c;
    c.t = close.near.t + step * unit;
    Vec3 const moved = close.moved(c.t), slack = close.slack();
    c.error = unit * root_motion((moved.x + moved.y + moved.z + off) * radius, root, a)
              + gamma_bound(4) * (std::fabs(c.t) + std::fabs(step) * unit);
    c.slack = unit * root_motion((slack.x + slack.y + slack.z) * radius, root, a);
    c.face = face;
    c.entering = entering;
    return c;
  };
  in = make(middle - half, true);
  out = make(middle + half, false);
  return true;
}

void SphereSweep::Walk::stretch(Piece const& piece, PolynomialRoots const& turns, double low,
                                double high, std::uint32_t face) {
  Cover cover;
  bool any = false;
  auto const take = [&](double u) {
    Crossing in, out;
    if (!ball(piece, u, face, in, out)) return;
    if (!any || in.t < cover.in.t) cover.in = in;
    if (!any || out.t > cover.out.t) cover.out = out;
    any = true;
  };
  take(low);
  take(high);
  take(0.5 * (low + high));
  for (PolynomialRoot const& root : turns) {
    if (low < root.at && root.at < high) take(root.at);
  }
  if (any) covers.push_back(cover);
}

void SphereSweep::Walk::add_piece(Piece const& piece, std::uint32_t face) {
  piece.with_degree([&](auto degree) { add_piece_of<degree()>(piece, face); });
}

template <int Degree>
void SphereSweep::Walk::add_piece_of(Piece const& piece, std::uint32_t face) {
  PolynomialRoots ends;
  Polynomial<double> const f = meeting<double, Degree>(piece);
  int first = sign_of(f.c[0], f.error);
  int const last = sign_of(f.at_one(), 2 * f.error);
  if (!unit_roots(f, first, last, ends)) {
    Polynomial<Twofold> const g = meeting<Twofold, Degree>(piece);
    first = sign_of(g.c[0], 0);
    unit_roots(g, first, sign_of(g.at_one(), 0), ends);
  }
  if (ends.count == 0 && first < 0) return;
  PolynomialRoots turns;
  unit_roots_of([&]<class N>(N) { return turning<N, Degree>(piece); }, turns);
  // Across the curve, the turning points in and out are one: a double root, beside the largest
  // ball.
  unit_roots_of([&]<class N>(N) { return derivative_of(meeting<N, Degree>(piece)); }, turns);
  double from = 0;
  bool inside = first > 0;
  for (PolynomialRoot const& end : ends) {
    if (inside) stretch(piece, turns, from, end.at, face);
    from = end.at;
    inside = !inside;
  }
  if (inside) stretch(piece, turns, from, 1, face);
}

SphereSweep::SphereSweep(std::vector<Piece> pieces) : pieces_(std::move(pieces)) {
  Vec3 low(infinity), high(-infinity);
  for (Piece const& piece : pieces_) {
    auto const radii = piece.corners(3);
    double radius = 0;
    for (double const r : radii) radius = std::max(radius, std::fabs(r));
    Vec3 least(infinity), most(-infinity);
    for (std::size_t k = 0; k < 3; ++k) {
      auto const places = piece.corners(k);
      for (std::size_t i = 0; i < 4; ++i) {
        auto const axis = static_cast<int>(k);
        // Each corner's own ball: radius and centre are the same mean of the corners'.
        double const r = std::fabs(radii[i]);
        least[axis] = std::min(least[axis], places[i] - r);
        most[axis] = std::max(most[axis], places[i] + r);
      }
    }
    Vec3 const wide = gamma_bound(32) * (glm::abs(least) + glm::abs(most));
    least -= wide;
    most += wide;
    low = glm::min(low, least);
    high = glm::max(high, most);
    Vec3 const centre = 0.5 * (least + most);
    balls_.push_back({centre, vector_length(most - centre) * (1 + gamma_bound(16))});
  }
  bounds_ = {low, high, false};
  ball_ = vector_length(glm::max(glm::abs(low), glm::abs(high)));
}

void SphereSweep::crossings(Ray const& ray, Start const* start, Crossings& out) const {
  Walk walk(ray, ball_);
  std::size_t const first = out.size();
  if (walk.close.half > 0) {
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      Ball const& ball = balls_[k];
      Vec3 const away = ball.centre - walk.close.point;
      double const along = glm::dot(away, walk.d), a = glm::dot(walk.d, walk.d);
      double const miss2 = glm::dot(away, away) - along * along / a;
      if (miss2 > ball.radius * ball.radius + gamma_bound(64) * ball_ * ball_) continue;
      walk.add_piece(pieces_[k], static_cast<std::uint32_t>(k));
    }
  }
  auto& covers = walk.covers;
  std::sort(covers.begin(), covers.end(), [](Cover const& a, Cover const& b) {
    return a.in.t != b.in.t ? a.in.t < b.in.t : a.in.face < b.in.face;
  });
  for (std::size_t i = 0; i < covers.size();) {
    Cover cover = covers[i++];
    while (i < covers.size() && covers[i].in.t <= cover.out.t) {
      if (covers[i].out.t > cover.out.t) cover.out = covers[i].out;
      ++i;
    }
    out.push_back(cover.in);
    out.push_back(cover.out);
  }
  if (start != nullptr) impose_start(*start, false, first, out);
}

double SphereSweep::deepest(Piece const& piece, Vec3 const& point, double& depth) {
  double at = 0;
  depth = infinity;
  auto const take = [&](double u) {
    Vec3 const from = point - centre_at(piece, u);
    double const r = std::fabs(piece.at(3, u)), distance = vector_length(from);
    double const d = (distance - r) * (distance + r);
    if (!(d < depth)) return;
    depth = d;
    at = u;
  };
  take(0);
  take(1);
  PolynomialRoots roots;
  piece.with_degree([&](auto degree) {
    unit_roots_of(
        [&]<class N>(N) {
          auto const r = piece.terms<N, degree()>(3);
          auto sum = -product(r, derivative_of(r));
          for (std::size_t k = 0; k < 3; ++k) {
            auto const c = piece.terms<N, degree()>(k);
            N const place(-point[static_cast<int>(k)]);
            sum = sum_of(sum, product(sum_of(c, constant(place)), derivative_of(c)));
          }
          return sum;
        },
        roots);
  });
  for (PolynomialRoot const& root : roots) take(root.at);
  return at;
}

bool SphereSweep::inside(Vec3 const& point) const {
  for (Piece const& piece : pieces_) {
    double depth = 0;
    deepest(piece, point, depth);
    if (depth <= 0) return true;
  }
  return false;
}

Vec3 SphereSweep::normal(Vec3 const& point, std::uint32_t face) const {
  double depth = 0;
  double const u = deepest(pieces_[face], point, depth);
  Vec3 const out = point - centre_at(pieces_[face], u);
  return out == Vec3(0) ? Vec3(0, 1, 0) : unit_vector(out);
}

std::optional<PlacedShape> make_sphere_sweep(SplineKind kind,
                                             std::vector<std::array<double, 4>> points) {
  Vec3 low(infinity), high(-infinity);
  double largest = 0;
  for (auto const& p : points) {
    Vec3 const place(p[0], p[1], p[2]);
    if (!finite(place) || !std::isfinite(p[3])) return std::nullopt;
    low = glm::min(low, place);
    high = glm::max(high, place);
    largest = std::max(largest, std::fabs(p[3]));
  }
  if (points.empty() || largest == 0) return std::nullopt;
  Vec3 const middle = low * 0.5 + high * 0.5, half = high - middle;
  largest = std::max(largest, std::max(half.x, std::max(half.y, half.z)));
  if (!usable_size(largest)) return std::nullopt;
  double const unit = std::exp2(std::ilogb(largest));
  for (auto& p : points) {
    for (std::size_t k = 0; k < 3; ++k) p[k] = (p[k] - middle[static_cast<int>(k)]) / unit;
    p[3] /= unit;
  }
  auto pieces = spline_pieces<4>(kind, points);
  if (pieces.empty()) return std::nullopt;
  Transform const placement = Transform::scaling(Vec3(unit)).then(Transform::translation(middle));
  return PlacedShape{std::make_shared<SphereSweep>(std::move(pieces)), placement};
}

std::optional<PlacedShape> read_sphere_sweep(Parameters& parameters) {
  static constexpr SplineWord words[] = {{"linear_spline", SplineKind::Linear, 2},
                                         {"cubic_spline", SplineKind::Cubic, 4},
                                         {"b_spline", SplineKind::BSpline, 4}};
  SplineWord const* const named = accept_spline(parameters, words);
  if (named == nullptr)
    parameters.report(Severity::Error, "E0625",
                      "a sphere_sweep begins with linear_spline, cubic_spline or b_spline",
                      parameters.next_span());
  auto const [word, kind, least] = named != nullptr ? *named : words[0];
  int const count = parameters.integer("number of spheres", least, 1 << 24);
  std::vector<std::array<double, 4>> points;
  for (int i = 0; i < count; ++i) {
    if (i > 0 && !parameters.has_value()) {
      parameters.report(Severity::Error, "E0616",
                        "there are fewer spheres than the number of spheres says");
      return std::nullopt;
    }
    Vec3 const p = parameters.vec3("centre");
    points.push_back({p.x, p.y, p.z, parameters.number("radius")});
  }
  if (parameters.accept("tolerance")) (void)parameters.number("tolerance");
  if (std::all_of(points.begin(), points.end(), [](auto const& p) { return p[3] == 0; }))
    return left_out(parameters, "E0626", "a sphere_sweep whose radii are all 0 is not drawn");
  return or_report(make_sphere_sweep(kind, std::move(points)), parameters, "E0626",
                   "a sphere_sweep needs finite centres and radii");
}

} // namespace abbe::geometry
