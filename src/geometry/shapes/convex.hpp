// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/line.hpp"

#include <algorithm>

namespace abbe::geometry {

/// The smallest step along a line: a root that must come after (or before) the start, but was
/// computed not to, is put here. t keeps its sign, the point stays the same.
inline constexpr double just_after = std::numeric_limits<double>::denorm_min();

/// A shape that a line enters once and leaves once, made from its kernel:
///   template <class L> Slice<L> slice(Line<L> const&) const;
///   bool visible(std::uint32_t face) const;
///
/// A start on the surface: the known root is one end of the slice, whichever the departure says,
/// and becomes t == 0; the other end is computed from the line as given, where it does not cancel,
/// and must be on the other side of 0. So a ray that goes inside always comes out again, however
/// grazing.
template <class Derived>
class ConvexShape : public Shape {
public:
  void crossings(Ray const& ray, Start const* start, Crossings& out) const override {
    Slice<double> slice = self().slice(line_of(ray));
    if (start != nullptr) {
      bool const empty = !(slice.in.t <= slice.out.t);
      double const face = start->face;
      if (start->to_inside) {
        slice.in.t = 0;
        slice.in_face = face;
        slice.out.t = empty ? just_after : std::max(slice.out.t, just_after);
      } else {
        slice.out.t = 0;
        slice.out_face = face;
        slice.in.t = empty ? -just_after : std::min(slice.in.t, -just_after);
      }
    }
    if (!(slice.in.t < slice.out.t)) return;
    push(slice.in, slice.in_face, true, out);
    push(slice.out, slice.out_face, false, out);
  }

  bool one_interval() const override { return true; }

private:
  Derived const& self() const { return static_cast<Derived const&>(*this); }
  void push(Root<double> const& root, double face, bool entering, Crossings& out) const {
    if (!(root.t > -infinity && root.t < infinity)) return;
    auto const number = static_cast<std::uint32_t>(face);
    out.push_back({root.t, root.error, root.slack, number, entering, true, self().visible(number)});
  }
};

} // namespace abbe::geometry
