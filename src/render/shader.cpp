// SPDX-License-Identifier: MIT
#include "render/shader.hpp"

#include "simd/math.hpp"
#include "surface/pigment.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace abbe::render {

double metallic_falloff(double cosine) {
  double const x = simd::acos(std::clamp(cosine, -1.0, 1.0)) / (std::numbers::pi / 2);
  double const d = x - 1.12;
  return std::clamp(0.014567225 / (d * d) - 0.011612903, 0.0, 1.0);
}

double distance_fade(Medium const& medium, int channel, double distance) {
  if (medium.fade_distance == 0) return 1;
  double const colour =
      medium.fade_colour.empty() ? 0 : medium.fade_colour[static_cast<std::size_t>(channel)];
  double const depth = distance / medium.fade_distance;
  if (medium.fade_power >= 1000) return simd::exp(-(1 - colour) * depth);
  return colour + (1 - colour) / (1 + simd::pow(depth, medium.fade_power));
}

template <int Lanes>
FanSurface Shader<Lanes>::shade() {
  FanSurface out;
  out.passed = take_lanes(1.0);
  out.mirrored = take_lanes(0.0);
  Rays rays = ~Rays{0} >> (64 - met_.rays);
  // What is left comes before what is entered: that is the order in which the light meets them.
  for (bool const entering : {false, true})
    for (auto const& crossing : frame_.hit.crossings)
      if (crossing.entering == entering) {
        shade_surface(crossing, rays, out);
        rays = with_light(rays, out.passed, 0);
        if (rays == 0) return out;
      }
  return out;
}

template <int Lanes>
void Shader<Lanes>::shade_surface(geometry::SurfaceCrossing const& crossing, Rays rays,
                                  FanSurface& out) {
  bool const carries = &crossing == &frame_.hit.crossings[met_.carrier];
  bool const both_sides = stage_.textures.surfaces[crossing.primitive].double_illuminate;
  surface::Reader const reader = stage_.reader();
  if (auto const layers = reader.same(crossing))
    return shade_layers(*layers, both_sides, carries, rays, out);
  each_ray(rays, [&](std::size_t r, int first) {
    Rays const alone = Rays{1} << r;
    surface::SeenLayers const seen =
        reader.at(frame_.hit, crossing, met_.point->get(r), met_.direction->get(r));
    if (seen.count == 1) return shade_layers(seen.part[0].layers, both_sides, carries, alone, out);
    // Each texture shades its share of the light.
    Arena::Scope const scope(tracer_.arena_);
    auto const n = static_cast<std::size_t>(each());
    auto const copy = [&](double const* values) {
      auto* const own = tracer_.arena_.template take<double>(n);
      std::copy_n(values + first, n, own);
      return own;
    };
    double const* const arriving = copy(out.passed);
    double* const mirrored = copy(out.mirrored);
    auto* const left = tracer_.arena_.template take<double>(n);
    std::fill_n(left, n, 0.0);
    for (std::size_t part = 0; part < seen.count; ++part) {
      double const share = seen.part[part].share;
      for (std::size_t c = 0; c < n; ++c) {
        out.passed[first + static_cast<int>(c)] = arriving[c] * share;
        out.mirrored[first + static_cast<int>(c)] = 0;
      }
      shade_layers(seen.part[part].layers, both_sides, carries, alone, out);
      for (std::size_t c = 0; c < n; ++c) {
        left[c] += out.passed[first + static_cast<int>(c)];
        mirrored[c] += out.mirrored[first + static_cast<int>(c)] * share;
      }
    }
    std::copy_n(mirrored, n, out.mirrored + first);
    std::copy_n(left, n, out.passed + first);
  });
}

template <int Lanes>
void Shader<Lanes>::shade_layers(std::span<int const> layers, bool double_illuminate, bool carries,
                                 Rays rays, FanSurface& out) {
  for (auto layer = layers.rbegin(); layer != layers.rend() && rays != 0; ++layer) {
    Arena::Scope const scope(tracer_.arena_);
    shade_layer(stage_.textures.layers[static_cast<std::size_t>(*layer)], double_illuminate,
                carries, rays, out);
    rays = with_light(rays, out.passed, std::max(0.0, stage_.adc_bailout));
  }
}

template <int Lanes>
void Shader<Lanes>::shade_layer(CompiledLayer const& layer, bool double_illuminate, bool carries,
                                Rays rays, FanSurface& out) {
  CompiledFinish const& finish = stage_.textures.finish(layer);
  Pigments pigment;
  pigments_at(layer, rays, pigment);
  bool opaque = false;
  each_ray(rays, [&](std::size_t r, int) { opaque = opaque || pigment.opaque[r] != 0; });
  if (opaque) add_glow(finish, pigment, rays, out.passed);
  bool const shines = finish.phong != 0 || finish.specular != 0;
  bool const scatters = opaque && (finish.diffuse != 0 || finish.diffuse_back != 0);
  if (shines || scatters)
    for (CompiledLight const& light : stage_.lights)
      add_light(light, finish, pigment, double_illuminate, rays, out.passed);

  double* mirror = nullptr;
  if (finish.reflection) {
    mirror = take_lanes();
    reflectivity(*finish.reflection, pigment.colour, carries, rays, mirror);
    add_mirror(*finish.reflection, mirror, carries, rays, out);
  }
  double *const passed = out.passed, *const colour = pigment.colour;
  each_lane(rays, [&](std::size_t r, int k) {
    passed[k] *= pigment.filter[r] * colour[k] + pigment.transmit[r];
  });
  if (mirror != nullptr && finish.conserve_energy)
    each_lane(rays, [&](std::size_t, int k) {
      passed[k] *= std::min(1.0, std::max(0.0, 1 - mirror[k]));
    });
}

template <int Lanes>
void Shader<Lanes>::add_mirror(CompiledReflection const& reflection, double const* mirror,
                               bool carries, Rays rays, FanSurface& out) {
  double* const mirrored = out.mirrored;
  each_ray(rays, [&](std::size_t r, int first) {
    bool any = false;
    for (int k = first; k < first + each(); ++k) {
      mirrored[k] += mirror[k];
      any = any || mirror[k] != 0;
    }
    out.mirrors[r] = out.mirrors[r] || any;
    if (carries || out.exponent[r] == 1) out.exponent[r] = reflection.exponent;
    out.explicit_reflection[r] = out.explicit_reflection[r] || carries;
  });
}

template <int Lanes>
void Shader<Lanes>::pigments_at(CompiledLayer const& layer, Rays rays, Pigments& out) {
  CompiledPigment const& pigment =
      stage_.textures.pigments[static_cast<std::size_t>(layer.pigment)];
  out.colour = take_lanes();
  if (pigment.pattern < 0) return plain_pigments_at(pigment, rays, out);
  each_ray(rays, [&](std::size_t r, int first) {
    surface::PigmentValue value{out.colour + first};
    surface::evaluate_pigment<Lanes>(stage_.textures, layer.pigment,
                                     stage_.textures.to_texture(layer, met_.point->get(r)),
                                     beam_.channel + first, each(), value, tracer_.arena_);
    out.filter[r] = value.filter;
    out.transmit[r] = value.transmit;
    out.opaque[r] = surface::opacity(stage_.textures, value, each());
  });
}

template <int Lanes>
void Shader<Lanes>::plain_pigments_at(CompiledPigment const& pigment, Rays rays, Pigments& out) {
  double const* const value = stage_.textures.colour(pigment);
  std::uint16_t const* const channel = beam_.channel;
  double* const colour = out.colour;
  each_lane(rays, [&](std::size_t, int k) { colour[k] = value[channel[k]]; });
  std::fill_n(out.filter, met_.rays, pigment.filter);
  std::fill_n(out.transmit, met_.rays, pigment.transmit);
  each_ray(rays, [&](std::size_t r, int first) {
    out.opaque[r] = surface::opacity(stage_.textures,
                                     {colour + first, pigment.filter, pigment.transmit}, each());
  });
}

template <int Lanes>
void Shader<Lanes>::add_glow(CompiledFinish const& finish, Pigments const& pigment, Rays rays,
                             double const* passed) {
  if (finish.ambient.empty() && finish.emission.empty()) return;
  Rays opaque = 0;
  each_ray(rays, [&](std::size_t r, int) { opaque |= Rays{pigment.opaque[r] != 0} << r; });
  Arena::Scope const scope(tracer_.arena_);
  double* const added = take_lanes();
  auto const glow = by_channel([&](std::uint16_t c) {
    return (finish.ambient.empty() ? 0 : finish.ambient[c])
           + (finish.emission.empty() ? 0 : finish.emission[c]);
  });
  find_glow(lanes_of(passed, pigment), glow, pigment.opaque, added);
  add(opaque, added);
}

template <int Lanes>
void Shader<Lanes>::reflectivity(CompiledReflection const& reflection, double const* pigment,
                                 bool carries, Rays rays, double* out) {
  std::uint16_t const* const channel = beam_.channel;
  if (!reflection.metal_n.empty()) {
    each_lane(rays, [&](std::size_t r, int k) {
      auto const c = channel[k];
      out[k] = optics::conductor_reflectance<double>(reflection.metal_n[c], reflection.metal_k[c],
                                                     met_.cos_i[r]);
    });
    return;
  }
  double const *const most = reflection.maximum.data(), *const least = reflection.minimum.data();
  auto const between = [&](double share, std::uint16_t c) {
    return share * most[c] + (1 - share) * least[c];
  };
  double const* const fresnel = carries ? met_.reflectance : nullptr;
  if (reflection.fresnel)
    each_lane(rays, [&](std::size_t, int k) {
      out[k] = between(fresnel != nullptr ? fresnel[k] : 0, channel[k]);
    });
  else
    each_ray(rays, [&](std::size_t r, int first) {
      double const falloff = reflection.falloff;
      double const share = falloff == 0 ? 1 : simd::pow(1 - met_.cos_i[r], falloff);
      for (int k = first; k < first + each(); ++k) out[k] = between(share, channel[k]);
    });
  if (reflection.metallic == 0) return;
  each_ray(rays, [&](std::size_t r, int first) {
    double const tint = reflection.metallic * (1 - metallic_falloff(met_.cos_i[r]));
    for (int k = first; k < first + each(); ++k) out[k] *= 1 + tint * (pigment[k] - 1);
  });
}

template class Shader<0>;
template class Shader<1>;
template class Shader<3>;

FanSurface Tracer::shade_met(Meeting const& met, Beam const& beam, Frame& frame,
                             InsideNode const* inside, InsideNode const* after,
                             FanShadows* shadows) {
  auto const with = [&](auto lanes) {
    return Shader<decltype(lanes)::value>(*this, met, beam, frame, inside, after, shadows).shade();
  };
  std::size_t const each = static_cast<std::size_t>(beam.lanes) / met.rays;
  if (each == 1) return with(std::integral_constant<int, 1>());
  if (each == 3) return with(std::integral_constant<int, 3>());
  return with(std::integral_constant<int, 0>());
}

LaneSurface Tracer::shade(PathRay const& ray, Beam const& beam, Frame& frame,
                          LaneInterface const& face, InsideNode const* after) {
  geometry::FanVectors direction, point, point_error, normal, geometric;
  direction.set(0, ray.line.direction);
  point.set(0, frame.hit.point);
  point_error.set(0, frame.hit.point_error);
  normal.set(0, face.normal);
  geometric.set(0, face.geometric);
  Meeting const met{1,          &direction,  &point,           &point_error, &normal,
                    &geometric, &face.cos_i, face.reflectance, face.carrier};
  return shade_met(met, beam, frame, ray.inside, after, nullptr).of(0, beam.lanes);
}

} // namespace abbe::render
