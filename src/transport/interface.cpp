// SPDX-License-Identifier: MIT
#include "transport/interface.hpp"

#include "optics/refract.hpp"
#include "simd/native.hpp"

#include <algorithm>

namespace abbe::transport {
namespace {

template <class L>
lane::Vec<L> turned(lane::Vec<L> const& v, decltype(L() < L()) const& back) {
  return {lane::select(back, -v.x, v.x), lane::select(back, -v.y, v.y),
          lane::select(back, -v.z, v.z)};
}

template <bool Smoothed>
struct Face {
  template <class L>
  static void run(Chunk& chunk) {
    lane::in_lanes<L>(chunk.count, [&]<class Lanes>(std::size_t at) {
      Lanes const zero(0.0), one(1.0);
      lane::Vec<Lanes> const d = load<Lanes>(chunk.direction, at);
      lane::Vec<Lanes> g = load<Lanes>(chunk.geometric, at), n = g;
      g = turned(g, zero < lane::dot(d, g));
      if constexpr (Smoothed) {
        n = load<Lanes>(chunk.normal, at);
        // Corner normals need not agree with the winding of their face.
        n = turned(n, lane::dot(n, g) < zero);
        // A smoothed normal may lean away from the viewer.
        auto const away = zero <= lane::dot(d, n);
        n = {lane::select(away, g.x, n.x), lane::select(away, g.y, n.y),
             lane::select(away, g.z, n.z)};
      } else {
        n = g;
      }
      store(chunk.geometric, at, g);
      store(chunk.normal, at, n);
      Lanes const along = lane::dot(d, n), cosine = -along;
      lane::store(chunk.cos_i.value + at,
                  lane::select(cosine < zero, zero, lane::select(one < cosine, one, cosine)));
      Lanes const twice = Lanes(2.0) * along;
      lane::Vec<Lanes> m{d.x - n.x * twice, d.y - n.y * twice, d.z - n.z * twice};
      Lanes const below = lane::dot(m, g);
      auto const through = below < zero;
      if (!lane::none(through)) {
        // A smoothed normal must not send it through the surface.
        Lanes const up = Lanes(2.0) * below;
        lane::Vec<Lanes> const lifted{m.x - g.x * up, m.y - g.y * up, m.z - g.z * up};
        Lanes const scale = one / lane::sqrt(lane::dot(lifted, lifted));
        m = {lane::select(through, lifted.x * scale, m.x),
             lane::select(through, lifted.y * scale, m.y),
             lane::select(through, lifted.z * scale, m.z)};
      }
      store(chunk.mirrored, at, m);
    });
  }
};

template <class L>
L sin2_of(lane::Vec<L> const& d, lane::Vec<L> const& n) {
  lane::Vec<L> const cross{d.y * n.z - n.y * d.z, d.z * n.x - n.z * d.x, d.x * n.y - n.x * d.y};
  L const sin2 = lane::dot(cross, cross);
  return lane::select(sin2 < L(1.0), sin2, L(1.0));
}

struct Refract {
  template <class L>
  static void run(Chunk& chunk, double* total) {
    lane::in_lanes<L>(chunk.count, [&]<class Lanes>(std::size_t at) {
      lane::Vec<Lanes> const d = load<Lanes>(chunk.direction, at),
                             n = load<Lanes>(chunk.normal, at);
      Lanes const n1 = lane::load<Lanes>(chunk.n1.value + at),
                  n2 = lane::load<Lanes>(chunk.n2.value + at);
      auto const f = optics::fresnel<Lanes>(
          n1, n2, n2 - n1, lane::load<Lanes>(chunk.cos_i.value + at), sin2_of(d, n));
      lane::store(chunk.reflectance.value + at, f.reflectance);
      lane::store(chunk.transmittance.value + at, f.transmittance);
      lane::store(total + at, lane::select(f.total, Lanes(1.0), Lanes(0.0)));
      auto const t = optics::refracted<Lanes>(f, {d.x, d.y, d.z}, {n.x, n.y, n.z});
      store(chunk.refracted, at, lane::Vec<Lanes>{t.x, t.y, t.z});
    });
  }
};

/// What the wavelengths of one ray have in common.
struct SplitRay {
  Vec3 direction, normal;
  double cos_i, sin2_i;
  std::size_t count;
  double const *n1, *n2;
};
struct RefractEach {
  template <class L>
  static void run(SplitRay const& ray, SplitLanes const& out) {
    lane::in_lanes<L>(ray.count, [&]<class Lanes>(std::size_t at) {
      auto const same = [](Vec3 const& v) {
        return optics::Direction<Lanes>{Lanes(v.x), Lanes(v.y), Lanes(v.z)};
      };
      auto const n1 = lane::load<Lanes>(ray.n1 + at), n2 = lane::load<Lanes>(ray.n2 + at);
      auto const f = optics::fresnel<Lanes>(n1, n2, n2 - n1, Lanes(ray.cos_i), Lanes(ray.sin2_i));
      auto const t = optics::refracted<Lanes>(f, same(ray.direction), same(ray.normal));
      lane::store(out.reflectance + at, f.reflectance);
      lane::store(out.transmittance + at, f.transmittance);
      lane::store(out.x + at, t.x);
      lane::store(out.y + at, t.y);
      lane::store(out.z + at, t.z);
      constexpr std::size_t width = lane::width<Lanes>;
      alignas(64) double total[width];
      lane::store(total, lane::select(f.total, Lanes(1.0), Lanes(0.0)));
      std::transform(total, total + width, out.total + at, [](double is) { return is != 0; });
    });
  }
};

simd::Native<Face<false>> const face_flat;
simd::Native<Face<true>> const face_smoothed;
simd::Native<Refract> const refract;
simd::Native<RefractEach, 4> const refract_each;

} // namespace

void face_rays(Chunk& chunk, bool smoothed) {
  if (smoothed)
    face_smoothed(chunk);
  else
    face_flat(chunk);
}

void refract_rays(Chunk& chunk) {
  alignas(64) double total[chunk_width];
  refract(chunk, total);
  chunk.total = 0;
  for (std::size_t r = 0; r < chunk.count; ++r) chunk.total |= RaySet{total[r] != 0} << r;
}

void refract_lanes(Chunk const& chunk, std::size_t r, double const* n1, double const* n2,
                   SplitLanes const& out) {
  Vec3 const d = chunk.direction.get(r), n = chunk.normal.get(r);
  double const sin2 = sin2_of<double>({d.x, d.y, d.z}, {n.x, n.y, n.z});
  refract_each({d, n, chunk.cos_i[r], sin2, chunk.each, n1, n2}, out);
}

} // namespace abbe::transport
