// SPDX-License-Identifier: MIT
#include "geometry/line_query.hpp"

#include <cmath>

namespace abbe::geometry {

void gather(LineQuery const& query, PrimitiveId primitive, std::uint32_t operand, bool hidden) {
  Placed const& placed = query.primitives[primitive];
  Crossings& crossings = query.scratch.crossings;
  crossings.clear();
  Start start;
  bool starts = false;
  if (query.from != nullptr) {
    // Members are in the order of the arriving ray: what goes through leaves from the last face of
    // the primitive, what comes back from the first.
    for (Departure::On const& on : query.from->on) {
      if (on.primitive != primitive) continue;
      if (starts && !query.from->through) break;
      start = {on.face, on.was_entering == query.from->through};
      starts = true;
    }
  }
  placed.shape().crossings(placed.to_object(query.ray), starts ? &start : nullptr, crossings);
  for (Crossing const& c : crossings) {
    bool const at_start =
        starts ? c.t == 0 : (query.from != nullptr && std::fabs(c.t) <= c.error + c.slack);
    query.scratch.events.push_back({c.t, c.error, c.slack, primitive, operand, c.face, c.entering,
                                    c.toggles, c.visible && !hidden, at_start});
  }
}

} // namespace abbe::geometry
