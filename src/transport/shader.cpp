// SPDX-License-Identifier: MIT
#include "transport/shader.hpp"

#include "optics/fresnel.hpp"
#include "simd/math.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace abbe::transport {

using surface::CompiledFinish, surface::CompiledLayer, surface::CompiledPigment,
    surface::CompiledReflection, surface::SeenLayers;

double metallic_falloff(double cosine) {
  double const x = simd::acos(std::clamp(cosine, -1.0, 1.0)) / (std::numbers::pi / 2);
  double const d = x - 1.12;
  return std::clamp(0.014567225 / (d * d) - 0.011612903, 0.0, 1.0);
}

namespace {
/// Numbers of mirrors with normals of their own begin behind that of the chunk's; those of the
/// layers of a texture are apart by less than this.
constexpr std::uint32_t first_own_mirror = 2, most_layers = 1U << 8, most_parts = 1U << 12;
} // namespace

template <int Lanes>
SurfaceLight Shader<Lanes>::shade() {
  SurfaceLight out;
  out.passed = take_lanes(1.0);
  out.mirrored = take_lanes(0.0);
  std::fill_n(out.exponent.value, chunk_.count, 1.0);
  std::size_t const lamps = stage_.lamps.size();
  out.of_lamp = arena_.take<double*>(lamps);
  out.lit = arena_.take<RaySet>(lamps);
  std::fill_n(out.of_lamp, lamps, nullptr);
  std::fill_n(out.lit, lamps, RaySet{0});
  RaySet rays = first_rays(chunk_.count);
  if (chunk_.group == nullptr) {
    shade_single(rays, out);
    return out;
  }
  // What is left comes before what is entered: that is the order in which the light meets them.
  auto const& crossings = chunk_.crossings;
  geometry::SurfaceCrossing const* const carrier =
      crossings.empty() ? nullptr : &geometry::shown(chunk_.group->crossings);
  std::uint32_t place = 0;
  for (bool const entering : {false, true})
    for (auto const& crossing : crossings)
      if (crossing.entering == entering) {
        shade_crossing(crossing, &crossing == carrier, place, rays, out);
        place += most_layers * most_parts;
        rays = with_light(rays, out.passed, 0);
        if (rays == 0) return out;
      }
  return out;
}

template <int Lanes>
void Shader<Lanes>::shade_single(RaySet rays, SurfaceLight& out) {
  auto const& surfaces = stage_.textures.surfaces;
  surface::Surface const first = surfaces[chunk_.hit[0].primitive];
  if (first.bare()) return;
  Side const side{first.double_illuminate, true};
  // The rays of a chunk have surfaces of one class (Buckets): one layer each, of one finish; or the
  // same layers.
  if (surfaces.single_layer(chunk_.hit[0].primitive)) {
    int* const layer = arena_.take<int>(chunk_.count);
    for (std::size_t r = 0; r < chunk_.count; ++r)
      layer[r] = surfaces[chunk_.hit[r].primitive].layers[0];
    return shade_layer({0, layer}, side, rays, out);
  }
  surface::Reader const reader = stage_.reader();
  if (auto const layers = reader.same(meeting_of(stage_, chunk_, 0).crossing))
    return shade_layers(*layers, side, rays, out);
  auto* const seen = arena_.take<SeenLayers>(chunk_.count);
  for (std::size_t r = 0; r < chunk_.count; ++r)
    seen[r] = reader.at(straight_meeting_of(stage_, chunk_, r), arena_);
  shade_seen(rays, side, out, seen);
}

template <int Lanes>
void Shader<Lanes>::shade_crossing(geometry::SurfaceCrossing const& crossing, bool carries,
                                   std::uint32_t place, RaySet rays, SurfaceLight& out) {
  Side const side{stage_.textures.surfaces[crossing.primitive].double_illuminate, carries, place,
                  &crossing};
  surface::Reader const reader = stage_.reader();
  if (auto const layers = reader.same(crossing)) return shade_layers(*layers, side, rays, out);
  auto* const seen = arena_.take<SeenLayers>(chunk_.count);
  each_of(rays, [&](std::size_t r) {
    seen[r] = reader.at(straight_meeting_of(stage_, chunk_, r, side.spot(r)), arena_);
  });
  shade_seen(rays, side, out, seen);
}

template <int Lanes>
void Shader<Lanes>::shade_seen(RaySet rays, Side const& side, SurfaceLight& out,
                               SeenLayers const* seen) {
  std::size_t most = 1;
  each_of(rays, [&](std::size_t r) { most = std::max(most, seen[r].parts.size()); });
  auto const visit_same = [&](std::size_t part, RaySet among, auto const& work) {
    while (among != 0) {
      auto const first = static_cast<std::size_t>(std::countr_zero(among));
      std::span<int const> const layers = seen[first].parts[part].layers;
      RaySet same = 0;
      each_of(among, [&](std::size_t r) {
        auto const& own = seen[r].parts[part].layers;
        if (own.data() == layers.data() && own.size() == layers.size()) same |= RaySet{1} << r;
      });
      among &= ~same;
      work(layers, same);
    }
  };
  SeenLayers::Part const* parts[chunk_width];
  Side of_part = side;
  of_part.parts = parts;
  if (most == 1) {
    each_of(rays, [&](std::size_t r) { parts[r] = seen[r].parts.data(); });
    return visit_same(0, rays, [&](std::span<int const> layers, RaySet same) {
      shade_layers(layers, of_part, same, out);
    });
  }
  // Each texture shades its share of the light.
  Arena::Scope const scope(arena_);
  std::size_t const lanes = chunk_.count * each();
  auto const copy = [&](double const* values) {
    auto* const own = take_lanes();
    std::copy_n(values, lanes, own);
    return own;
  };
  double const* const arriving = copy(out.passed);
  double* const mirrored = copy(out.mirrored);
  double* const left = take_lanes(0.0);
  for (std::size_t part = 0; part < most; ++part) {
    RaySet having = 0;
    each_of(rays, [&](std::size_t r) {
      if (part >= seen[r].parts.size()) return;
      having |= RaySet{1} << r;
      parts[r] = &seen[r].parts[part];
    });
    of_part.place = side.place + static_cast<std::uint32_t>(part) * most_layers;
    each_lane(having, [&](std::size_t r, std::size_t k) {
      out.passed[k] = arriving[k] * parts[r]->share;
      out.mirrored[k] = 0;
    });
    visit_same(part, having, [&](std::span<int const> layers, RaySet same) {
      shade_layers(layers, of_part, same, out);
    });
    each_lane(having, [&](std::size_t r, std::size_t k) {
      left[k] += out.passed[k];
      mirrored[k] += out.mirrored[k] * parts[r]->share;
    });
  }
  each_lane(rays, [&](std::size_t, std::size_t k) {
    out.mirrored[k] = mirrored[k];
    out.passed[k] = left[k];
  });
}

template <int Lanes>
void Shader<Lanes>::shade_layers(std::span<int const> layers, Side const& side, RaySet rays,
                                 SurfaceLight& out) {
  Side own = side;
  for (auto layer = layers.rbegin(); layer != layers.rend() && rays != 0; ++layer, ++own.place) {
    shade_layer({*layer, nullptr}, own, rays, out);
    rays = with_light(rays, out.passed, std::max(0.0, stage_.adc_bailout));
  }
}

template <int Lanes>
void Shader<Lanes>::shade_layer(Layer const& layer, Side const& side, RaySet rays,
                                SurfaceLight& out) {
  auto const first = static_cast<std::size_t>(std::countr_zero(rays));
  CompiledFinish const& finish =
      stage_.textures.finish(stage_.textures.layers[static_cast<std::size_t>(layer.of(first))]);
  Facing const face = facing(layer, side, rays);
  Pigments pigment;
  pigments_at(layer, side, rays, pigment);
  bool opaque = false;
  each_of(rays, [&](std::size_t r) { opaque = opaque || pigment.opaque[r] != 0; });
  if (lit_by_lamps_) {
    if (opaque) add_glow(finish, pigment, rays, out);
    bool const shines = finish.phong != 0 || finish.specular != 0;
    bool const scatters = opaque && (finish.diffuse != 0 || finish.diffuse_back != 0);
    if (shines || scatters)
      for (std::size_t lamp = 0; lamp < stage_.lamps.size(); ++lamp)
        add_lamp(lamp, finish, pigment, face, side.double_illuminate, lit_by(lamp, side, rays),
                 out);
    if (thrown_ != nullptr && (shines || scatters))
      add_thrown(finish, pigment, face, side, rays, out);
  }
  double* mirror = nullptr;
  if (finish.reflection) {
    mirror = take_lanes();
    reflectivity(*finish.reflection, pigment.colour, face, side.carries, rays, mirror);
    if (face.own != nullptr)
      add_own_mirror(*finish.reflection, mirror, side, *face.own, rays, out);
    else
      add_mirror(*finish.reflection, mirror, side.carries, rays, out);
  }
  double *const passed = out.passed, *const colour = pigment.colour;
  each_of(rays, [&](std::size_t r) {
    double const filter = pigment.filter[r], transmit = pigment.transmit[r];
    for (std::size_t k = r * each(); k < (r + 1) * each(); ++k)
      passed[k] *= filter * colour[k] + transmit;
  });
  if (mirror != nullptr && finish.conserve_energy)
    each_lane(rays, [&](std::size_t, std::size_t k) {
      passed[k] *= std::min(1.0, std::max(0.0, 1 - mirror[k]));
    });
}

template <int Lanes>
void Shader<Lanes>::add_mirror(CompiledReflection const& reflection, double const* mirror,
                               bool carries, RaySet rays, SurfaceLight& out) {
  each_of(rays, [&](std::size_t r) {
    bool any = false;
    for (std::size_t k = r * each(); k < (r + 1) * each(); ++k) {
      out.mirrored[k] += mirror[k];
      any = any || mirror[k] != 0;
    }
    out.mirrors |= RaySet{any} << r;
    if (carries || out.exponent[r] == 1) out.exponent[r] = reflection.exponent;
    out.explicit_reflection |= RaySet{carries} << r;
  });
}

template <int Lanes>
void Shader<Lanes>::add_own_mirror(CompiledReflection const& reflection, double const* mirror,
                                   Side const& side, LayerFace const& face, RaySet rays,
                                   SurfaceLight& out) {
  std::uint32_t const number = first_own_mirror + side.place;
  auto& known = out.own_mirrors;
  auto at = std::find_if(known.begin(), known.end(),
                         [&](OwnMirror const* own) { return own->number >= number; });
  if (at == known.end() || (*at)->number != number) {
    auto* const fresh = arena_.take<OwnMirror>(1);
    fresh->number = number;
    fresh->rays = 0;
    fresh->light = take_lanes(0.0);
    at = known.insert(at, fresh);
  }
  OwnMirror& own = **at;
  own.rays |= rays;
  each_of(rays, [&](std::size_t r) {
    for (std::size_t k = r * each(); k < (r + 1) * each(); ++k)
      own.light[k] = mirror[k] * (side.parts != nullptr ? side.parts[r]->share : 1);
    own.way.set(r, face.mirrored.get(r));
    own.exponent[r] = reflection.exponent;
    out.explicit_reflection |= RaySet{side.carries} << r;
  });
}

template <int Lanes>
double Shader<Lanes>::fresnel_of(std::size_t r, double cos_i) const {
  double const n1 = chunk_.n1[r], n2 = chunk_.n2[r];
  return optics::fresnel<double>(n1, n2, n2 - n1, cos_i, 1 - cos_i * cos_i).reflectance;
}

template <int Lanes>
typename Shader<Lanes>::Facing Shader<Lanes>::facing(Layer const& layer, Side const& side,
                                                     RaySet rays) {
  Facing out{&chunk_.normal, &chunk_.cos_i, nullptr};
  surface::Textures const& textures = stage_.textures;
  if (textures.normals.empty()) return out;
  bool own = false;
  each_of(rays, [&](std::size_t r) {
    int const number = layer.of(r);
    bool const tilts = textures.layers[static_cast<std::size_t>(number)].normal >= 0;
    own = own || (chunk_.tilts ? chunk_.tilted[r] : -1) != (tilts ? number : -1);
  });
  if (!own) return out;
  auto* const face = arena_.take<LayerFace>(1);
  each_of(rays,
          [&](std::size_t r) { face_layer(stage_, chunk_, r, layer.of(r), side.spot(r), *face); });
  auto const first = static_cast<std::size_t>(std::countr_zero(rays));
  for (std::size_t r = 0; r < (chunk_.count + 7) / 8 * 8; ++r)
    if (r >= chunk_.count || (rays >> r & 1) == 0) face->normal.set(r, face->normal.get(first));
  return {&face->normal, &face->cos_i, face};
}

template <int Lanes>
void Shader<Lanes>::pigments_at(Layer const& layer, Side const& side, RaySet rays, Pigments& out) {
  surface::Textures const& textures = stage_.textures;
  out.colour = take_lanes();
  std::uint16_t const* const channels = chunk_.channels;
  if (in_order_ && same_pigment(layer, rays, out)) return;
  each_of(rays, [&](std::size_t r) {
    CompiledLayer const& own = textures.layers[static_cast<std::size_t>(layer.of(r))];
    CompiledPigment const& pigment = textures.pigments[static_cast<std::size_t>(own.pigment)];
    std::size_t const first = r * each();
    surface::PigmentValue value{out.colour + first};
    int const lanes = static_cast<int>(each());
    if (pigment.pattern < 0) {
      surface::plain_pigment<Lanes>(textures, pigment, channels + first, lanes, value);
    } else {
      LayerSpot const spot = side.spot(r);
      auto const meeting = meeting_of(stage_, chunk_, r, spot);
      bool const placed = spot.part != nullptr && spot.part->placed;
      surface::evaluate_pigment<Lanes>(
          textures, own.pigment,
          surface::spot_of(textures, own, placed ? spot.part->point : meeting.point, meeting.sight),
          channels + first, lanes, value, arena_);
    }
    out.filter[r] = value.filter;
    out.transmit[r] = value.transmit;
    out.opaque[r] = surface::opacity(textures, value, lanes);
  });
}

template <int Lanes>
bool Shader<Lanes>::same_pigment(Layer const& layer, RaySet rays, Pigments& out) {
  surface::Textures const& textures = stage_.textures;
  auto const first = static_cast<std::size_t>(std::countr_zero(rays));
  CompiledLayer const& own = textures.layers[static_cast<std::size_t>(layer.of(first))];
  CompiledPigment const& pigment = textures.pigments[static_cast<std::size_t>(own.pigment)];
  if (pigment.pattern >= 0) return false;
  for (std::size_t r = 0; layer.own != nullptr && r < chunk_.count; ++r)
    if (layer.own[r] != layer.own[first]) return false;
  surface::PigmentValue value{out.colour, pigment.filter, pigment.transmit};
  double const* const colour = textures.colour(pigment);
  std::size_t k = 0;
  for (std::size_t r = 0; r < chunk_.count; ++r)
    for (std::size_t c = 0; c < each(); ++c) out.colour[k++] = colour[c];
  std::fill_n(out.filter.value, chunk_.count, value.filter);
  std::fill_n(out.transmit.value, chunk_.count, value.transmit);
  std::fill_n(out.opaque.value, chunk_.count,
              surface::opacity(textures, value, static_cast<int>(each())));
  return true;
}

template <int Lanes>
void Shader<Lanes>::add_glow(CompiledFinish const& finish, Pigments const& pigment, RaySet rays,
                             SurfaceLight& out) {
  if (finish.ambient.empty() && finish.emission.empty()) return;
  RaySet opaque = 0;
  each_of(rays, [&](std::size_t r) { opaque |= RaySet{pigment.opaque[r] != 0} << r; });
  if (out.own == nullptr) out.own = take_lanes(0.0);
  double* const added = take_lanes();
  auto const glow = by_channel([&](std::uint16_t c) {
    return (finish.ambient.empty() ? 0 : finish.ambient[c])
           + (finish.emission.empty() ? 0 : finish.emission[c]);
  });
  find_glow(lanes_of(out.passed, pigment), glow, pigment.opaque.value, added);
  add(opaque, added, out.own);
}

template <int Lanes>
void Shader<Lanes>::reflectivity(CompiledReflection const& reflection, double const* pigment,
                                 Facing const& facing, bool carries, RaySet rays, double* out) {
  std::uint16_t const* const channel = chunk_.channels;
  Values const& cos_i = *facing.cos_i;
  if (!reflection.metal_n.empty()) {
    each_lane(rays, [&](std::size_t r, std::size_t k) {
      auto const c = channel[k];
      out[k] = optics::conductor_reflectance<double>(reflection.metal_n[c], reflection.metal_k[c],
                                                     cos_i[r]);
    });
    return;
  }
  double const *const most = reflection.maximum.data(), *const least = reflection.minimum.data();
  auto const between = [&](double share, std::uint16_t c) {
    return share * most[c] + (1 - share) * least[c];
  };
  if (reflection.fresnel)
    each_lane(rays, [&](std::size_t r, std::size_t k) {
      double const fresnel = !carries                          ? 0
                             : facing.own != nullptr           ? fresnel_of(r, cos_i[r])
                             : reflectance_.of_lane != nullptr ? reflectance_.of_lane[k]
                                                               : reflectance_.of_ray[r];
      out[k] = between(fresnel, channel[k]);
    });
  else
    each_of(rays, [&](std::size_t r) {
      double const falloff = reflection.falloff;
      double const share = falloff == 0 ? 1 : simd::pow(1 - cos_i[r], falloff);
      for (std::size_t k = r * each(); k < (r + 1) * each(); ++k)
        out[k] = between(share, channel[k]);
    });
  if (reflection.metallic == 0) return;
  each_of(rays, [&](std::size_t r) {
    double const tint = reflection.metallic * (1 - metallic_falloff(cos_i[r]));
    for (std::size_t k = r * each(); k < (r + 1) * each(); ++k)
      out[k] *= 1 + tint * (pigment[k] - 1);
  });
}

template class Shader<0>;
template class Shader<1>;
template class Shader<3>;

SurfaceLight shade(Stage const& stage, Arena& arena, std::vector<Aim>& aims, Chunk const& chunk,
                   LaneReflectance reflectance, bool lit_by_lamps,
                   caustics::CausticLights* thrown) {
  auto const with = [&](auto lanes) {
    return Shader<decltype(lanes)::value>(stage, arena, aims, chunk, reflectance, lit_by_lamps,
                                          thrown)
        .shade();
  };
  if (chunk.each == 1) return with(std::integral_constant<int, 1>());
  if (chunk.each == 3) return with(std::integral_constant<int, 3>());
  return with(std::integral_constant<int, 0>());
}

} // namespace abbe::transport
