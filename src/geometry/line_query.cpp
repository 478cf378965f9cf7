// SPDX-License-Identifier: MIT
#include "geometry/line_query.hpp"

#include "base/result.hpp"
#include "geometry/shapes/reading.hpp"

#include <cmath>

namespace abbe::geometry {

#ifdef NDEBUG
void check_error(Shape const&, Ray const&, Crossing const&) {}
#else
void check_error(Shape const& shape, Ray const& ray, Crossing const& c) {
  constexpr double few_digits = 0x1p-16, graze = 0x1p-4;
  Vec3 const point = ray.origin + c.t * ray.direction;
  Bounds const bounds = shape.bounds();
  double const speed = vector_length(ray.direction),
               across = std::fabs(glm::dot(shape.geometric_normal(point, c.face), ray.direction)),
               size =
                   bounds.infinite ? vector_length(point) : vector_length(bounds.high - bounds.low),
               way = vector_length(ray.origin) + std::fabs(c.t) * speed;
  double const rounding =
      vector_length(ray.origin_rounding) + std::fabs(c.t) * vector_length(ray.direction_rounding);
  double const most = few_digits * (way + size) + 1024 * rounding;
  ABBE_ASSERT(across <= graze * speed || !std::isfinite(way) || c.error * speed <= most);
}
#endif

bool find_start(Departure const* from, PrimitiveId primitive, Start& start) {
  bool starts = false;
  if (from == nullptr) return false;
  // Members are in the order of the arriving ray: what goes through leaves from the last face of
  // the primitive, what comes back from the first.
  for (Departure::On const& on : from->on) {
    if (on.primitive != primitive) continue;
    if (starts && !from->through) break;
    start = {on.face, on.was_entering == from->through};
    starts = true;
  }
  return starts;
}

namespace {

void gather_all(LineQuery const& query, PrimitiveId primitive, std::uint32_t operand, bool hidden,
                Start const* start) {
  Placed const& placed = query.primitives[primitive];
  Crossings& crossings = query.scratch.crossings;
  crossings.clear();
  Ray const ray = placed.to_object(query.ray);
  placed.shape().crossings(ray, start, crossings);
  for (Crossing const& c : crossings) {
    check_error(placed.shape(), ray, c);
    query.scratch.events.push_back({c.t, group_margin * c.error, primitive, operand, c.face,
                                    c.entering, c.toggles, c.visible && !hidden,
                                    at_start(query, start != nullptr, c)});
  }
}

} // namespace

void gather(LineQuery const& query, PrimitiveId primitive, std::uint32_t operand, bool hidden) {
  Start start;
  bool const starts = find_start(query.from, primitive, start);
  gather_all(query, primitive, operand, hidden, starts ? &start : nullptr);
}

void gather_near(LineQuery const& query, PrimitiveId primitive, std::uint32_t operand,
                 bool hidden) {
  Start start;
  bool const starts = find_start(query.from, primitive, start);
  if (!starts && query.primitives[primitive].misses(query.ray, query.until)) return;
  gather_all(query, primitive, operand, hidden, starts ? &start : nullptr);
}

} // namespace abbe::geometry
