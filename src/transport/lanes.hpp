// SPDX-License-Identifier: MIT
#pragma once

#include "base/vec.hpp"
#include "geometry/batch.hpp"
#include "simd/lane.hpp"

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

/// Values of some rays side by side. Kernels compute whole lanes: what is computed of places that
/// have no meaning is left unread.
namespace abbe::transport {

namespace lane = simd;

/// Rays that are worked on together, at most.
inline constexpr std::size_t chunk_width = 64;

/// Some of the rays, a bit each.
using RaySet = std::uint64_t;
inline RaySet first_rays(std::size_t count) {
  return ~RaySet{0} >> (64 - count);
}
/// visit(r) for each ray of a set, in order.
template <class Visit>
void each_of(RaySet rays, Visit&& visit) {
  for (; rays != 0; rays &= rays - 1) visit(static_cast<std::size_t>(std::countr_zero(rays)));
}

/// A value a ray.
struct Values {
  alignas(64) double value[chunk_width];
  double& operator[](std::size_t k) { return value[k]; }
  double operator[](std::size_t k) const { return value[k]; }
};

/// A vector a ray, component by component.
struct Vectors {
  alignas(64) double x[chunk_width];
  alignas(64) double y[chunk_width];
  alignas(64) double z[chunk_width];
  Vec3 get(std::size_t k) const { return {x[k], y[k], z[k]}; }
  void set(std::size_t k, Vec3 const& v) {
    x[k] = v.x;
    y[k] = v.y;
    z[k] = v.z;
  }
  geometry::VectorArrays arrays() { return {x, y, z}; }
};

template <class L>
lane::Vec<L> load(Vectors const& v, std::size_t at) {
  return {lane::load<L>(v.x + at), lane::load<L>(v.y + at), lane::load<L>(v.z + at)};
}
template <class L>
void store(Vectors& to, std::size_t at, lane::Vec<L> const& v) {
  lane::store(to.x + at, v.x);
  lane::store(to.y + at, v.y);
  lane::store(to.z + at, v.z);
}
/// The same vector in every lane.
template <class L>
lane::Vec<L> all(Vec3 const& v) {
  return {L(v.x), L(v.y), L(v.z)};
}

/// Is there light at all? What has none is not even cut.
inline bool any_but_zero(double const* values, std::size_t n) {
  for (std::size_t k = 0; k < n; ++k)
    if (values[k] != 0) return true;
  return false;
}
/// By their sizes: pigments with a transmit below 0 take light away.
inline bool any_above(double const* values, std::size_t n, double threshold) {
  for (std::size_t k = 0; k < n; ++k)
    if (std::fabs(values[k]) > threshold) return true;
  return false;
}

} // namespace abbe::transport
