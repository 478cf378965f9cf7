// SPDX-License-Identifier: MIT
#include "geometry/shapes/prism.hpp"

#include "geometry/kernels.hpp"
#include "geometry/shapes/convex_prism.hpp"
#include "geometry/shapes/reading.hpp"
#include "geometry/shapes/start.hpp"

#include <algorithm>

namespace abbe::geometry {

namespace {

double across(Vec2 const& a, Vec2 const& b) {
  return lane::difference_of_products(a.x, b.y, a.y, b.x);
}

} // namespace

Prism::Prism(std::vector<Contour> const& contours, bool open)
    : low_(infinity), high_(-infinity), open_(open) {
  for (Contour const& contour : contours) {
    for (std::size_t i = 0; i < contour.size(); ++i) {
      Vec2 const from = contour[i], to = contour[(i + 1) % contour.size()];
      low_ = glm::min(low_, from);
      high_ = glm::max(high_, from);
      if (from != to) edges_.push_back({from, to, {to.y - from.y, from.x - to.x}});
    }
  }
  for (Edge& edge : edges_) {
    // Which side of the edge is inside: the parity of the others around its middle, seen along the
    // coordinate axis that the edge crosses; in_polygon looks along +x.
    Vec2 const middle = edge.from * 0.5 + edge.to * 0.5;
    bool const beyond = in_polygon(middle, &edge);
    if (edge.outward.x != 0) {
      // Beyond the edge towards +x: inside when the rest says so.
      if ((edge.outward.x > 0) == beyond) edge.outward = -edge.outward;
    } else {
      // A horizontal edge: the parity of what is above it decides, by the mirrored polygon.
      bool above = false;
      for (Edge const& other : edges_) {
        if (&other == &edge) continue;
        bool const a = other.from.x > middle.x, b = other.to.x > middle.x;
        if (a == b) continue;
        double const side = across(other.to - other.from, middle - other.from);
        if ((side > 0) == b) continue;
        above = !above;
      }
      if ((edge.outward.y > 0) == above) edge.outward = -edge.outward;
    }
  }
}

bool Prism::in_polygon(Vec2 const& point, Edge const* skip) const {
  bool odd = false;
  for (Edge const& edge : edges_) {
    if (&edge == skip) continue;
    bool const a = edge.from.y > point.y, b = edge.to.y > point.y;
    if (a == b) continue;
    // Is the edge to the right of the point?
    double const side = across(edge.to - edge.from, point - edge.from);
    if ((side > 0) == b) odd = !odd;
  }
  return odd;
}

bool Prism::inside(Vec3 const& point) const {
  return std::fabs(point.y) <= 1 && in_polygon({point.x, point.z}, nullptr);
}

void Prism::edge_crossings(Line<double> const& line, Crossings& out) const {
  Vec2 const v(line.direction.x, line.direction.z);
  double const length2 = glm::dot(v, v);
  double const shift = -(line.origin.x * v.x + line.origin.z * v.y) / length2;
  Approach<double> const near = approach(line, shift);
  Vec2 const p(near.point.x, near.point.z);
  Vec2 const rounding(near.rounding.x, near.rounding.z);
  Vec2 const turning(line.direction_rounding.x, line.direction_rounding.z);
  Vec2 const slack(line.slack.x, line.slack.z);
  for (std::size_t k = 0; k < edges_.size(); ++k) {
    Edge const& edge = edges_[k];
    // A function of the corner and the line alone: the same for both edges of a corner.
    Vec2 const from = edge.from - p, to = edge.to - p;
    double const a = across(v, from), b = across(v, to);
    if ((a > 0) == (b > 0)) continue;
    double const first = glm::dot(v, from) / length2, last = glm::dot(v, to) / length2;
    double const step = first + (last - first) * (a / (a - b));
    Vec2 const size = glm::abs(edge.outward);
    double const speed = std::fabs(glm::dot(edge.outward, v));
    Vec2 const moved =
        rounding + std::fabs(step) * turning
        + gamma_bound(8) * (glm::max(glm::abs(edge.from), glm::abs(edge.to)) + glm::abs(p));
    Crossing c;
    c.t = near.t + step;
    c.error = std::fmin(glm::dot(size, moved) / speed, std::fabs(last - first))
              + gamma_bound(4) * (std::fabs(c.t) + std::fabs(step));
    c.slack = speed > 0 ? glm::dot(size, slack) / speed : 0;
    c.face = static_cast<std::uint32_t>(k + 2);
    out.push_back(c);
  }
}

void Prism::crossings(Ray const& ray, Start const* start, Crossings& out) const {
  Line<double> const line = line_of(ray);
  std::size_t const first = out.size();
  Slice<double> const lids = kernels::slab(line.origin.y, line.direction.y, line.origin_rounding.y,
                                           line.direction_rounding.y, line.slack.y, 0.0);
  auto const lid = [&](Root<double> const& root, double face, bool entering) {
    return Crossing{root.t,   root.error, root.slack, static_cast<std::uint32_t>(face),
                    entering, true,       !open_};
  };
  if (line.direction.x == 0 && line.direction.z == 0) {
    if (in_polygon({line.origin.x, line.origin.z}, nullptr)) {
      out.push_back(lid(lids.in, lids.in_face, true));
      out.push_back(lid(lids.out, lids.out_face, false));
    }
  } else {
    edge_crossings(line, out);
    std::sort(out.begin() + static_cast<std::ptrdiff_t>(first), out.end(),
              [](Crossing const& a, Crossing const& b) {
                return a.t != b.t ? a.t < b.t : a.face < b.face;
              });
    // Each pair of crossings is a stretch inside the polygon: keep what is between the lids.
    std::size_t to = first;
    for (std::size_t i = first; i + 1 < out.size(); i += 2) {
      Crossing in = out[i], leave = out[i + 1];
      in.entering = true;
      leave.entering = false;
      if (in.t < lids.in.t) in = lid(lids.in, lids.in_face, true);
      if (leave.t > lids.out.t) leave = lid(lids.out, lids.out_face, false);
      if (!(in.t < leave.t)) continue;
      out[to++] = in;
      out[to++] = leave;
    }
    out.resize(to);
  }
  if (start != nullptr) impose_start(*start, true, first, out);
}

Vec3 Prism::normal(Vec3 const&, std::uint32_t face) const {
  if (face < 2) return {0, face == 0 ? -1 : 1, 0};
  Vec2 const& outward = edges_[face - 2].outward;
  return unit_vector({outward.x, 0, outward.y});
}

Bounds Prism::bounds() const {
  return {{low_.x, -1, low_.y}, {high_.x, 1, high_.y}};
}

std::optional<PlacedShape> make_prism(std::vector<Prism::Contour> contours, double y1, double y2,
                                      bool open) {
  Vec2 low(infinity), high(-infinity);
  for (Prism::Contour const& contour : contours) {
    for (Vec2 const& point : contour) {
      if (!std::isfinite(point.x) || !std::isfinite(point.y)) return std::nullopt;
      low = glm::min(low, point);
      high = glm::max(high, point);
    }
  }
  std::erase_if(contours, [](Prism::Contour const& contour) { return contour.size() < 3; });
  double const half = std::fabs(y2 * 0.5 - y1 * 0.5);
  if (contours.empty() || !std::isfinite(y1) || !std::isfinite(y2) || !usable_size(half)
      || !(low.x < high.x && low.y < high.y)) {
    return std::nullopt;
  }
  Vec2 const middle = low * 0.5 + high * 0.5;
  for (Prism::Contour& contour : contours) {
    for (Vec2& point : contour) point -= middle;
  }
  Transform const placement =
      Transform::scaling({1, half, 1})
          .then(Transform::rounded_translation({middle.x, y1 * 0.5 + y2 * 0.5, middle.y}, 1));
  if (contours.size() == 1 && ConvexPrism::is_convex(contours.front())) {
    return PlacedShape{std::make_shared<ConvexPrism>(contours.front(), open), placement};
  }
  return PlacedShape{std::make_shared<Prism>(contours, open), placement};
}

} // namespace abbe::geometry
