// SPDX-License-Identifier: MIT
#include "geometry/shapes/blob.hpp"

#include "geometry/shapes/close_line.hpp"
#include "geometry/shapes/reading.hpp"
#include "geometry/shapes/start.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace abbe::geometry {

namespace {

using Component = Blob::Component;

/// Of the unit space's z: below the axis, along it, beyond it.
enum class Part { Low, Body, High };

Part part_at(Component const& c, double z) {
  return c.length == 0 || z < 0 ? Part::Low : (z > c.length ? Part::High : Part::Body);
}

/// From the axis or centre to the point, in unit space.
Vec3 from_axis(Component const& c, Vec3 const& point) {
  Vec3 q = c.to_unit * (point - c.centre);
  Part const part = part_at(c, q.z);
  if (part == Part::Body) q.z = 0;
  if (part == Part::High) q.z -= c.length;
  return q;
}

/// A component on a part of a line, where its density is one polynomial.
struct Stretch {
  double begin, end; ///< of step
  Component const* component;
  Part part;
};

} // namespace

/// One line on its way through the components that it comes near.
struct Blob::Walk {
  Blob const& blob;
  CloseLine close;
  std::vector<Stretch> stretches{};
  std::vector<double> ends{};

  void add_stretches(Component const& c);
  void add_stretch(Component const& c, Part part, double begin, double end, Vec3 const& q,
                   Vec3 const& e);
  /// threshold - density, which is < 0 inside, along step = from + width s.
  template <class N>
  Terms<N, 4> along(double from, double width) const;
  template <class N>
  Terms<N, 4> density(Stretch const& stretch, double from, double width) const;
  int side(double step) const;
};

/// The part of [begin, end] where |q + step e|^2 < 1 (z left out along the axis).
void Blob::Walk::add_stretch(Component const& c, Part part, double begin, double end, Vec3 const& q,
                             Vec3 const& e) {
  Vec3 p = q, d = e;
  if (part == Part::High) p.z -= c.length;
  if (part == Part::Body) p.z = d.z = 0;
  double const a = glm::dot(d, d);
  if (a > 0) {
    double const nearest = -glm::dot(p, d) / a;
    Vec3 const at = p + nearest * d;
    double const room = 1 - glm::dot(at, at);
    if (!(room > 0)) return;
    double const half = std::sqrt(room / a);
    begin = std::max(begin, nearest - half);
    end = std::min(end, nearest + half);
  } else if (!(glm::dot(p, p) < 1)) {
    return;
  }
  if (!(begin < end)) return;
  stretches.push_back({begin, end, &c, part});
  ends.push_back(begin);
  ends.push_back(end);
}

void Blob::Walk::add_stretches(Component const& c) {
  Vec3 const away = c.middle - close.point;
  double const along = glm::dot(away, close.direction);
  double const miss2 = glm::dot(away, away) - along * along / close.length2;
  double const room = c.reach * (1 + gamma_bound(64));
  // What cancels is of the size of the blob itself.
  if (miss2 > room * room + gamma_bound(64) * blob.ball_ * blob.ball_) return;
  Vec3 const q = c.to_unit * (close.point - c.centre), e = c.to_unit * close.direction;
  double const begin = -close.half, end = close.half;
  if (c.length == 0) return add_stretch(c, Part::Low, begin, end, q, e);
  if (e.z == 0) return add_stretch(c, part_at(c, q.z), begin, end, q, e);
  double const low = -q.z / e.z, high = (c.length - q.z) / e.z;
  double const first = std::min(low, high), last = std::max(low, high);
  bool const up = e.z > 0;
  add_stretch(c, up ? Part::Low : Part::High, begin, std::min(first, end), q, e);
  add_stretch(c, Part::Body, std::max(first, begin), std::min(last, end), q, e);
  add_stretch(c, up ? Part::High : Part::Low, std::max(last, begin), end, q, e);
}

template <class N>
Terms<N, 4> Blob::Walk::density(Stretch const& stretch, double from, double width) const {
  Component const& c = *stretch.component;
  auto const p = close.place<N>(from);
  double const off = close.place_error<N>(from);
  Terms<N, 2> rest; // 1 - |q|^2
  rest.c = {N(1.0), N(0.0), N(0.0)};
  for (int row = 0; row < 3; ++row) {
    if (row == 2 && stretch.part == Part::Body) continue;
    Terms<N, 1> q;
    q.c = {N(row == 2 && stretch.part == Part::High ? -c.length : 0.0), N(0.0)};
    double size = std::fabs(rounded(q.c[0])), weight = 0;
    for (int column = 0; column < 3; ++column) {
      double const m = c.to_unit[column][row];
      auto const k = static_cast<std::size_t>(column);
      N const step = N(width) * N(close.direction[column]);
      q.c[0] = q.c[0] + N(m) * (p[k] - N(c.centre[column]));
      q.c[1] = q.c[1] + N(m) * step;
      weight += std::fabs(m);
      size += std::fabs(m)
              * (std::fabs(rounded(p[k])) + std::fabs(c.centre[column]) + std::fabs(rounded(step)));
    }
    q.error = weight * off + 8 * roundoff<N> * size;
    rest = sum_of(rest, -product(q, q));
  }
  return times(N(c.strength), product(rest, rest));
}

template <class N>
Terms<N, 4> Blob::Walk::along(double from, double width) const {
  Terms<N, 4> sum;
  sum.c = {N(blob.threshold_), N(0.0), N(0.0), N(0.0), N(0.0)};
  double const middle = from + 0.5 * width;
  for (Stretch const& stretch : stretches) {
    if (!(stretch.begin < middle && middle < stretch.end)) continue;
    sum = sum_of(sum, -density<N>(stretch, from, width));
  }
  return sum;
}

int Blob::Walk::side(double step) const {
  // At an end of a stretch its density is the square of nothing: left out or not is the same.
  auto const decide = [&]<class N>(N) {
    N sum(blob.threshold_);
    double error = 0;
    for (Stretch const& stretch : stretches) {
      if (!(stretch.begin <= step && step < stretch.end)) continue;
      Terms<N, 4> const f = density<N>(stretch, step, 0.0);
      sum = sum - f.c[0];
      error += f.error + 2 * roundoff<N> * (std::fabs(rounded(sum)) + std::fabs(rounded(f.c[0])));
    }
    return sign_of(sum, error);
  };
  int const first = decide(double{});
  return first != 0 ? first : decide(Twofold{});
}

Blob::Blob(std::vector<Component> components, double threshold)
    : components_(std::move(components)), threshold_(threshold) {
  Vec3 low(infinity), high(-infinity);
  for (Component const& c : components_) {
    textured_ = textured_ || c.texture >= 0;
    if (!(c.strength > 0)) continue; // takes away only
    low = glm::min(low, c.low);
    high = glm::max(high, c.high);
  }
  if (low.x <= high.x) bounds_ = {low, high, false};
  // About the origin, which is near the middle: lines are moved to where they are closest to it.
  ball_ = bounds_.empty() ? 0 : vector_length(glm::max(glm::abs(low), glm::abs(high)));
}

void Blob::find(Ray const& ray, bool all, Crossings& out) const {
  Walk walk{*this, CloseLine(ray, ball_)};
  CloseLine const& close = walk.close;
  if (!(close.half > 0)) return;
  for (Component const& c : components_) walk.add_stretches(c);
  auto& ends = walk.ends;
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  std::size_t i = 0;
  if (!all)
    while (i + 1 < ends.size() && close.near.t + ends[i + 1] < -close.margin()) ++i;
  int before = i == 0 ? 1 : walk.side(ends[i]);
  PolynomialRoots roots;
  for (; i + 1 < ends.size(); ++i) {
    double const from = ends[i], width = ends[i + 1] - from;
    int const after = i + 2 == ends.size() ? 1 : walk.side(ends[i + 1]);
    roots.count = 0;
    Wanted const wanted = all ? Wanted() : close.ahead(from, width);
    if (!unit_roots(walk.along<double>(from, width), before, after, roots, wanted))
      unit_roots(walk.along<Twofold>(from, width), before, after, roots);
    bool done = false;
    for (PolynomialRoot const& root : roots) {
      Vec3 const at = close.at(from + width * root.at);
      out.push_back(close.crossing(from, width, root, gradient(at), 0));
      done = done || (!all && close.is_first_before(out.back(), ends[i + 1]));
    }
    if (done) return;
    before = after;
  }
}

void Blob::crossings(Ray const& ray, Start const* start, Crossings& out) const {
  std::size_t const first = out.size();
  find(ray, true, out);
  if (start != nullptr) impose_start(*start, false, first, out);
}

void Blob::crossings_ahead(Ray const& ray, Start const* start, double, Crossings& out) const {
  if (start != nullptr) return crossings(ray, start, out);
  find(ray, false, out);
}

bool Blob::inside(Vec3 const& point) const {
  double sum = 0;
  for (Component const& c : components_) {
    Vec3 const q = from_axis(c, point);
    double const rest = 1 - glm::dot(q, q);
    if (rest > 0) sum += c.strength * rest * rest;
  }
  return sum >= threshold_;
}

Vec3 Blob::gradient(Vec3 const& point) const {
  Vec3 sum(0);
  for (Component const& c : components_) {
    Vec3 const q = from_axis(c, point);
    double const rest = 1 - glm::dot(q, q);
    if (rest > 0) sum += 4 * c.strength * rest * (glm::transpose(c.to_unit) * q);
  }
  return sum;
}

Vec3 Blob::normal(Vec3 const& point, std::uint32_t) const {
  Vec3 const slope = gradient(point);
  return slope == Vec3(0) || !finite(slope) ? Vec3(0, 1, 0) : unit_vector(slope);
}

int Blob::face_texture(std::uint32_t) const {
  return components_.empty() ? -1 : components_.front().texture;
}

std::optional<FaceBlend> Blob::face_blend(Vec3 const& point, std::uint32_t) const {
  if (!textured_) return std::nullopt;
  FaceBlend blend;
  double total = 0;
  for (Component const& c : components_) {
    Vec3 const q = from_axis(c, point);
    double const rest = 1 - glm::dot(q, q);
    if (!(rest > 0)) continue;
    double const share = std::fabs(c.strength) * rest * rest; // what takes away shows too
    std::size_t k = 0;
    while (k < blend.count && blend.texture[k] != c.texture) ++k;
    if (k == blend.count && k == FaceBlend::most) {
      // Full: the least gives way to more.
      k = static_cast<std::size_t>(std::min_element(blend.share.begin(), blend.share.end())
                                   - blend.share.begin());
      if (blend.share[k] >= share) continue;
      total -= blend.share[k];
      blend.share[k] = 0;
      blend.texture[k] = c.texture;
    } else if (k == blend.count) {
      blend.texture[k] = c.texture;
      blend.share[k] = 0;
      ++blend.count;
    }
    blend.share[k] += share;
    total += share;
  }
  if (blend.count == 0) return std::nullopt;
  for (std::size_t k = 0; k < blend.count; ++k) blend.share[k] /= total;
  return blend;
}

} // namespace abbe::geometry
