// SPDX-License-Identifier: MIT
#include "render/fan_interface.hpp"

#include "geometry/lane.hpp"
#include "optics/refract.hpp"

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

template <class L>
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
    lane::Vec<L> const cross{d.y * n.z - n.y * d.z, d.z * n.x - n.z * d.x, d.x * n.y - n.x * d.y};
    L const sin2 = lane::dot(cross, cross);
    L const n1 = lane::load<L>(face.n1 + at), n2 = lane::load<L>(face.n2 + at);
    auto const f = optics::fresnel<L>(n1, n2, n2 - n1, cos_i, lane::select(sin2 < one, sin2, one));
    lane::store(face.cos_i + at, cos_i);
    lane::store(face.reflectance + at, f.reflectance);
    lane::store(face.transmittance + at, f.transmittance);
    lane::store(face.total + at, lane::select(f.total, one, zero));
    L const twice = L(2.0) * along;
    lane::Vec<L> const mirrored{d.x - n.x * twice, d.y - n.y * twice, d.z - n.z * twice};
    store(face.mirrored, at, mirrored);
    lane::store(face.below + at, lane::dot(mirrored, n));
    auto const t = optics::refracted<L>(f, {d.x, d.y, d.z}, {n.x, n.y, n.z});
    store(face.refracted, at, lane::Vec<L>{t.x, t.y, t.z});
  }
}

using Meeter = void (*)(FanVectors const&, std::size_t, FanInterface&);
#if ABBE_HAS_WIDE_LANES
ABBE_FOR_AVX2 void meet_wide(FanVectors const& directions, std::size_t count, FanInterface& face) {
  meet<lane::Wide4>(directions, count, face);
}
Meeter const meeter = __builtin_cpu_supports("avx2") ? meet_wide : meet<lane::Double4>;
#else
Meeter const meeter = meet<lane::Double4>;
#endif

} // namespace

void meet_fan(FanVectors const& direction, std::size_t count, FanInterface& face) {
  meeter(direction, count, face);
}

} // namespace abbe::render
