// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/shape.hpp"
#include "simd/lane.hpp"

#include <cstdint>

namespace abbe::geometry {

/// Normals of one shape at points side by side.
template <class L>
struct NormalLanes {
  using Mask = decltype(L() < L());
  lane::Vec<L> smoothed, geometric; ///< the latter of shapes that are smoothed()
  Mask unclear;                     ///< ask the shape for these one by one
};

/// A shape's normals for several points at once, with the bits of Shape::normal.
class NormalKernel {
public:
  virtual ~NormalKernel() = default;
  /// @param faces as many as there are lanes
  virtual void normals(lane::Vec<lane::Double4> const& points, std::uint32_t const* faces,
                       NormalLanes<lane::Double4>& out) const = 0;
#if ABBE_HAS_WIDE_LANES
  virtual void normals(lane::Vec<lane::Wide4> const& points, std::uint32_t const* faces,
                       NormalLanes<lane::Wide4>& out) const = 0;
#endif
};

/// A shape with a kernel, made from its template:
///   template <class L> void normal_lanes(Vec<L> const&, std::uint32_t const*, NormalLanes<L>&)
///   const;  `unclear` is false before
/// @tparam Base Shape or what is made of it
template <class Derived, class Base = Shape>
class WithNormalKernel : public Base, public NormalKernel {
public:
  NormalKernel const* normal_kernel() const override { return this; }
  void normals(lane::Vec<lane::Double4> const& points, std::uint32_t const* faces,
               NormalLanes<lane::Double4>& out) const override {
    find(points, faces, out);
  }
#if ABBE_HAS_WIDE_LANES
  ABBE_FOR_AVX2 void normals(lane::Vec<lane::Wide4> const& points, std::uint32_t const* faces,
                             NormalLanes<lane::Wide4>& out) const override {
    find(points, faces, out);
  }
#endif

private:
  template <class L>
  void find(lane::Vec<L> const& points, std::uint32_t const* faces, NormalLanes<L>& out) const {
    out.unclear = L(0.0) < L(0.0);
    static_cast<Derived const&>(*this).normal_lanes(points, faces, out);
  }
};

template <class L>
lane::Vec<L> cross(lane::Vec<L> const& a, lane::Vec<L> const& b) {
  return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y};
}
/// As glm::normalize.
template <class L>
lane::Vec<L> normalized(lane::Vec<L> const& v) {
  return (L(1.0) / lane::sqrt(lane::dot(v, v))) * v;
}
/// As unit_vector().
/// @param unclear gets those lanes whose vector is zero, not a number, very small or very large
template <class L>
lane::Vec<L> unit_lanes(lane::Vec<L> const& v, typename NormalLanes<L>::Mask& unclear) {
  auto const size = lane::abs(v);
  L const largest = lane::max(size.x, lane::max(size.y, size.z));
  L const sum = size.x + size.y + size.z;
  auto const usable = lane::both(L(0x1p-1000) < largest, sum < L(0x1p1000));
  unclear = lane::either(unclear, lane::negate(usable));
  L const safe = lane::select(usable, largest, L(1.0));
  lane::Vec<L> const even = lane::power_of_two(L(0x1.8p52) - lane::exponent(safe)) * v;
  L const length = lane::sqrt(lane::dot(even, even));
  return {even.x / length, even.y / length, even.z / length};
}

} // namespace abbe::geometry
