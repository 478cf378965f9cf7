// SPDX-License-Identifier: MIT
#include "render/fan_interface.hpp"

#include "optics/refract.hpp"
#include "simd/native.hpp"

#include <algorithm>

namespace abbe::render {
namespace {

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
void meet_at(FanVectors const& directions, FanInterface& face, std::size_t at) {
  L const zero(0.0), one(1.0);
  lane::Vec<L> const d = load<L>(directions, at);
  lane::Vec<L> n = load<L>(face.normal, at);
  auto const away = zero < lane::dot(d, n);
  n = {lane::select(away, -n.x, n.x), lane::select(away, -n.y, n.y), lane::select(away, -n.z, n.z)};
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
    auto const f = optics::fresnel<L>(n1, n2, n2 - n1, cos_i, lane::select(sin2 < one, sin2, one));
    lane::store(face.reflectance + at, f.reflectance);
    lane::store(face.transmittance + at, f.transmittance);
    lane::store(face.total + at, lane::select(f.total, one, zero));
    auto const t = optics::refracted<L>(f, {d.x, d.y, d.z}, {n.x, n.y, n.z});
    store(face.refracted, at, lane::Vec<L>{t.x, t.y, t.z});
  }
}
template <bool Same>
struct Meet {
  template <class L>
  static void run(FanVectors const& directions, std::size_t count, FanInterface& face) {
    lane::in_lanes<L>(
        count, [&]<class Lanes>(std::size_t at) { meet_at<Same, Lanes>(directions, face, at); });
  }
};

struct MeetEach {
  template <class L>
  static void run(Vec3 const& direction, Vec3 const& normal, double cos_i,
                  SplitLanes const& lanes) {
    Vec3 const cross = glm::cross(direction, normal);
    double const sin2 = std::min(1.0, glm::dot(cross, cross));
    lane::in_lanes<L>(lanes.count, [&]<class Lanes>(std::size_t at) {
      auto const all = [](Vec3 const& v) {
        return optics::Direction<Lanes>{Lanes(v.x), Lanes(v.y), Lanes(v.z)};
      };
      auto const n1 = lane::load<Lanes>(lanes.n1 + at), n2 = lane::load<Lanes>(lanes.n2 + at);
      auto const f = optics::fresnel<Lanes>(n1, n2, n2 - n1, Lanes(cos_i), Lanes(sin2));
      auto const t = optics::refracted<Lanes>(f, all(direction), all(normal));
      lane::store(lanes.reflectance + at, f.reflectance);
      lane::store(lanes.transmittance + at, f.transmittance);
      lane::store(lanes.x + at, t.x);
      lane::store(lanes.y + at, t.y);
      lane::store(lanes.z + at, t.z);
      constexpr std::size_t width = lane::width<Lanes>;
      alignas(64) double total[width];
      lane::store(total, lane::select(f.total, Lanes(1.0), Lanes(0.0)));
      std::transform(total, total + width, lanes.total + at, [](double t_) { return t_ != 0; });
    });
  }
};

simd::Native<Meet<true>> const meet_same;
simd::Native<Meet<false>> const meet_other;
simd::Native<MeetEach, 4> const meet_each;

} // namespace

void meet_lanes(Vec3 const& direction, Vec3 const& normal, double cos_i, SplitLanes const& lanes) {
  meet_each(direction, normal, cos_i, lanes);
}
void meet_fan(FanVectors const& direction, std::size_t count, FanInterface& face) {
  meet_other(direction, count, face);
}
void meet_fan_unbent(FanVectors const& direction, std::size_t count, FanInterface& face) {
  meet_same(direction, count, face);
}

} // namespace abbe::render
