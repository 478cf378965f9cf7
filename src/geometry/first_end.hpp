// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/shapes/convex.hpp"

/// What World::closest wants to know of a convex shape, for any lane type.
namespace abbe::geometry {

/// The first end after the start, where there is one (`valid`).
template <class L>
struct FirstEnd {
  using Mask = decltype(L() < L());
  Mask valid, enters;
  L t, error, face;
};
/// @param among_others the line starts on a surface, but not on this shape's: what is at the start
/// within its error is part of what it departs from
template <class L>
FirstEnd<L> first_end(Ends<L> const& ends, bool among_others) {
  L const zero(0.0), far(infinity);
  auto const crossed = ends.in_t < ends.out_t;
  auto const ahead = [&](L const& t, L const& error) {
    auto const after = lane::both(zero < t, t < far);
    return among_others ? lane::both(after, lane::negate(t <= error)) : after;
  };
  auto const enters = lane::both(crossed, ahead(ends.in_t, ends.in_error));
  auto const valid = lane::either(enters, lane::both(crossed, ahead(ends.out_t, ends.out_error)));
  return {valid, enters, lane::select(enters, ends.in_t, ends.out_t),
          lane::select(enters, ends.in_error, ends.out_error),
          lane::select(enters, ends.in_face, ends.out_face)};
}

} // namespace abbe::geometry
