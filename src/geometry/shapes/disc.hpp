// SPDX-License-Identifier: MIT
#pragma once

#include "base/parameters.hpp"
#include "geometry/kernels.hpp"
#include "geometry/shapes/convex.hpp"

namespace abbe::geometry {

/** @scene disc { <centre>, <normal>, radius [, hole_radius] }
A flat disc, perhaps with a hole. In boolean operations its inside is the whole half-space behind
the plane of the disc, as for `plane`; its surface is only the ring.

| name | type | unit | default | range |
|---|---|---|---|---|
| centre | vector | length | - | any |
| normal | vector | - | - | 0 is left out with a warning |
| radius | number | length | - | 0 is left out with a warning |
| hole_radius | number | length | 0 | from radius on (a warning), the surface is nowhere |

    disc { <0, 0, 0>, y, 1, 0.5 }
*/
/// Canonical form: about the origin, with its own unit normal and radii. One face, 0.
class Disc final : public ConvexShape<Disc> {
public:
  Disc(Disc const&) = delete;
  Disc(Vec3 const& unit_normal, double radius, double hole)
      : normal_(unit_normal), radius_(radius), hole_(hole) {}
  template <class L>
  Slice<L> slice(Line<L> const& line) const {
    return kernels::half_space(line, lane::Vec<L>{L(normal_.x), L(normal_.y), L(normal_.z)},
                               L(0.0));
  }
  bool visible(std::uint32_t) const { return true; }
  bool ends_visible() const override { return false; } // the hole, and beyond the rim
  bool flat(std::uint32_t) const override { return true; }
  Boundary boundary() const override { return Boundary::Sheet; }
  void crossings(Ray const& ray, Start const* start, Crossings& out) const override;
  EndsKernel const* surface_kernel() const override { return &ring_; }
  bool inside(Vec3 const& point) const override { return glm::dot(normal_, point) <= 0; }
  Vec3 normal(Vec3 const&, std::uint32_t) const override { return normal_; }
  Bounds bounds() const override;

private:
  /// The plane's end where it is on the ring; else nothing.
  class Ring final : public EndsKernel {
  public:
    explicit Ring(Disc const& disc) : disc_(disc) {}
    void ends(Line<double> const& line, Start const* start, Ends<double>& out) const override {
      cut(line, start, out);
    }
    void ends(Line<lane::Double4> const& lines, Start const* start,
              Ends<lane::Double4>& out) const override {
      cut(lines, start, out);
    }
#if ABBE_HAS_WIDE_LANES
    ABBE_FOR_AVX2 void ends(Line<lane::Wide4> const& lines, Start const* start,
                            Ends<lane::Wide4>& out) const override {
      cut(lines, start, out);
    }
    ABBE_FOR_AVX512 void ends(Line<lane::Wide8> const& lines, Start const* start,
                              Ends<lane::Wide8>& out) const override {
      cut(lines, start, out);
    }
#endif
    bool ends_visible() const override {
      return true;
    }

  private:
    template <class L>
    void cut(Line<L> const& line, Start const* start, Ends<L>& out) const {
      disc_.ConvexShape::ends(line, start, out);
      if (start != nullptr) return; // the other end is infinite
      L const far(infinity), t = lane::select(lane::abs(out.in_t) < far, out.in_t, out.out_t);
      out.in_t = lane::select(disc_.on_ring(line, t), out.in_t, out.out_t);
    }
    Disc const& disc_;
  };
  template <class L>
  auto on_ring(Line<L> const& line, L const& t) const {
    lane::Vec<L> const at = line.origin + t * line.direction;
    L const square = lane::dot(at, at);
    auto const within = lane::both(L(hole_ * hole_) <= square, square <= L(radius_ * radius_));
    return lane::both(within, L(hole_) < L(radius_));
  }

  Vec3 normal_;
  double radius_, hole_;
  Ring ring_{*this};
};

std::optional<PlacedShape> make_disc(Vec3 const& centre, Vec3 const& normal, double radius,
                                     double hole);
std::optional<PlacedShape> read_disc(Parameters& parameters);

} // namespace abbe::geometry
