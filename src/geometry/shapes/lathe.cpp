// SPDX-License-Identifier: MIT
#include "geometry/shapes/lathe.hpp"

#include "geometry/shapes/close_line.hpp"
#include "geometry/shapes/reading.hpp"
#include "geometry/shapes/start.hpp"
#include "simd/math.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace abbe::geometry {

namespace {

constexpr double level = 0x1p-40;

} // namespace

Lathe::Lathe(std::vector<Piece> pieces) : pieces_(std::move(pieces)) {
  low_ = infinity;
  high_ = -infinity;
  std::vector<Lid> ends;
  for (Piece const& piece : pieces_) {
    auto const r = piece.corners(0), y = piece.corners(1);
    auto const [low, high] = std::minmax_element(y.begin(), y.end());
    auto const [least, most] = std::minmax_element(r.begin(), r.end());
    double const wide = gamma_bound(16) * std::max(std::fabs(*low), std::fabs(*high));
    double const radius = std::max(std::fabs(*least), std::fabs(*most)) * (1 + gamma_bound(16));
    boxes_.push_back({*low - wide, *high + wide, radius});
    low_ = std::min(low_, *low - wide);
    high_ = std::max(high_, *high + wide);
    radius_ = std::max(radius_, radius);
    for (auto const& end : {piece.begin, piece.end}) {
      // The inside changes at the height of an end; where two ends meet, twice.
      auto const same = [&](Lid const& lid) {
        return lid.radius == std::fabs(end[0]) && lid.height == end[1];
      };
      auto const other = std::find_if(ends.begin(), ends.end(), same);
      if (other != ends.end())
        ends.erase(other);
      else
        ends.push_back({std::fabs(end[0]), end[1]});
    }
  }
  for (Lid const& lid : ends) {
    if (lid.radius > 0) lids_.push_back(lid);
  }
  ball_ = simd::hypot(radius_, std::max(std::fabs(low_), std::fabs(high_))) * (1 + gamma_bound(8));
}

/// The line with its direction scaled by a power of two to the length of about 1, from its closest
/// approach to the axis (or, along the axis, to the origin). A steep line may be closest far above
/// or below: then from where it is at the nearest of the heights from `low` to `high`.
struct Lathe::Turned {
  /// All that meeting() makes of the line.
  template <class N>
  struct Parts {
    N height;   ///< of the point
    double off; ///< of the point's components, at most
    N rise2, twice_rise;
    Terms<N, 0> away, across, flat; ///< -|p_xz|^2, p_xz . d_xz, |d_xz|^2
  };
  Line<double> line;
  Vec3 d;                       ///< scaled
  double unit = 1;              ///< of t
  double from = 0;              ///< t of the point
  Vec3 p{0};                    ///< the point, rounded
  double across2 = 0, rise = 0; ///< |d_xz|^2, d.y
  bool is_level = false;
  double asked_radius = NAN, asked_height = NAN; ///< of the last question to meets()
  int answer = 0;
  Parts<double> doubles;

  Turned(Ray const& ray, double low, double high) : line(line_of(ray)) {
    unit = std::exp2(-std::ilogb(vector_length(ray.direction)));
    d = ray.direction * unit;
    across2 = d.x * d.x + d.z * d.z;
    rise = d.y;
    double step =
        across2 > 0 ? -(ray.origin.x * d.x + ray.origin.z * d.z) / across2 : -ray.origin.y / d.y;
    if (rise * rise > across2) {
      double const a = (low - ray.origin.y) / rise, b = (high - ray.origin.y) / rise;
      step = std::clamp(step, std::min(a, b), std::max(a, b));
    }
    from = step * unit;
    p = ray.origin + step * d;
    is_level = std::fabs(rise) < level * std::sqrt(across2);
    doubles = find_parts<double>();
  }
  template <class N>
  N place(int i) const {
    double const o = i == 0 ? line.origin.x : (i == 1 ? line.origin.y : line.origin.z);
    return N(o) + N(from / unit) * N(d[i]);
  }
  template <class N>
  double place_error() const {
    Vec3 const o = glm::abs(Vec3(line.origin.x, line.origin.y, line.origin.z));
    Vec3 const far = o + std::fabs(from / unit) * glm::abs(d);
    return 4 * roundoff<N> * std::max(far.x, std::max(far.y, far.z));
  }
  template <class N>
  Parts<N> find_parts() const {
    double const off = place_error<N>(), u = roundoff<N>;
    N const px = place<N>(0), pz = place<N>(2), dx(d.x), dz(d.z), dy(d.y);
    double const size = std::fabs(rounded(px)) + std::fabs(rounded(pz)) + off;
    return {place<N>(1),
            off,
            dy * dy,
            N(2.0) * dy,
            constant(-(px * px + pz * pz), size * (4 * off + 6 * u * size)),
            constant(px * dx + pz * dz, 4 * (off + 4 * u * size)),
            constant(dx * dx + dz * dz, 8 * u)};
  }
  /// rise^2 r^2 - |xz of the line where it is at y|^2 rise^2: positive where the line passes
  /// within r of the axis.
  template <class N, int Degree>
  Terms<N, 2 * Degree> meeting(Terms<N, Degree> const& r, Terms<N, Degree> const& y) const {
    if constexpr (std::is_same_v<N, double>)
      return meeting(doubles, r, y);
    else
      return meeting(find_parts<N>(), r, y);
  }
  template <class N, int Degree>
  static Terms<N, 2 * Degree> meeting(Parts<N> const& of, Terms<N, Degree> const& r,
                                      Terms<N, Degree> const& y) {
    auto const above = sum_of(y, constant(-of.height, of.off));
    auto const radial = sum_of(product(r, r), of.away);
    // rise^2 (r^2 - |p|^2) - Y (2 rise g + |d_xz|^2 Y), Y = y - p.y
    auto const tilt = sum_of(times(of.twice_rise, of.across), product(of.flat, above));
    return sum_of(times(of.rise2, radial), -product(above, tilt));
  }
  /// Does the line pass within the radius of the axis at a height? -1 or 1. Neighbouring pieces ask
  /// for their joint one after the other.
  int meets(double radius, double height) {
    if (radius == asked_radius && height == asked_height) return answer;
    asked_radius = radius;
    asked_height = height;
    return answer = decide_meets(radius, height);
  }
  int decide_meets(double radius, double height) const {
    auto const decide = [&]<class N>(N) {
      auto const f = meeting(constant(N(radius)), constant(N(height)));
      return sign_of(f.c[0], f.error);
    };
    int const first = decide(double{});
    return first != 0 ? first : decide(Twofold{});
  }
  Vec3 moved(double t) const {
    auto const m = line.origin_rounding + std::fabs(t) * line.direction_rounding;
    double const off = place_error<double>();
    return Vec3(m.x, m.y, m.z) + Vec3(off);
  }
};

void Lathe::piece_crossings(Turned& line, std::size_t k, Crossings& out) const {
  Piece const& piece = pieces_[k];
  PolynomialRoots roots;
  int const first = line.meets(piece.begin[0], piece.begin[1]);
  int const last = line.meets(piece.end[0], piece.end[1]);
  piece.with_degree([&](auto degree) {
    auto const f = [&]<class N>(N) {
      return line.meeting(piece.terms<N, degree()>(0), piece.terms<N, degree()>(1));
    };
    if (!unit_roots(f(double{}), first, last, roots)) unit_roots(f(Twofold{}), first, last, roots);
  });
  double const g = line.p.x * line.d.x + line.p.z * line.d.z;
  double const p2 = line.p.x * line.p.x + line.p.z * line.p.z;
  for (PolynomialRoot const& root : roots) {
    double const r = piece.at(0, root.at), r_slope = piece.slope(0, root.at);
    double const above = piece.at(1, root.at) - line.p.y, y_slope = piece.slope(1, root.at);
    // The step by height, and by distance; the better conditioned counts.
    double const by_height = above / line.rise;
    double const inner = g * g - line.across2 * (p2 - r * r);
    double const reach = inner > 0 ? std::sqrt(inner) : 0;
    double const by_distance =
        (std::copysign(reach, by_height * line.across2 + g) - g) / line.across2;
    double const height_rate = std::fabs(y_slope / line.rise);
    double const distance_rate = std::fabs(r * r_slope) / reach;
    double const size = std::fabs(r) + std::fabs(above);
    Vec3 const moved = line.moved(line.from + by_height * line.unit);
    Vec3 const slack(line.line.slack.x, line.line.slack.y, line.line.slack.z);
    auto const shift = [&](Vec3 const& by) {
      double const e = 4 * (by.x + by.y + by.z)
                       * (line.rise * line.rise * std::fabs(r)
                          + (std::fabs(line.rise) + std::fabs(above)) * std::fabs(above));
      return root_motion(e, root.slope, root.bend);
    };
    double const in_u = root.error + shift(moved);
    double const height_error =
        height_rate * in_u
        + (moved.y + gamma_bound(8) * (size + std::fabs(line.p.y))) / std::fabs(line.rise);
    double const distance_error =
        reach > 0 ? distance_rate * in_u
                        + root_motion(std::sqrt(line.across2) * 2 * size * (moved.x + moved.z)
                                          + gamma_bound(16) * (g * g + line.across2 * (p2 + r * r)),
                                      2 * reach, line.across2)
                        + gamma_bound(8) * std::fabs(by_distance)
                  : infinity;
    bool const height = !(distance_error < height_error);
    double const step = height ? by_height : by_distance;
    Crossing c;
    c.t = line.from + step * line.unit;
    c.error = line.unit * (height ? height_error : distance_error)
              + gamma_bound(4) * (std::fabs(c.t) + std::fabs(line.from));
    c.slack = line.unit
              * (height ? height_rate * shift(slack) + slack.y / std::fabs(line.rise)
                        : distance_rate * shift(slack)
                              + (slack.x + slack.z) * (std::fabs(r) + std::fabs(g)) / reach);
    // Along the curve's normal (y', -r') to the right of it: which way the line goes.
    Vec3 const at = line.p + step * line.d;
    double const outward =
        at.x * line.d.x + at.z * line.d.z; // r times the speed away from the axis
    double const across = outward * y_slope - line.rise * r * r_slope;
    c.face = static_cast<std::uint32_t>(2 * k);
    c.entering = across * r < 0 || (across == 0 && root.rising); // of the right side, for now
    out.push_back(c);
  }
}

void Lathe::level_crossings(Turned const& line, Crossings& out) const {
  double const g = line.p.x * line.d.x + line.p.z * line.d.z;
  double const p2 = line.p.x * line.p.x + line.p.z * line.p.z;
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    Piece const& piece = pieces_[k];
    if (!(boxes_[k].low <= line.p.y && line.p.y <= boxes_[k].high)) continue;
    auto const f = [&]<class N>(N) {
      return sum_of(piece.terms<N, 3>(1), constant(-line.place<N>(1), line.place_error<N>()));
    };
    auto const side = [&](double height) {
      Twofold const rise = Twofold(height) - line.place<Twofold>(1);
      return sign_of(rise, 0);
    };
    PolynomialRoots roots;
    int const first = side(piece.begin[1]), last = side(piece.end[1]);
    if (!unit_roots(f(double{}), first, last, roots)) unit_roots(f(Twofold{}), first, last, roots);
    for (PolynomialRoot const& root : roots) {
      for (double const sign : {-1.0, 1.0}) {
        double u = root.at, step = 0, reach = 0;
        double const y_slope = piece.slope(1, u);
        for (int pass = 0; pass < 2; ++pass) {
          double const r = piece.at(0, u);
          double const inner = g * g - line.across2 * (p2 - r * r);
          reach = inner > 0 ? std::sqrt(inner) : 0;
          step = (sign * reach - g) / line.across2;
          double const next = root.at + step * line.rise / y_slope;
          if (next >= 0 && next <= 1) u = next;
        }
        if (!(reach > 0)) continue;
        double const r = piece.at(0, u), r_slope = piece.slope(0, u);
        Vec3 const moved = line.moved(line.from + step * line.unit);
        Vec3 const slack(line.line.slack.x, line.line.slack.y, line.line.slack.z);
        double const rate = std::fabs(r * r_slope) / reach;
        double const tilt = std::fabs(step * line.rise) * level;
        Crossing c;
        c.t = line.from + step * line.unit;
        c.error =
            line.unit
                * (rate * (root.error + root_motion(moved.y + tilt, root.slope, root.bend))
                   + root_motion(std::sqrt(line.across2) * 2 * std::fabs(r) * (moved.x + moved.z)
                                     + gamma_bound(16) * (g * g + line.across2 * (p2 + r * r)),
                                 2 * reach, line.across2))
            + gamma_bound(4) * (std::fabs(c.t) + std::fabs(line.from));
        c.slack = line.unit
                  * (rate * root_motion(slack.y, root.slope, root.bend)
                     + (slack.x + slack.z) * (std::fabs(r) + std::fabs(g)) / reach);
        c.face = static_cast<std::uint32_t>(2 * k);
        c.entering = sign * y_slope * r < 0;
        out.push_back(c);
      }
    }
  }
}

void Lathe::crossings(Ray const& ray, Start const* start, Crossings& out) const {
  Turned line(ray, low_, high_);
  std::size_t const first = out.size();
  Vec3 const& p = line.p;
  double const near = std::sqrt(p.x * p.x + p.z * p.z);
  Vec3 const moved = line.moved(line.from);
  bool const far = near > radius_ + moved.x + moved.z;
  if (line.is_level && !far) {
    level_crossings(line, out);
  } else if (!far) {
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      Box const& box = boxes_[k];
      double const a = (box.low - p.y - moved.y) / line.rise,
                   b = (box.high - p.y + moved.y) / line.rise;
      // Closest to the axis within the piece's heights.
      double const closest = a * b < 0 ? 0 : std::min(std::fabs(a), std::fabs(b));
      double const beside = std::sqrt(near * near + line.across2 * closest * closest);
      if (beside * (1 - gamma_bound(16)) > box.radius + moved.x + moved.z) continue;
      piece_crossings(line, k, out);
    }
    for (std::size_t i = 0; i < lids_.size(); ++i) {
      Lid const& lid = lids_[i];
      if (line.meets(lid.radius, lid.height) < 0) continue;
      double const step = (lid.height - p.y) / line.rise;
      Crossing c;
      c.t = line.from + step * line.unit;
      c.error = line.unit * (moved.y + gamma_bound(8) * (std::fabs(lid.height) + std::fabs(p.y)))
                    / std::fabs(line.rise)
                + gamma_bound(4) * (std::fabs(c.t) + std::fabs(line.from));
      c.slack = line.unit * line.line.slack.y / std::fabs(line.rise);
      c.face = static_cast<std::uint32_t>(2 * (pieces_.size() + i));
      c.entering = line.rise < 0;
      c.visible = false;
      out.push_back(c);
    }
  }
  std::sort(out.begin() + static_cast<std::ptrdiff_t>(first), out.end(),
            [](Crossing const& a, Crossing const& b) {
              return a.t != b.t ? a.t < b.t : a.face < b.face;
            });
  for (std::size_t i = first; i < out.size(); ++i) {
    Crossing& c = out[i];
    bool const entering = (i - first) % 2 == 0;
    if (c.entering != entering) c.face |= 1U;
    c.entering = entering;
  }
  if (start != nullptr) impose_start(*start, false, first, out);
}

bool Lathe::inside(Vec3 const& point) const {
  // Crossings of the level half-line outward: where y(u) is the height and r(u) is more.
  double const distance = simd::hypot(point.x, point.z);
  bool odd = false;
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    Piece const& piece = pieces_[k];
    if (!(boxes_[k].low <= point.y && point.y <= boxes_[k].high)) continue;
    PolynomialRoots roots;
    auto const f = [&]<class N>(N) { return sum_of(piece.terms<N, 3>(1), constant(N(-point.y))); };
    int const first = piece.begin[1] < point.y ? -1 : 1, last = piece.end[1] < point.y ? -1 : 1;
    if (!unit_roots(f(double{}), first, last, roots)) unit_roots(f(Twofold{}), first, last, roots);
    for (PolynomialRoot const& root : roots)
      if (std::fabs(piece.at(0, root.at)) > distance) odd = !odd;
  }
  return odd;
}

double Lathe::nearest(Piece const& piece, Vec3 const& point) const {
  double const distance = simd::hypot(point.x, point.z);
  auto const right = nearest_of(piece, distance, point.y);
  auto const left = nearest_of(piece, -distance, point.y);
  return left.miss < right.miss ? left.at : right.at;
}

Vec3 Lathe::normal(Vec3 const& point, std::uint32_t face) const {
  std::size_t const k = face / 2;
  if (k >= pieces_.size()) return {0, (face & 1U) != 0 ? -1 : 1, 0};
  double const u = nearest(pieces_[k], point);
  double const r_slope = pieces_[k].slope(0, u), y_slope = pieces_[k].slope(1, u);
  double const distance = simd::hypot(point.x, point.z);
  // Where r is negative, the curve stands on the other side of the axis.
  double const turn = pieces_[k].at(0, u) < 0 ? -1 : 1;
  Vec3 const away = distance > 0 ? Vec3(point.x, 0, point.z) / distance : Vec3(1, 0, 0);
  Vec3 const right = away * (turn * y_slope) + Vec3(0, -r_slope, 0);
  if (right == Vec3(0)) return {0, 1, 0};
  return unit_vector((face & 1U) != 0 ? -right : right);
}

Bounds Lathe::bounds() const {
  return {{-radius_, low_, -radius_}, {radius_, high_, radius_}, false};
}

std::optional<Vec2> Lathe::uv(Vec3 const& point, std::uint32_t face) const {
  std::size_t const k = face / 2;
  if (k >= pieces_.size()) return std::nullopt;
  double const turn = simd::atan2(point.z, point.x) / 6.283185307179586476925286766559;
  return Vec2(turn < 0 ? turn + 1 : turn, (static_cast<double>(k) + nearest(pieces_[k], point))
                                              / static_cast<double>(pieces_.size()));
}

std::optional<PlacedShape> make_lathe(SplineKind kind, std::vector<Vec2> const& points) {
  double low = infinity, high = -infinity, largest = 0;
  for (Vec2 const& p : points) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) return std::nullopt;
    low = std::min(low, p.y);
    high = std::max(high, p.y);
    largest = std::max(largest, std::fabs(p.x));
  }
  double const middle = low * 0.5 + high * 0.5;
  if (largest == 0) return std::nullopt;
  largest = std::max(largest, high - middle);
  if (!usable_size(largest)) return std::nullopt;
  double const unit = std::exp2(std::ilogb(largest));
  std::vector<std::array<double, 2>> scaled;
  for (Vec2 const& p : points) scaled.push_back({p.x / unit, (p.y - middle) / unit});
  auto pieces = spline_pieces<2>(kind, scaled);
  std::erase_if(pieces, [](Lathe::Piece const& p) {
    return p.c[1] == std::array{0.0, 0.0} && p.c[2] == p.c[1] && p.c[3] == p.c[1];
  });
  if (pieces.empty()) return std::nullopt;
  Transform const placement =
      Transform::scaling(Vec3(unit)).then(Transform::translation({0, middle, 0}));
  return PlacedShape{std::make_shared<Lathe>(std::move(pieces)), placement};
}

std::optional<PlacedShape> read_lathe(Parameters& parameters) {
  static constexpr SplineWord words[] = {{"linear_spline", SplineKind::Linear, 2},
                                         {"quadratic_spline", SplineKind::Quadratic, 3},
                                         {"cubic_spline", SplineKind::Cubic, 4},
                                         {"bezier_spline", SplineKind::Bezier, 4}};
  SplineWord const* const named = accept_spline(parameters, words);
  auto const [word, kind, least] = named != nullptr ? *named : words[0];
  auto const points = read_points(parameters, least);
  if (!points) return std::nullopt;
  (void)parameters.flag("sturm");
  if (kind == SplineKind::Bezier && points->size() % 4 != 0) {
    parameters.report(Severity::Error, "E0623", "a bezier_spline has four points for each piece");
    return std::nullopt;
  }
  auto const same = [&](Vec2 const& p) { return p == points->front(); };
  auto const on_axis = [](Vec2 const& p) { return p.x == 0; };
  if (std::all_of(points->begin(), points->end(), same)
      || std::all_of(points->begin(), points->end(), on_axis))
    return left_out(parameters, "E0624",
                    "a lathe whose points are all on the axis or in one place is not drawn");
  return or_report(make_lathe(kind, *points), parameters, "E0624", "a lathe needs finite points");
}

} // namespace abbe::geometry
