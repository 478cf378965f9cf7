// SPDX-License-Identifier: MIT
#include "render/fan_interface.hpp"

#include "geometry/lane.hpp"
#include "geometry/registers.hpp"
#include "optics/refract.hpp"

#include <algorithm>

namespace abbe::render {
namespace {

namespace lane = geometry::lane;
using geometry::FanVectors;

template <class L>
lane::Vec<L> load(FanVectors const& v, std::size_t at) {
  return {lane::load<L>(v.x + at), lane::load<L>(v.y + at), lane::load<L>(v.z + at)};
}
template <class L>
void store(FanVectors& to, std::size_t at, lane::Vec<L> const& v) {
  lane::store(to.x + at, v.x);
  lane::store(to.y + at, v.y);
  lane::store(to.z + at, v.z);
}

/// @param Same the index is the same on both sides: nothing bends or returns
template <bool Same, class L>
void meet(FanVectors const& directions, std::size_t count, FanInterface& face) {
  L const zero(0.0), one(1.0);
  for (std::size_t at = 0; at < count; at += 4) {
    lane::Vec<L> const d = load<L>(directions, at);
    lane::Vec<L> n = load<L>(face.normal, at);
    auto const away = zero < lane::dot(d, n);
    n = {lane::select(away, -n.x, n.x), lane::select(away, -n.y, n.y),
         lane::select(away, -n.z, n.z)};
    store(face.normal, at, n);
    L const along = lane::dot(d, n);
    L const cosine = -along;
    L const cos_i = lane::select(cosine < zero, zero, lane::select(one < cosine, one, cosine));
    lane::store(face.cos_i + at, cos_i);
    L const twice = L(2.0) * along;
    lane::Vec<L> const mirrored{d.x - n.x * twice, d.y - n.y * twice, d.z - n.z * twice};
    store(face.mirrored, at, mirrored);
    lane::store(face.below + at, lane::dot(mirrored, n));
    if constexpr (Same) {
      lane::store(face.reflectance + at, zero);
      lane::store(face.transmittance + at, one);
      lane::store(face.total + at, zero);
    } else {
      lane::Vec<L> const cross{d.y * n.z - n.y * d.z, d.z * n.x - n.z * d.x, d.x * n.y - n.x * d.y};
      L const sin2 = lane::dot(cross, cross);
      L const n1 = lane::load<L>(face.n1 + at), n2 = lane::load<L>(face.n2 + at);
      auto const f =
          optics::fresnel<L>(n1, n2, n2 - n1, cos_i, lane::select(sin2 < one, sin2, one));
      lane::store(face.reflectance + at, f.reflectance);
      lane::store(face.transmittance + at, f.transmittance);
      lane::store(face.total + at, lane::select(f.total, one, zero));
      auto const t = optics::refracted<L>(f, {d.x, d.y, d.z}, {n.x, n.y, n.z});
      store(face.refracted, at, lane::Vec<L>{t.x, t.y, t.z});
    }
  }
}

template <class L>
void meet_each(Vec3 const& direction, Vec3 const& normal, double cos_i, SplitLanes const& lanes) {
  L const one(1.0), zero(0.0);
  Vec3 const cross = glm::cross(direction, normal);
  L const sin2(std::min(1.0, glm::dot(cross, cross))), cosine(cos_i);
  optics::Direction<L> const d{L(direction.x), L(direction.y), L(direction.z)};
  optics::Direction<L> const n{L(normal.x), L(normal.y), L(normal.z)};
  for (std::size_t at = 0; at < lanes.count; at += 4) {
    L const n1 = lane::load<L>(lanes.n1 + at), n2 = lane::load<L>(lanes.n2 + at);
    auto const f = optics::fresnel<L>(n1, n2, n2 - n1, cosine, sin2);
    auto const t = optics::refracted<L>(f, d, n);
    lane::store(lanes.reflectance + at, f.reflectance);
    lane::store(lanes.transmittance + at, f.transmittance);
    lane::store(lanes.x + at, t.x);
    lane::store(lanes.y + at, t.y);
    lane::store(lanes.z + at, t.z);
    alignas(32) double total[4];
    lane::store(total, lane::select(f.total, one, zero));
    std::transform(total, total + 4, lanes.total + at, [](double t_) { return t_ != 0; });
  }
}

using Meeter = void (*)(FanVectors const&, std::size_t, FanInterface&);
#if ABBE_HAS_WIDE_LANES
template <bool Same>
ABBE_FOR_AVX2 void meet_wide(FanVectors const& directions, std::size_t count, FanInterface& face) {
  meet<Same, lane::Wide4>(directions, count, face);
}
template <bool Same>
Meeter const meeter = geometry::has_wide_registers() ? meet_wide<Same> : meet<Same, lane::Double4>;
#else
template <bool Same>
Meeter const meeter = meet<Same, lane::Double4>;
#endif

using LaneMeeter = void (*)(Vec3 const&, Vec3 const&, double, SplitLanes const&);
#if ABBE_HAS_WIDE_LANES
ABBE_FOR_AVX2 void meet_each_wide(Vec3 const& direction, Vec3 const& normal, double cos_i,
                                  SplitLanes const& lanes) {
  meet_each<lane::Wide4>(direction, normal, cos_i, lanes);
}
LaneMeeter const lane_meeter =
    geometry::has_wide_registers() ? meet_each_wide : meet_each<lane::Double4>;
#else
LaneMeeter const lane_meeter = meet_each<lane::Double4>;
#endif

template <class L>
void aim(FanVectors const& points, std::size_t count, Vec3 const& at, FanVectors& directions,
         double* distances) {
  lane::Vec<L> const place{L(at.x), L(at.y), L(at.z)};
  for (std::size_t k = 0; k < count; k += 4) {
    lane::Vec<L> const way = place - load<L>(points, k);
    L const distance = lane::sqrt(lane::dot(way, way));
    lane::store(distances + k, distance);
    store(directions, k, lane::Vec<L>{way.x / distance, way.y / distance, way.z / distance});
  }
}
using Aimer = void (*)(FanVectors const&, std::size_t, Vec3 const&, FanVectors&, double*);
#if ABBE_HAS_WIDE_LANES
ABBE_FOR_AVX2 void aim_wide(FanVectors const& points, std::size_t count, Vec3 const& at,
                            FanVectors& directions, double* distances) {
  aim<lane::Wide4>(points, count, at, directions, distances);
}
Aimer const aimer = geometry::has_wide_registers() ? aim_wide : aim<lane::Double4>;
#else
Aimer const aimer = aim<lane::Double4>;
#endif

} // namespace

void aim_fan(FanVectors const& points, std::size_t count, Vec3 const& at, FanVectors& directions,
             double* distances) {
  aimer(points, count, at, directions, distances);
}

void meet_lanes(Vec3 const& direction, Vec3 const& normal, double cos_i, SplitLanes const& lanes) {
  lane_meeter(direction, normal, cos_i, lanes);
}
void meet_fan(FanVectors const& direction, std::size_t count, FanInterface& face) {
  meeter<false>(direction, count, face);
}
void meet_fan_unbent(FanVectors const& direction, std::size_t count, FanInterface& face) {
  meeter<true>(direction, count, face);
}

} // namespace abbe::render
