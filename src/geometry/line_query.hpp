// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/placed.hpp"
#include "geometry/scratch.hpp"

#include <cmath>

/// One line's question to one solid, and the crossings of single primitives that answer it.
namespace abbe::geometry {

struct LineQuery {
  std::vector<Placed> const& primitives;
  Ray const& ray;
  Departure const* from;
  Scratch& scratch;
  CsgProgram::State* state; ///< of this solid's program; left as found
  /// Passages whose error interval begins after it are not wanted; may shrink while they are taken.
  double const& until;
};

/// The start on the primitive, when the ray has one there. @return false when it has none
bool find_start(Departure const* from, PrimitiveId primitive, Start& start);

/// Crossings are one group when these multiples of their error intervals overlap. So what is not in
/// the group that a ray departs from is further from its start than the errors of both, and which
/// side of the start it is on is certain: a crossing is neither lost nor met twice.
inline constexpr double group_margin = 4;

/// Belongs to the group that the ray departs from? @param starts on the crossing's own primitive
inline bool at_start(LineQuery const& query, bool starts, Crossing const& c) {
  return starts ? c.t == 0 : query.from != nullptr && std::fabs(c.t) <= c.error;
}

/// A broken invariant of the shape unless the error of the crossing is small beside the way to it
/// and the shape; where the line grazes the surface, it may be the root of that. Nothing in release
/// builds.
/// @param ray in object space
void check_error(Shape const& shape, Ray const& ray, Crossing const& c);

/// Appends the crossings of the whole line with one primitive to scratch.events.
/// @param hidden the operand has no surface of its own
void gather(LineQuery const& query, PrimitiveId primitive, std::uint32_t operand, bool hidden);
/// The same, or nothing where the line does not come near the primitive between its start and
/// query.until: there are none that count, then.
void gather_near(LineQuery const& query, PrimitiveId primitive, std::uint32_t operand, bool hidden);

} // namespace abbe::geometry
