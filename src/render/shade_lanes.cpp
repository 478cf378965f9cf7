// SPDX-License-Identifier: MIT
#include "render/shade_lanes.hpp"

#include "simd/native.hpp"

namespace abbe::render {
namespace {

using geometry::FanVectors;

template <class L>
lane::Vec<L> load(FanVectors const& v, std::size_t at) {
  return {lane::load<L>(v.x + at), lane::load<L>(v.y + at), lane::load<L>(v.z + at)};
}
template <class L>
lane::Vec<L> all(Vec3 const& v) {
  return {L(v.x), L(v.y), L(v.z)};
}

template <class L>
struct FourOf {
  using Type = L;
};
#if ABBE_HAS_WIDE_LANES
template <>
struct FourOf<lane::Wide8> {
  using Type = lane::Wide4;
};
#endif

/// work.operator()<Lanes>(k, of_ray, of_channel) for all lanes from k on; of_ray(values) are those
/// of a value a ray. Nothing beyond the last is touched, but lanes of the next ray may be, before
/// it comes to them.
template <class L, class Work>
void in_rays(ShadedLanes const& lanes, Work const& work) {
  std::size_t const each = lanes.each, all = lanes.rays * each;
  if (each == 1) {
    auto const at = [&]<class Lanes>(std::size_t k) {
      work.template operator()<Lanes>(
          k, [k](double const* values) { return lane::load<Lanes>(values + k); },
          [k](ChannelValues const& own) {
            return own.same ? Lanes(*own.values) : lane::load<Lanes>(own.values + k);
          });
    };
    std::size_t k = 0;
    for (; k + lane::width<L> <= all; k += lane::width<L>) at.template operator()<L>(k);
    for (; k < all; ++k) at.template operator()<double>(k);
    return;
  }
  for (std::size_t ray = 0, first = 0; ray < lanes.rays; ++ray, first += each) {
    auto const at = [&]<class Lanes>(std::size_t c) {
      work.template operator()<Lanes>(
          first + c, [ray](double const* values) { return Lanes(values[ray]); },
          [&](ChannelValues const& own) {
            return lane::load<Lanes>(own.values + (own.same ? 0 : first) + c);
          });
      return c + lane::width<Lanes>;
    };
    for (std::size_t c = 0; c < each;) {
      std::size_t const room = all - first - c;
      if (each - c > 4 && room >= lane::width<L>)
        c = at.template operator()<L>(c);
      else if (room >= 4)
        c = at.template operator()<typename FourOf<L>::Type>(c);
      else
        c = at.template operator()<double>(c);
    }
  }
}

struct AimAt {
  template <class L>
  static void run(CompiledLight const& light, FanVectors const& points, FanVectors const& normals,
                  std::size_t count, Aim& out) {
    bool const parallel = light.kind == scene::Light::Kind::Parallel;
    lane::in_lanes<L>(count, [&]<class Lanes>(std::size_t k) {
      lane::Vec<Lanes> const point = load<Lanes>(points, k), place = all<Lanes>(light.position);
      lane::Vec<Lanes> direction;
      Lanes distance;
      if (parallel) {
        distance = lane::dot(point - place, all<Lanes>(light.direction));
        direction = all<Lanes>(-light.direction);
      } else {
        lane::Vec<Lanes> const way = place - point;
        distance = lane::sqrt(lane::dot(way, way));
        direction = {way.x / distance, way.y / distance, way.z / distance};
      }
      lane::store(out.distance + k, distance);
      lane::store(out.direction.x + k, direction.x);
      lane::store(out.direction.y + k, direction.y);
      lane::store(out.direction.z + k, direction.z);
      lane::store(out.cosine + k, lane::dot(load<Lanes>(normals, k), direction));
    });
  }
};

struct LightSurfaces {
  template <class L>
  static void run(LitQuery const& query, std::size_t count, LitSurface& out) {
    lane::in_lanes<L>(count, [&]<class Lanes>(std::size_t k) {
      Lanes const zero(0.0);
      Lanes const cosine = lane::load<Lanes>(query.aim->cosine + k);
      Lanes const amount = lane::select(zero < cosine, Lanes(query.front), Lanes(query.back));
      lane::store(out.diffuse + k,
                  lane::load<Lanes>(query.opaque + k) * amount * lane::abs(cosine));
      if (!query.mirrored && !query.half) return;
      lane::Vec<Lanes> const view = load<Lanes>(*query.view, k),
                             normal = load<Lanes>(*query.normal, k),
                             way = load<Lanes>(query.aim->direction, k);
      if (query.mirrored) {
        Lanes const twice = Lanes(2.0) * lane::dot(view, normal);
        lane::Vec<Lanes> const mirrored{view.x - normal.x * twice, view.y - normal.y * twice,
                                        view.z - normal.z * twice};
        lane::store(out.mirrored + k, lane::dot(mirrored, way));
      }
      if (query.half) {
        lane::Vec<Lanes> const half = way - view;
        Lanes const length = lane::sqrt(lane::dot(half, half));
        lane::store(out.half + k,
                    lane::select(zero < length, lane::dot(normal, half) / length, zero));
      }
    });
  }
};

struct FindGloss {
  template <class L>
  static void run(ShadedLanes const& lanes, Gloss const& lit, double* out) {
    in_rays<L>(lanes, [&]<class Lanes>(std::size_t k, auto const& of_ray, auto const& of_channel) {
      auto const of = [k](double const* values) { return lane::load<Lanes>(values + k); };
      Lanes const colour = of(lanes.colour);
      Lanes arriving = of_channel(lit.light);
      if (lit.strength != nullptr) arriving = arriving * of_ray(lit.strength);
      if (lit.left != nullptr) arriving = arriving * of(lit.left);
      Lanes returned = colour * of_ray(lit.diffuse);
      if (lit.shine != nullptr) {
        Lanes shine = of_ray(lit.shine);
        if (lit.tint != nullptr) {
          Lanes const one(1.0);
          shine = shine * (one + of_ray(lit.tint) * (colour - one));
        }
        returned = returned + shine;
      }
      lane::store(out + k, of(lanes.throughput) * of(lanes.passed) * arriving * returned);
    });
  }
};

struct FindGlow {
  template <class L>
  static void run(ShadedLanes const& lanes, ChannelValues own, double const* opaque, double* out) {
    in_rays<L>(lanes, [&]<class Lanes>(std::size_t k, auto const& of_ray, auto const& of_channel) {
      auto const of = [k](double const* values) { return lane::load<Lanes>(values + k); };
      lane::store(out + k, of(lanes.throughput) * of(lanes.passed) * of(lanes.colour)
                               * of_ray(opaque) * of_channel(own));
    });
  }
};

simd::Native<AimAt> const aim_at;
simd::Native<LightSurfaces> const light;
simd::Native<FindGloss> const gloss;
simd::Native<FindGlow> const glow;

} // namespace

void aim(CompiledLight const& lamp, FanVectors const& points, FanVectors const& normals,
         std::size_t count, Aim& out) {
  aim_at(lamp, points, normals, count, out);
  bool const parallel = lamp.kind == scene::Light::Kind::Parallel;
  out.comes = 0;
  for (std::size_t k = 0; k < count; ++k) {
    // Not in the lamp. Parallel light is everywhere, as in POV-Ray: behind the lamp's plane, where
    // the distance is negative, without shadows.
    bool const comes = parallel || out.distance[k] != 0;
    out.comes |= std::uint64_t{comes} << k;
  }
}

void light_surfaces(LitQuery const& query, std::size_t count, LitSurface& out) {
  light(query, count, out);
}
void find_gloss(ShadedLanes const& lanes, Gloss const& lit, double* out) {
  gloss(lanes, lit, out);
}
void find_glow(ShadedLanes const& lanes, ChannelValues own, double const* opaque, double* out) {
  glow(lanes, own, opaque, out);
}

} // namespace abbe::render
