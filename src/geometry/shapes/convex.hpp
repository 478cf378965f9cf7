// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/line.hpp"

#include <algorithm>

namespace abbe::geometry {

/// The smallest step along a line: a root that must come after (or before) the start, but was
/// computed not to, is put here. t keeps its sign, the point stays the same.
inline constexpr double just_after = std::numeric_limits<double>::denorm_min();

/// What convex shapes can do for four lines at once (see World::closest_fan).
class FourSlices {
public:
  virtual ~FourSlices() = default;
  /// The bits of crossings() without a start, lane by lane.
  virtual void slices(Line<lane::Double4> const& lines, Slice<lane::Double4>& out) const = 0;
#if ABBE_HAS_WIDE_LANES
  virtual void slices(Line<lane::Wide4> const& lines, Slice<lane::Wide4>& out) const = 0;
#endif
  /// Both ends of every slice are there to be seen: crossings() are these, and nothing else.
  virtual bool ends_visible() const = 0;
  /// The face has one normal.
  virtual bool flat(std::uint32_t face) const = 0;
};

/// A start on the surface: the known root is one end of the slice, whichever the departure says,
/// and becomes t == 0; the other end is computed from the line as given, where it does not cancel,
/// and must be on the other side of 0. So a ray that goes inside always comes out again, however
/// grazing.
inline void impose(Start const& start, Slice<double>& slice) {
  bool const empty = !(slice.in.t <= slice.out.t);
  double const face = start.face;
  if (start.to_inside) {
    slice.in.t = 0;
    slice.in_face = face;
    slice.out.t = empty ? just_after : std::max(slice.out.t, just_after);
  } else {
    slice.out.t = 0;
    slice.out_face = face;
    slice.in.t = empty ? -just_after : std::min(slice.in.t, -just_after);
  }
}

/// A shape that a line enters once and leaves once, made from its kernel:
///   template <class L> Slice<L> slice(Line<L> const&) const;
///   bool visible(std::uint32_t face) const;
///   bool ends_visible() const; bool flat(std::uint32_t face) const;  of FourSlices
template <class Derived>
class ConvexShape : public Shape, public FourSlices {
public:
  void crossings(Ray const& ray, Start const* start, Crossings& out) const override {
    Slice<double> slice = self().slice(line_of(ray));
    if (start != nullptr) impose(*start, slice);
    if (!(slice.in.t < slice.out.t)) return;
    push(slice.in, slice.in_face, true, out);
    push(slice.out, slice.out_face, false, out);
  }

  bool one_interval() const override { return true; }
  void slices(Line<lane::Double4> const& lines, Slice<lane::Double4>& out) const override {
    out = self().slice(lines);
  }
#if ABBE_HAS_WIDE_LANES
  ABBE_FOR_AVX2 void slices(Line<lane::Wide4> const& lines,
                            Slice<lane::Wide4>& out) const override {
    out = self().slice(lines);
  }
#endif

private:
  Derived const& self() const {
    return static_cast<Derived const&>(*this);
  }
  void push(Root<double> const& root, double face, bool entering, Crossings& out) const {
    if (!(root.t > -infinity && root.t < infinity)) return;
    auto const number = static_cast<std::uint32_t>(face);
    out.push_back({root.t, root.error, root.slack, number, entering, true, self().visible(number)});
  }
};

} // namespace abbe::geometry
