// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/line.hpp"

#include <algorithm>

namespace abbe::geometry {

/// The smallest step along a line: a root that must come after (or before) the start, but was
/// computed not to, is put here. t keeps its sign, the point stays the same.
inline constexpr double just_after = std::numeric_limits<double>::denorm_min();

/// Where lines go into a convex shape and out of it. There is nothing where not in_t < out_t; an
/// end may be infinite.
template <class L>
struct Ends {
  L in_t, in_error, out_t, out_error, in_face, out_face;
};

/// A convex shape's ends for one line or several at once: crossings() without its lists.
class EndsKernel {
public:
  virtual ~EndsKernel() = default;
  /// The bits of crossings(), lane by lane. Line::slack is not looked at.
  /// @param start of all of the lines; null: on none of the shape's faces
  virtual void ends(Line<double> const& line, Start const* start, Ends<double>& out) const = 0;
  virtual void ends(Line<lane::Double4> const& lines, Start const* start,
                    Ends<lane::Double4>& out) const = 0;
#if ABBE_HAS_WIDE_LANES
  virtual void ends(Line<lane::Wide4> const& lines, Start const* start,
                    Ends<lane::Wide4>& out) const = 0;
  virtual void ends(Line<lane::Wide8> const& lines, Start const* start,
                    Ends<lane::Wide8>& out) const = 0;
#endif
  /// Both ends are there to be seen: crossings() are these, and nothing else.
  virtual bool ends_visible() const = 0;
};

/// A start on the surface: the known root is one end, whichever the departure says, and becomes
/// t == 0; the other end is computed from the line as given, where it does not cancel, and must be
/// on the other side of 0. So a ray that goes inside always comes out again, however grazing.
template <class L>
void impose(Start const& start, Ends<L>& ends) {
  L const zero(0.0), face(start.face), beside(just_after);
  auto const empty = lane::negate(ends.in_t <= ends.out_t);
  if (start.to_inside) {
    ends.in_t = zero;
    ends.in_face = face;
    ends.out_t = lane::select(empty, beside, lane::max(ends.out_t, beside));
  } else {
    ends.out_t = zero;
    ends.out_face = face;
    ends.in_t = lane::select(empty, -beside, lane::min(ends.in_t, -beside));
  }
}

/// A shape that a line enters once and leaves once, made from its kernel:
///   template <class L> Slice<L> slice(Line<L> const&) const;
///   bool visible(std::uint32_t face) const;
///   bool ends_visible() const;  of EndsKernel
template <class Derived>
class ConvexShape : public Shape, public EndsKernel {
public:
  void crossings(Ray const& ray, Start const* start, Crossings& out) const override {
    Ends<double> const ends = ends_of(line_of(ray), start);
    if (!(ends.in_t < ends.out_t)) return;
    push(ends.in_t, ends.in_error, ends.in_face, true, out);
    push(ends.out_t, ends.out_error, ends.out_face, false, out);
  }

  bool one_interval() const override { return true; }
  EndsKernel const* ends_kernel() const override { return this; }
  void ends(Line<double> const& line, Start const* start, Ends<double>& out) const override {
    out = ends_of(line, start);
  }
  void ends(Line<lane::Double4> const& lines, Start const* start,
            Ends<lane::Double4>& out) const override {
    out = ends_of(lines, start);
  }
#if ABBE_HAS_WIDE_LANES
  ABBE_FOR_AVX2 void ends(Line<lane::Wide4> const& lines, Start const* start,
                          Ends<lane::Wide4>& out) const override {
    out = ends_of(lines, start);
  }
  ABBE_FOR_AVX512 void ends(Line<lane::Wide8> const& lines, Start const* start,
                            Ends<lane::Wide8>& out) const override {
    out = ends_of(lines, start);
  }
#endif

private:
  Derived const& self() const {
    return static_cast<Derived const&>(*this);
  }
  template <class L>
  Ends<L> ends_of(Line<L> const& line, Start const* start) const {
    Slice<L> const slice = self().slice(line);
    Ends<L> ends{slice.in.t,      slice.in.error, slice.out.t,
                 slice.out.error, slice.in_face,  slice.out_face};
    if (start != nullptr) impose(*start, ends);
    return ends;
  }
  void push(double t, double error, double face, bool entering, Crossings& out) const {
    if (!(t > -infinity && t < infinity)) return;
    auto const number = static_cast<std::uint32_t>(face);
    out.push_back({t, error, 0, number, entering, true, self().visible(number)});
  }
};

} // namespace abbe::geometry
