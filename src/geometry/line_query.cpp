// SPDX-License-Identifier: MIT
#include "geometry/line_query.hpp"

namespace abbe::geometry {

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
  placed.shape().crossings(placed.to_object(query.ray), start, crossings);
  for (Crossing const& c : crossings) {
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
