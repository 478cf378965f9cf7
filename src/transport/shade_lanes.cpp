// SPDX-License-Identifier: MIT
#include "transport/shade_lanes.hpp"

#include "simd/math.hpp"
#include "simd/native.hpp"

namespace abbe::transport {
namespace {

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

struct LightSurfaces {
  template <class L>
  static void run(LitQuery const& query, std::size_t count, LitSurface& out) {
    lane::in_lanes<L>(count, [&]<class Lanes>(std::size_t k) {
      Lanes const zero(0.0);
      Lanes const cosine = lane::load<Lanes>(query.aim->cosine.value + k);
      Lanes const amount = lane::select(zero < cosine, Lanes(query.front), Lanes(query.back));
      lane::store(out.diffuse.value + k,
                  lane::load<Lanes>(query.opaque + k) * amount * lane::abs(cosine));
      if (!query.mirrored && !query.half) return;
      lane::Vec<Lanes> const view = load<Lanes>(*query.view, k),
                             normal = load<Lanes>(*query.normal, k),
                             way = load<Lanes>(query.aim->direction, k);
      if (query.mirrored) {
        Lanes const twice = Lanes(2.0) * lane::dot(view, normal);
        lane::Vec<Lanes> const mirrored{view.x - normal.x * twice, view.y - normal.y * twice,
                                        view.z - normal.z * twice};
        lane::store(out.mirrored.value + k, lane::dot(mirrored, way));
      }
      if (query.half) {
        lane::Vec<Lanes> const half = way - view;
        Lanes const length = lane::sqrt(lane::dot(half, half));
        lane::store(out.half.value + k,
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

struct Raise {
  template <class L>
  static void run(Values& values, std::size_t count, double exponent) {
    lane::in_lanes<L>(count, [&]<class Lanes>(std::size_t k) {
      lane::store(values.value + k,
                  lane::pow(lane::load<Lanes>(values.value + k), Lanes(exponent)));
    });
  }
};

simd::Native<Raise> const raise_each;
simd::Native<LightSurfaces> const light;
simd::Native<FindGloss> const gloss;
simd::Native<FindGlow> const glow;

} // namespace

void light_surfaces(LitQuery const& query, std::size_t count, LitSurface& out) {
  light(query, count, out);
}
void raise(Values& values, std::size_t count, double exponent) {
  raise_each(values, count, exponent);
}
void find_gloss(ShadedLanes const& lanes, Gloss const& lit, double* out) {
  gloss(lanes, lit, out);
}
void find_glow(ShadedLanes const& lanes, ChannelValues own, double const* opaque, double* out) {
  glow(lanes, own, opaque, out);
}

} // namespace abbe::transport
