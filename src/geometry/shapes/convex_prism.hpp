// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/kernels.hpp"
#include "geometry/shapes/convex.hpp"

#include <vector>

namespace abbe::geometry {

/// A prism over one convex polygon: the part that its half-planes and the slab between its lids
/// have in common. The same solid and the same faces as Prism, several times as fast and with a
/// kernel.
///
/// Canonical form and faces: those of Prism.
class ConvexPrism final : public ConvexShape<ConvexPrism> {
public:
  /// Corners on or to the inner side of every edge, in either sense of turning.
  /// @param corners closed; the first is not repeated
  static bool is_convex(std::vector<Vec2> const& corners);
  /// @param corners is_convex
  ConvexPrism(std::vector<Vec2> const& corners, bool open);

  template <class L>
  Slice<L> slice(Line<L> const& line) const;
  bool visible(std::uint32_t face) const { return !open_ || face >= 2; }
  bool ends_visible() const override { return !open_; }
  Boundary boundary() const override { return open_ ? Boundary::Open : Boundary::Whole; }
  bool flat(std::uint32_t) const override { return true; }
  bool inside(Vec3 const& point) const override;
  Vec3 normal(Vec3 const& point, std::uint32_t face) const override;
  Bounds bounds() const override;

private:
  struct Edge {
    Vec2 from;
    Vec2 size;    ///< largest absolute coordinates of its ends
    Vec2 outward; ///< not of unit length
  };
  std::vector<Edge> edges_;
  Vec2 low_, high_;
  bool open_;
};

template <class L>
Slice<L> ConvexPrism::slice(Line<L> const& line) const {
  L const zero(0.0), far(infinity);
  L const vx = line.direction.x, vz = line.direction.z;
  L const length2 = vx * vx + vz * vz;
  L const shift =
      lane::select(length2 == zero, zero, -(line.origin.x * vx + line.origin.z * vz) / length2);
  Approach<L> const near = approach(line, shift);

  /// An end of what is in all half-planes so far, and the edge that it is on.
  struct End {
    L step, speed, nx, nz, size_x, size_z, face;
  };
  End in{-far, zero, zero, zero, zero, zero, zero}, out = in;
  out.step = far;
  auto const take = [](auto const& mask, End const& a, End& b) {
    b = {lane::select(mask, a.step, b.step),     lane::select(mask, a.speed, b.speed),
         lane::select(mask, a.nx, b.nx),         lane::select(mask, a.nz, b.nz),
         lane::select(mask, a.size_x, b.size_x), lane::select(mask, a.size_z, b.size_z),
         lane::select(mask, a.face, b.face)};
  };
  double face = 2;
  for (Edge const& edge : edges_) {
    L const nx(edge.outward.x), nz(edge.outward.y);
    L const height = nx * (L(edge.from.x) - near.point.x) + nz * (L(edge.from.y) - near.point.z);
    L const speed = nx * vx + nz * vz;
    End const here{height / speed, speed, nx, nz, L(edge.size.x), L(edge.size.y), L(face)};
    take(lane::both(speed < zero, in.step < here.step), here, in);
    take(lane::both(zero < speed, here.step < out.step), here, out);
    // Along the edge and outside of it: nothing is in common.
    auto const beside = lane::both(speed == zero, height < zero);
    in.step = lane::select(beside, far, in.step);
    out.step = lane::select(beside, -far, out.step);
    face += 1;
  }
  auto const root = [&](End const& end) {
    L const speed = lane::abs(end.speed), size = lane::abs(end.step);
    L const mx = near.rounding.x + size * line.direction_rounding.x
                 + L(gamma_bound(8)) * (end.size_x + lane::abs(near.point.x));
    L const mz = near.rounding.z + size * line.direction_rounding.z
                 + L(gamma_bound(8)) * (end.size_z + lane::abs(near.point.z));
    L const nx = lane::abs(end.nx), nz = lane::abs(end.nz);
    L const t = near.t + end.step;
    auto const none = end.speed == zero;
    return Root<L>{
        t,
        lane::select(none, zero,
                     (nx * mx + nz * mz) / speed + L(gamma_bound(4)) * (lane::abs(t) + size)),
        lane::select(none, zero, (nx * line.slack.x + nz * line.slack.z) / speed)};
  };
  Slice<L> const lids = kernels::slab(line.origin.y, line.direction.y, line.origin_rounding.y,
                                      line.direction_rounding.y, line.slack.y, zero);
  return common(Slice<L>{root(in), root(out), in.face, out.face}, lids);
}

} // namespace abbe::geometry
