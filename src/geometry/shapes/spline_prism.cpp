// SPDX-License-Identifier: MIT
#include "geometry/shapes/spline_prism.hpp"

#include "geometry/kernels.hpp"
#include "geometry/shapes/reading.hpp"
#include "geometry/shapes/start.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::geometry {

namespace {

double sum_of_products(Vec3 const& a, Vec3 const& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// Places in (0, 1) where a coordinate of a piece has an extreme value.
template <class Take>
void each_extreme(SplinePrism::Piece const& piece, std::size_t k, Take const& take) {
  double const a = 3 * piece.c[3][k], b = piece.c[2][k], c = piece.c[1][k];
  double const root = b * b - a * c;
  if (root < 0) return;
  double const q = -(b + std::copysign(std::sqrt(root), b));
  for (double const u : {q / a, c / q})
    if (u > 0 && u < 1) take(u);
}

} // namespace

SplinePrism::SplinePrism(std::vector<Piece> pieces, Form const& form)
    : pieces_(std::move(pieces)), form_(form) {
  for (Piece const& piece : pieces_) {
    Hull const hull{piece.corners(0), piece.corners(1)};
    for (std::size_t i = 0; i < 4; ++i)
      reach_ = std::max(reach_, std::max(std::fabs(hull.x[i]), std::fabs(hull.z[i])));
    hulls_.push_back(hull);
  }
  find_bounds();
}

void SplinePrism::find_bounds() {
  double low[2] = {infinity, infinity}, high[2] = {-infinity, -infinity};
  for (Piece const& piece : pieces_) {
    for (std::size_t k = 0; k < 2; ++k) {
      auto const take = [&](double value) {
        low[k] = std::min(low[k], value);
        high[k] = std::max(high[k], value);
      };
      take(piece.begin[k]);
      take(piece.end[k]);
      double const wide = gamma_bound(16) * reach_;
      each_extreme(piece, k, [&](double u) {
        take(piece.at(k, u) - wide);
        take(piece.at(k, u) + wide);
      });
    }
  }
  bounds_ = {{low[0], form_.low, low[1]}, {high[0], form_.high, high[1]}, false};
  if (form_.sweep == Sweep::Conic) {
    // The sections at both heights, and the apex between them.
    for (int k = 0; k < 2; ++k) {
      double const ends[] = {low[k] * form_.low, low[k] * form_.high, high[k] * form_.low,
                             high[k] * form_.high};
      bool const apex = form_.low < 0 && form_.high > 0;
      auto const [least, most] = std::minmax_element(std::begin(ends), std::end(ends));
      bounds_.low[2 * k] = apex ? std::min(*least, 0.0) : *least;
      bounds_.high[2 * k] = apex ? std::max(*most, 0.0) : *most;
    }
  }
  ball_ = vector_length(bounds_.high - bounds_.low) / 2 * (1 + gamma_bound(8));
}

/// The line from its closest approach to the axis (or apex), its direction scaled by a power of two
/// to the length of about 1, and the straight line a x + b + c z = 0 that is its trace in the
/// section.
struct SplinePrism::Cut {
  template <class N>
  struct Trace {
    N a, b, c;
    double off_a = 0, off_b = 0, off_c = 0; ///< bounds of their errors
  };
  bool conic;
  Line<double> line;
  double unit = 1; ///< of t
  double from = 0; ///< t of the point
  Vec3 d;          ///< scaled
  Vec3 p{0};       ///< the point, rounded
  double across2;  ///< |d_xz|^2
  bool along;      ///< the whole line is in one place of the section
  Trace<double> doubles;

  Cut(Ray const& ray, Sweep sweep) : conic(sweep == Sweep::Conic), line(line_of(ray)) {
    Vec3 const flat(ray.direction.x, conic ? ray.direction.y : 0, ray.direction.z);
    along = flat == Vec3(0);
    if (along) return;
    unit = std::exp2(-std::ilogb(vector_length(flat)));
    d = ray.direction * unit;
    across2 = d.x * d.x + d.z * d.z;
    double const o_d = ray.origin.x * d.x + ray.origin.z * d.z;
    double const step =
        conic ? -(o_d + ray.origin.y * d.y) / (across2 + d.y * d.y) : -o_d / across2;
    from = step * unit;
    p = ray.origin + step * d;
    doubles = trace<double>();
    if (!conic) return;
    auto const exact = trace<Twofold>();
    auto const zero = [](Twofold const& n) { return n.high == 0 && n.low == 0; };
    along = zero(exact.a) && zero(exact.c);
  }
  template <class N>
  N place(int i) const {
    double const o = i == 0 ? line.origin.x : (i == 1 ? line.origin.y : line.origin.z);
    return N(o) + N(from / unit) * N(d[i]);
  }
  template <class N>
  double place_error() const {
    Vec3 const o = glm::abs(Vec3(line.origin.x, conic ? line.origin.y : 0, line.origin.z));
    Vec3 const run(d.x, conic ? d.y : 0, d.z);
    Vec3 const far = o + std::fabs(from / unit) * glm::abs(run);
    return 4 * roundoff<N> * std::max(far.x, std::max(far.y, far.z));
  }
  template <class N>
  Trace<N> trace() const {
    double const off = place_error<N>(), u = roundoff<N>;
    N const px = place<N>(0), pz = place<N>(2), dx(d.x), dz(d.z);
    auto const size = [](N const& n) { return std::fabs(rounded(n)); };
    auto const error = [&](N const& m, N const& n, double di, double dj) {
      return (std::fabs(di) + std::fabs(dj)) * off
             + 4 * u * (size(m) * std::fabs(dj) + size(n) * std::fabs(di));
    };
    Trace<N> out;
    out.b = pz * dx - px * dz;
    out.off_b = error(px, pz, d.x, d.z);
    if (!conic) {
      out.a = dz;
      out.c = -dx;
      return out;
    }
    N const py = place<N>(1), dy(d.y);
    out.a = py * dz - pz * dy;
    out.c = px * dy - py * dx;
    out.off_a = error(py, pz, d.y, d.z);
    out.off_c = error(px, py, d.x, d.y);
    return out;
  }
  /// On which side of the trace is a place? -1 or 1.
  int side(double x, double z) const {
    auto const decide = [&]<class N>(Trace<N> const& t) {
      N const ax = t.a * N(x), cz = t.c * N(z);
      double const error =
          t.off_a * std::fabs(x) + t.off_b + t.off_c * std::fabs(z)
          + 6
                * roundoff<
                    N> * (std::fabs(rounded(ax)) + std::fabs(rounded(cz)) + std::fabs(rounded(t.b)));
      return sign_of(ax + cz + t.b, error);
    };
    int const first = decide(doubles);
    return first != 0 ? first : decide(trace<Twofold>());
  }
  template <class N, int Degree>
  Terms<N, Degree> along_piece(Piece const& piece) const {
    Trace<N> const t = [&] {
      if constexpr (std::is_same_v<N, double>)
        return doubles;
      else
        return trace<N>();
    }();
    auto const x = piece.terms<N, Degree>(0), z = piece.terms<N, Degree>(1);
    auto f = sum_of(sum_of(times(t.a, x), times(t.c, z)), constant(t.b, t.off_b));
    f.error += t.off_a * x.size() + t.off_c * z.size();
    return f;
  }
  /// Can none of the points be on the other side of the trace from the first?
  bool misses(Hull const& hull, double reach) const {
    Trace<double> const& t = doubles;
    double f[4];
    for (std::size_t i = 0; i < 4; ++i) f[i] = t.a * hull.x[i] + t.c * hull.z[i] + t.b;
    double const error =
        (t.off_a + t.off_c) * reach + t.off_b
        + gamma_bound(16) * ((std::fabs(t.a) + std::fabs(t.c)) * reach + std::fabs(t.b));
    double const low = std::min(std::min(f[0], f[1]), std::min(f[2], f[3]));
    double const high = std::max(std::max(f[0], f[1]), std::max(f[2], f[3]));
    return low > error || high < -error;
  }
  Vec3 moved(double t) const {
    auto const m = line.origin_rounding + std::fabs(t) * line.direction_rounding;
    return Vec3(m.x, m.y, m.z) + Vec3(place_error<double>());
  }
  Vec3 slack() const { return {line.slack.x, line.slack.y, line.slack.z}; }
  /// Between which t the hull is, but for rounding. Of linear sweeps.
  std::pair<double, double> reach_of(Hull const& hull) const {
    double step[4];
    for (std::size_t i = 0; i < 4; ++i) step[i] = (hull.x[i] - p.x) * d.x + (hull.z[i] - p.z) * d.z;
    double const scale = unit / across2;
    double const low = std::min(std::min(step[0], step[1]), std::min(step[2], step[3]));
    double const high = std::max(std::max(step[0], step[1]), std::max(step[2], step[3]));
    return {from + low * scale, from + high * scale};
  }
  /// More than reach_of() is off by, near a part of the line.
  double room(double low, double high, double reach) const {
    auto const size = [](double t) { return std::isfinite(t) ? std::fabs(t) : 0; };
    Vec3 const most = moved(std::max(size(low), size(high)));
    return 0x1p-30 * (size(low) + size(high) + std::fabs(from) + reach * unit / std::sqrt(across2))
           + 4 * unit * (most.x + most.z) / std::sqrt(across2);
  }

  Crossing crossing(Piece const& piece, PolynomialRoot const& root) const {
    double const u = root.at;
    Vec3 const w(piece.at(0, u), conic ? 1 : 0, piece.at(1, u));
    Vec3 const slope(piece.slope(0, u), 0, piece.slope(1, u));
    Vec3 const bend(6 * piece.c[3][0] * u + 2 * piece.c[2][0], 0,
                    6 * piece.c[3][1] * u + 2 * piece.c[2][1]);
    // How the step follows u, and a move m of the line: by across . m over u, by |m| along it.
    double step, rate, curl, along_m, rounding;
    Vec3 across;
    if (conic) {
      Vec3 const q = glm::cross(p, w), r = glm::cross(d, w);
      double const rr = glm::dot(r, r), size = std::sqrt(glm::dot(w, w));
      step = -glm::dot(q, r) / rr;
      double const height = std::fabs(p.y + step * d.y);
      rate = height * std::fabs(glm::dot(glm::cross(slope, w), r)) / rr;
      curl = height * vector_length(bend) * size / std::sqrt(rr);
      across = glm::abs(r);
      along_m = size / std::sqrt(rr);
      rounding = gamma_bound(16) * vector_length(p) * along_m;
    } else {
      double const x = w.x - p.x, z = w.z - p.z;
      step = (x * d.x + z * d.z) / across2;
      rate = std::fabs(slope.x * d.x + slope.z * d.z) / across2;
      curl = std::fabs(bend.x * d.x + bend.z * d.z) / across2;
      across = Vec3(std::fabs(d.z), 0, std::fabs(d.x));
      along_m = 1 / std::sqrt(across2);
      rounding = gamma_bound(16)
                 * (std::fabs(w.x) + std::fabs(w.z) + std::fabs(p.x) + std::fabs(p.z)) * along_m;
    }
    auto const shift = [&](Vec3 const& m, double known) {
      double const du =
          known + root_motion(sum_of_products(across, m), std::fabs(root.slope), root.bend);
      return (rate + curl * du) * du + (m.x + (conic ? m.y : 0) + m.z) * along_m;
    };
    Crossing c;
    c.t = from + step * unit;
    c.error = unit * (shift(moved(c.t), root.error) + rounding)
              + gamma_bound(4) * (std::fabs(c.t) + std::fabs(from) + std::fabs(step * unit));
    c.slack = unit * shift(slack(), 0);
    return c;
  }
};

void SplinePrism::piece_crossings(Cut const& cut, std::size_t k, Crossings& out) const {
  Piece const& piece = pieces_[k];
  int const first = cut.side(piece.begin[0], piece.begin[1]);
  int const last = cut.side(piece.end[0], piece.end[1]);
  if (piece.degree == 1 && first == last) return;
  PolynomialRoots roots;
  piece.with_degree([&](auto degree) {
    auto const f = [&]<class N>(N) { return cut.along_piece<N, degree()>(piece); };
    if (!unit_roots(f(double{}), first, last, roots)) unit_roots(f(Twofold{}), first, last, roots);
  });
  for (PolynomialRoot const& root : roots) {
    Crossing c = cut.crossing(piece, root);
    c.face = static_cast<std::uint32_t>(2 + 2 * k);
    c.entering = root.rising; // to the left of the piece, for now
    out.push_back(c);
  }
}

/// Where the line passes the heights of the lids. @return false: it stays beyond one of them
bool SplinePrism::between(Ray const& ray, Crossing& in, Crossing& leave) const {
  double const o = ray.origin.y, d = ray.direction.y;
  in.t = -infinity;
  leave.t = infinity;
  if (d == 0) return form_.low <= o && o <= form_.high;
  auto const lid = [&](bool high, bool entering) {
    double const height = high ? form_.high : form_.low;
    Crossing c;
    c.t = (height - o) / d;
    c.error = (ray.origin_rounding.y + std::fabs(c.t) * ray.direction_rounding.y
               + gamma_bound(4) * (std::fabs(height) + std::fabs(o)))
                  / std::fabs(d)
              + gamma_bound(2) * std::fabs(c.t);
    c.slack = ray.origin_error.y / std::fabs(d);
    c.face = high ? 1 : 0;
    c.entering = entering;
    c.visible = !form_.open;
    return c;
  };
  in = lid(d < 0, true);
  leave = lid(d > 0, false);
  return true;
}

/// Crossings of the walls, from senses to ways in and out: only those where the inside changes, and
/// only between the lids. @param turns of the line before the first; where that is inside, the way
/// in is the lid, and left out behind `from`
void SplinePrism::match(std::size_t first, int turns, Crossing const& in, Crossing const& leave,
                        double from, Crossings& out) const {
  std::sort(out.begin() + static_cast<std::ptrdiff_t>(first), out.end(),
            [](Crossing const& a, Crossing const& b) {
              return a.t != b.t ? a.t < b.t : a.face < b.face;
            });
  std::size_t to = first;
  bool const from_far = turns != 0;
  for (std::size_t i = first; i < out.size(); ++i) {
    Crossing c = out[i];
    bool const left = c.entering, was = turns != 0;
    turns = turned(turns, left);
    bool const is = turns != 0;
    if (was == is) continue;
    if (form_.fill == Fill::NonZero && is && to > first
        && c.t - out[to - 1].t <= c.error + out[to - 1].error) {
      --to; // two outlines that touch have no gap between them
      continue;
    }
    c.entering = is;
    if (is == left) c.face |= 1U;
    out[to++] = c;
  }
  out.resize(to);
  auto const begin = out.begin() + static_cast<std::ptrdiff_t>(first);
  if (from_far) out.insert(begin, in);
  if (turns != 0) out.push_back(leave);
  to = first;
  for (std::size_t i = first; i + 1 < out.size(); i += 2) {
    Crossing const a = out[i].t < in.t ? in : out[i];
    Crossing const b = out[i + 1].t > leave.t ? leave : out[i + 1];
    if (!(a.t < b.t)) continue;
    bool const behind = from_far && i == first && a.t < from;
    if (!behind) out[to++] = a;
    out[to++] = b;
  }
  out.resize(to);
}

void SplinePrism::sheet_crossing(Ray const& ray, Crossings& out) const {
  double const speed = ray.direction.y;
  if (speed == 0) return;
  Crossing c;
  c.t = (form_.low - ray.origin.y) / speed;
  Vec3 const at = ray.origin + c.t * ray.direction;
  double const scale = form_.sweep == Sweep::Conic ? form_.low : 1;
  if (!in_section(at.x / scale, at.z / scale)) return;
  c.error = (ray.origin_rounding.y + std::fabs(c.t) * ray.direction_rounding.y
             + gamma_bound(4) * (std::fabs(form_.low) + std::fabs(ray.origin.y)))
                / std::fabs(speed)
            + gamma_bound(2) * std::fabs(c.t);
  c.slack = ray.origin_error.y / std::fabs(speed);
  c.entering = speed > 0;
  c.toggles = false;
  out.push_back(c);
}

/// @param from what is behind it may be left out
void SplinePrism::find(Ray const& ray, double from, Crossings& out) const {
  if (!solid()) return sheet_crossing(ray, out);
  Crossing in, leave;
  if (!between(ray, in, leave)) return;
  std::size_t const first = out.size();
  bool const conic = form_.sweep == Sweep::Conic;
  Cut const cut(ray, form_.sweep);
  if (cut.along) {
    double const y = ray.direction.y;
    bool const inside = conic ? y != 0 && in_section(ray.direction.x / y, ray.direction.z / y)
                              : in_section(ray.origin.x, ray.origin.z);
    if (!inside || y == 0) return;
    out.push_back(in);
    out.push_back(leave);
    return;
  }
  int turns = 0;
  if (conic) {
    for (std::size_t k = 0; k < pieces_.size(); ++k)
      if (!cut.misses(hulls_[k], reach_)) piece_crossings(cut, k, out);
    // Where the line passes the height of the apex it is outside of the curves: turns are counted
    // from there, and on from the far end.
    double const rise = ray.direction.y, apex = rise != 0 ? -ray.origin.y / rise : infinity;
    for (std::size_t i = first; i < out.size(); ++i)
      if (out[i].t > apex) turns = turned(turns, out[i].entering);
    from = -infinity;
  } else {
    // Pieces before that count by their ends alone, those beyond not at all.
    double const low = std::max(in.t, from), high = leave.t;
    double const room = cut.room(low, high, reach_);
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      if (cut.misses(hulls_[k], reach_)) continue;
      auto const [begin, end] = cut.reach_of(hulls_[k]);
      if (begin > high + room) continue;
      if (!(end < low - room)) {
        piece_crossings(cut, k, out);
        continue;
      }
      Piece const& piece = pieces_[k];
      int const a = cut.side(piece.begin[0], piece.begin[1]),
                b = cut.side(piece.end[0], piece.end[1]);
      if (a != b) turns = turned(turns, a < b);
    }
  }
  if (out.size() > first || turns != 0) match(first, turns, in, leave, from, out);
}

void SplinePrism::crossings(Ray const& ray, Start const* start, Crossings& out) const {
  // A ray from a patch does not come back to it.
  if (!solid() && start != nullptr) return;
  std::size_t const first = out.size();
  find(ray, -infinity, out);
  if (start != nullptr) impose_start(*start, false, first, out);
}

void SplinePrism::crossings_ahead(Ray const& ray, Start const* start, double /*until*/,
                                  Crossings& out) const {
  if (start != nullptr) return crossings(ray, start, out);
  find(ray, 0, out);
}

bool SplinePrism::in_section(double x, double z) const {
  int turns = 0;
  for (Piece const& piece : pieces_) {
    auto const f = [&]<class N>(N) { return sum_of(piece.terms<N, 3>(1), constant(N(-z))); };
    int const first = piece.begin[1] < z ? -1 : 1, last = piece.end[1] < z ? -1 : 1;
    if (piece.degree == 1 && first == last) continue;
    PolynomialRoots roots;
    if (!unit_roots(f(double{}), first, last, roots)) unit_roots(f(Twofold{}), first, last, roots);
    for (PolynomialRoot const& root : roots) {
      if (!(piece.at(0, root.at) > x)) continue;
      turns = form_.fill == Fill::EvenOdd ? 1 - turns : turns + (root.rising ? 1 : -1);
    }
  }
  return turns != 0;
}

bool SplinePrism::inside(Vec3 const& point) const {
  if (!solid() || point.y < form_.low || point.y > form_.high) return false;
  if (form_.sweep == Sweep::Linear) return in_section(point.x, point.z);
  return point.y != 0 && in_section(point.x / point.y, point.z / point.y);
}

double SplinePrism::nearest(Piece const& piece, double x, double z) const {
  return nearest_of(piece, x, z).at;
}

Vec3 SplinePrism::normal(Vec3 const& point, std::uint32_t face) const {
  if (face < 2) return {0, face == 0 ? -1 : 1, 0};
  Piece const& piece = pieces_[(face - 2) / 2];
  bool const conic = form_.sweep == Sweep::Conic;
  double const scale = conic ? point.y : 1;
  double u = 0;
  Vec3 slope(piece.c[1][0], 0, piece.c[1][1]);
  if ((piece.degree > 1 || conic) && scale != 0)
    u = nearest(piece, point.x / scale, point.z / scale);
  if (piece.degree > 1) slope = Vec3(piece.slope(0, u), 0, piece.slope(1, u));
  // At the end of a piece whose last two points are one, the direction is that of the rest.
  if (slope == Vec3(0))
    slope = Vec3(piece.end[0] - piece.begin[0], 0, piece.end[1] - piece.begin[1]);
  Vec3 right(slope.z, 0, -slope.x);
  if (conic) {
    Vec3 const w(piece.at(0, u), 1, piece.at(1, u));
    right = std::copysign(1.0, scale) * glm::cross(w, slope);
  }
  if (right == Vec3(0)) return {0, 1, 0};
  return unit_vector((face & 1U) != 0 ? right : -right);
}

SplinePrism::Piece bezier_piece(std::vector<Vec2> const& points) {
  SplinePrism::Piece piece{};
  piece.degree = static_cast<int>(points.size()) - 1;
  for (std::size_t k = 0; k < 2; ++k) {
    auto const p = [&](std::size_t i) { return k == 0 ? points[i].x : points[i].y; };
    double const a = p(0), b = p(1);
    piece.c[0][k] = a;
    if (piece.degree == 1) {
      piece.c[1][k] = b - a;
    } else if (piece.degree == 2) {
      piece.c[1][k] = 2 * (b - a);
      piece.c[2][k] = a - 2 * b + p(2);
    } else {
      piece.c[1][k] = 3 * (b - a);
      piece.c[2][k] = 3 * (a - 2 * b + p(2));
      piece.c[3][k] = p(3) - a + 3 * (b - p(2));
    }
    piece.begin[k] = a;
    piece.end[k] = p(points.size() - 1);
  }
  while (piece.degree > 1 && piece.c[static_cast<std::size_t>(piece.degree)][0] == 0
         && piece.c[static_cast<std::size_t>(piece.degree)][1] == 0)
    --piece.degree;
  return piece;
}

std::optional<PlacedShape> make_spline_prism(std::vector<Outline> outlines,
                                             SplinePrism::Sweep sweep, double y1, double y2,
                                             bool open, SplinePrism::Fill fill) {
  bool const conic = sweep == SplinePrism::Sweep::Conic;
  double low[2] = {infinity, infinity}, high[2] = {-infinity, -infinity};
  std::vector<SplinePrism::Piece> pieces;
  for (Outline const& outline : outlines) {
    for (SplinePrism::Piece const& piece : outline) {
      for (std::size_t k = 0; k < 2; ++k) {
        for (double const value : piece.corners(k)) {
          if (!std::isfinite(value)) return std::nullopt;
          low[k] = std::min(low[k], value);
          high[k] = std::max(high[k], value);
        }
      }
      using Point = SplinePrism::Piece::Point;
      Point const none{0, 0};
      if (piece.c[1] == none && piece.c[2] == none && piece.c[3] == none) continue;
      pieces.push_back(piece);
    }
  }
  bool const flat = y1 == y2;
  double const half = conic  ? std::max(std::fabs(y1), std::fabs(y2))
                      : flat ? 1
                             : std::fabs(y2 * 0.5 - y1 * 0.5);
  if (pieces.empty() || !std::isfinite(y1) || !std::isfinite(y2) || !usable_size(half)
      || !(low[0] < high[0] && low[1] < high[1]))
    return std::nullopt;
  double const middle[2] = {conic ? 0 : low[0] * 0.5 + high[0] * 0.5,
                            conic ? 0 : low[1] * 0.5 + high[1] * 0.5};
  double largest = 0;
  for (int k = 0; k < 2; ++k)
    largest =
        std::max(largest, std::max(std::fabs(low[k] - middle[k]), std::fabs(high[k] - middle[k])));
  if (!usable_size(largest)) return std::nullopt;
  double const unit = std::exp2(std::ilogb(largest));
  for (SplinePrism::Piece& piece : pieces) {
    for (std::size_t k = 0; k < 2; ++k) {
      auto const moved = [&](double value) { return (value - middle[k]) / unit; };
      piece.c[0][k] = piece.begin[k] = moved(piece.begin[k]);
      piece.end[k] = moved(piece.end[k]);
      for (std::size_t i = 1; i < 4; ++i) piece.c[i][k] /= unit;
    }
  }
  SplinePrism::Form form;
  form.sweep = sweep;
  form.fill = fill;
  form.open = open;
  Transform placement;
  if (conic) {
    double const tall = std::exp2(std::ilogb(half));
    form.low = std::min(y1, y2) / tall;
    form.high = std::max(y1, y2) / tall;
    if (!usable_size(unit * tall)) return std::nullopt;
    placement = Transform::scaling({unit * tall, tall, unit * tall});
  } else {
    if (flat) form.low = form.high = 0;
    placement =
        Transform::scaling({unit, half, unit})
            .then(Transform::rounded_translation({middle[0], y1 * 0.5 + y2 * 0.5, middle[1]}, 1));
  }
  return PlacedShape{std::make_shared<SplinePrism>(std::move(pieces), form), placement};
}

} // namespace abbe::geometry
