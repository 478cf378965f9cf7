// SPDX-License-Identifier: MIT
#include "geometry/shapes/polygon.hpp"

#include "geometry/line.hpp"
#include "geometry/shapes/reading.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::geometry {

Polygon::Polygon(std::vector<Edge> edges, bool inner)
    : edges_(std::move(edges)), inner_(inner), low_(infinity), high_(-infinity) {
  for (Edge const& edge : edges_) {
    low_ = glm::min(low_, edge.from);
    high_ = glm::max(high_, edge.from);
  }
}

bool Polygon::covers(Vec2 const& point) const {
  bool odd = false;
  for (Edge const& edge : edges_) {
    bool const a = edge.from.y > point.y, b = edge.to.y > point.y;
    if (a == b) continue;
    Vec2 const along = edge.to - edge.from, to = point - edge.from;
    if ((lane::difference_of_products(along.x, to.y, along.y, to.x) > 0) == b) odd = !odd;
  }
  return odd;
}

void Polygon::crossings(Ray const& ray, Start const* start, Crossings& out) const {
  double const speed = ray.direction.y;
  // A ray from the patch does not come back to it.
  if (start != nullptr || speed == 0) return;
  Crossing c;
  c.t = -ray.origin.y / speed;
  Vec3 const at = ray.origin + c.t * ray.direction;
  if (!covers({at.x, at.z})) return;
  c.error = (ray.origin_rounding.y + std::fabs(c.t) * ray.direction_rounding.y) / std::fabs(speed)
            + gamma_bound(2) * std::fabs(c.t);
  c.slack = ray.origin_error.y / std::fabs(speed);
  c.entering = !inner_ && speed < 0;
  c.toggles = false;
  out.push_back(c);
}

Bounds Polygon::bounds() const {
  return {{low_.x, 0, low_.y}, {high_.x, 0, high_.y}, false};
}

std::optional<PlacedShape> make_polygon(std::vector<std::vector<Vec3>> const& outlines,
                                        Vec3 const& outward, bool inner) {
  Vec3 low(infinity), high(-infinity);
  for (auto const& outline : outlines) {
    for (Vec3 const& p : outline) {
      if (!finite(p)) return std::nullopt;
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  }
  Vec3 const middle = low * 0.5 + high * 0.5, half = high - middle;
  double const largest = std::max(half.x, std::max(half.y, half.z));
  if (!usable_size(largest)) return std::nullopt;
  double const unit = std::exp2(std::ilogb(largest));
  // The normal: of the outline with the largest area, by Newell's sum.
  Vec3 normal(0);
  for (auto const& outline : outlines) {
    Vec3 sum(0);
    for (std::size_t i = 0; i < outline.size(); ++i) {
      Vec3 const a = (outline[i] - outline[0]) / unit;
      Vec3 const b = (outline[(i + 1) % outline.size()] - outline[0]) / unit;
      sum += glm::cross(a, b);
    }
    if (glm::dot(sum, sum) > glm::dot(normal, normal)) normal = sum;
  }
  if (normal == Vec3(0)) return std::nullopt;
  if (glm::dot(normal, outward) < 0) normal = -normal;
  Transform place = y_to(normal);
  std::vector<Polygon::Edge> edges;
  double low_height = infinity, high_height = -infinity; // of the points above `middle`
  for (auto const& outline : outlines) {
    for (std::size_t i = 0; i < outline.size(); ++i) {
      Vec3 const a = place.inverse_linear * ((outline[i] - middle) / unit);
      Vec3 const b = place.inverse_linear * ((outline[(i + 1) % outline.size()] - middle) / unit);
      low_height = std::fmin(low_height, a.y);
      high_height = std::fmax(high_height, a.y);
      edges.push_back({{a.x, a.z}, {b.x, b.z}});
    }
  }
  double const off = (high_height - low_height) * 0.5, height = low_height + off;
  if (off > 0x1p-20 * largest / unit) return std::nullopt;
  place = Transform::translation({0, height, 0})
              .then(place)
              .then(Transform::scaling(Vec3(unit)))
              .then(Transform::translation(middle));
  return PlacedShape{std::make_shared<Polygon>(std::move(edges), inner), place};
}

std::optional<PlacedShape> read_polygon(Parameters& parameters) {
  int const count = parameters.integer("number of points", 3, 1 << 24);
  std::vector<std::vector<Vec3>> outlines(1);
  bool closed = false;
  for (int i = 0; i < count; ++i) {
    if (i > 0 && !parameters.has_value()) {
      parameters.report(Severity::Error, "E0616",
                        "there are fewer points than the number of points says");
      return std::nullopt;
    }
    Vec3 const point = parameters.vec3("point");
    if (closed) outlines.emplace_back();
    auto& outline = outlines.back();
    closed = !outline.empty() && outline.front() == point;
    if (!closed) outline.push_back(point);
  }
  for (auto const& outline : outlines)
    if (!std::all_of(outline.begin(), outline.end(), finite)) {
      parameters.report(Severity::Error, "E0631", "a polygon needs finite points");
      return std::nullopt;
    }
  auto polygon = make_polygon(outlines);
  if (!polygon)
    return left_out(
        parameters, "E0631",
        "a polygon whose points are not in one plane, or all on one line, is not drawn");
  return polygon;
}

} // namespace abbe::geometry
