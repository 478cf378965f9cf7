// SPDX-License-Identifier: MIT
#include "transport/lamps/lamp.hpp"

#include "simd/math.hpp"
#include "simd/native.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::transport {
namespace {

struct FindCosines {
  template <class L>
  static void run(Vectors const& normals, std::size_t count, Aim& out) {
    lane::in_lanes<L>(count, [&]<class Lanes>(std::size_t k) {
      lane::store(out.cosine.value + k,
                  lane::dot(load<Lanes>(normals, k), load<Lanes>(out.direction, k)));
    });
  }
};
simd::Native<FindCosines> const find_cosines;

struct FadeAway {
  template <class L>
  static void run(Aim const& aim, std::size_t count, double distance, double power, double* out) {
    lane::in_lanes<L>(count, [&]<class Lanes>(std::size_t k) {
      Lanes const depth = lane::load<Lanes>(aim.distance.value + k) / Lanes(distance);
      lane::store(out + k, Lanes(2.0) / (Lanes(1.0) + lane::pow(depth, Lanes(power))));
    });
  }
};
simd::Native<FadeAway> const fade_away;

} // namespace

void Lamp::aim(Vectors const& points, Vectors const& normals, std::size_t count, Aim& out) const {
  find_ways(points, count, out);
  find_cosines(normals, count, out);
  out.comes = first_rays(count);
  if (lights_itself()) return;
  for (std::size_t k = 0; k < count; ++k)
    if (out.distance[k] == 0) out.comes &= ~(RaySet{1} << k);
}

bool Lamp::strengths(Aim const& aim, RaySet rays, std::size_t count, double* out) const {
  if (even() && !fades()) return false;
  if (fades())
    fade_away(aim, count, common_.fade_distance, common_.fade_power, out);
  else
    std::fill_n(out, count, 1.0);
  each_of(rays, [&](std::size_t r) {
    double const strength = even() ? out[r] : share(aim, r) * out[r];
    out[r] = std::isfinite(strength) ? strength : 0; // negative distances have no broken powers
  });
  return true;
}

} // namespace abbe::transport
