// SPDX-License-Identifier: MIT
#include "render/fan_shadows.hpp"
#include "render/shader.hpp"
#include "simd/math.hpp"

#include <algorithm>
#include <cmath>

/// What lamps add to a surface.
namespace abbe::render {

namespace {

/// Of a lamp's light in this direction and at this distance.
double strength_of(CompiledLight const& light, Vec3 const& to_light, double distance) {
  double strength = 1;
  if (light.kind == scene::Light::Kind::Spot) {
    double const cosine = -glm::dot(to_light, light.direction);
    if (cosine <= 0 || cosine < light.cos_falloff) return 0;
    if (light.tightness != 0) strength = simd::pow(cosine, light.tightness);
    if (cosine < light.cos_radius) {
      double const x = (cosine - light.cos_falloff) / (light.cos_radius - light.cos_falloff);
      strength *= x * x * (3 - 2 * x);
    }
  }
  if (light.fade_power > 0 && light.fade_distance != 0)
    strength *= 2 / (1 + simd::pow(distance / light.fade_distance, light.fade_power));
  return std::isfinite(strength) ? strength : 0; // negative distances have no broken powers
}

} // namespace

template <int Lanes>
void Shader<Lanes>::find_strengths(CompiledLight const& light, Rays rays, Lit& out) {
  bool const fades = light.fade_power > 0 && light.fade_distance != 0;
  out.weakens = light.kind == scene::Light::Kind::Spot || fades;
  if (!out.weakens) return;
  each_ray(rays, [&](std::size_t r, int) {
    out.strength[r] = strength_of(light, out.aim->direction.get(r), out.aim->distance[r]);
  });
}

template <int Lanes>
void Shader<Lanes>::find_highlights(CompiledFinish const& finish, bool double_illuminate, Rays rays,
                                    Lit& out) {
  if (!out.shines) return;
  std::fill_n(out.shine, met_.rays, 0.0);
  each_ray(rays, [&](std::size_t r, int) {
    if (!(out.aim->cosine[r] > 0 || double_illuminate)) return;
    double shine = 0;
    if (double const along = out.surface.mirrored[r]; finish.phong != 0 && along > 0)
      shine +=
          finish.phong * (finish.phong_size == 1 ? along : simd::pow(along, finish.phong_size));
    if (double const along = out.surface.half[r]; finish.specular != 0 && along > 0)
      shine += finish.specular * simd::pow(along, 1 / finish.roughness);
    out.shine[r] = shine;
  });
}

template <int Lanes>
auto Shader<Lanes>::light_up(CompiledLight const& light, CompiledFinish const& finish,
                             Pigments const& pigment, bool double_illuminate, Rays rays, Lit& out)
    -> Rays {
  if (shadows_ != nullptr) {
    out.aim = &shadows_->aim(light);
  } else {
    auto* const own = tracer_.arena_.template take<Aim>(1);
    aim(light, *met_.point, *met_.normal, met_.rays, *own);
    out.aim = own;
  }
  rays &= out.aim->comes;
  find_strengths(light, rays, out);
  bool const shines = !light.shadowless && (finish.phong != 0 || finish.specular != 0);
  double const behind = double_illuminate ? finish.diffuse : finish.diffuse_back;
  light_surfaces({out.aim, met_.direction, met_.normal, pigment.opaque, finish.diffuse, behind,
                  shines && finish.phong != 0, shines && finish.specular != 0},
                 met_.rays, out.surface);
  double* const diffuse = out.surface.diffuse;
  if (finish.brilliance != 1)
    each_ray(rays, [&](std::size_t r, int) {
      double const cosine = out.aim->cosine[r];
      if (diffuse[r] != 0)
        diffuse[r] = pigment.opaque[r] * (cosine > 0 ? finish.diffuse : behind)
                     * simd::pow(std::abs(cosine), finish.brilliance);
    });
  out.shines = shines;
  find_highlights(finish, double_illuminate, rays, out);
  Rays lit = 0;
  each_ray(rays, [&](std::size_t r, int) {
    bool const is = diffuse[r] != 0 || (shines && out.shine[r] != 0);
    lit |= Rays{is && !(out.weakens && out.strength[r] == 0)} << r;
  });
  return lit;
}

template <int Lanes>
void Shader<Lanes>::add_light(CompiledLight const& light, CompiledFinish const& finish,
                              Pigments const& pigment, bool double_illuminate, Rays rays,
                              double const* passed) {
  Arena::Scope const scope(tracer_.arena_);
  Lit lit;
  rays = light_up(light, finish, pigment, double_illuminate, rays, lit);
  bool const filtered = !light.shadowless && stage_.has_filter_shadows;
  double* const left = filtered && rays != 0 ? take_lanes(1.0) : nullptr;
  if (!light.shadowless && rays != 0) rays = visible_of(light, lit, rays, left);
  if (rays == 0) return;
  double tint[geometry::fan_width];
  if (finish.metallic != 0)
    each_ray(rays, [&](std::size_t r, int) {
      tint[r] = finish.metallic * (1 - metallic_falloff(lit.aim->cosine[r]));
    });
  double* const added = take_lanes();
  find_gloss(lanes_of(passed, pigment),
             {by_channel([&](std::uint16_t c) { return light.value[c]; }),
              lit.weakens ? lit.strength : nullptr, lit.surface.diffuse,
              lit.shines ? lit.shine : nullptr, finish.metallic != 0 ? tint : nullptr, left},
             added);
  add(rays, added);
}

template <int Lanes>
auto Shader<Lanes>::visible_of(CompiledLight const& light, Lit const& lit, Rays rays, double* left)
    -> Rays {
  Rays seen = 0;
  FanShadows::Way const* const ways = shadows_ != nullptr ? shadows_->ways(light) : nullptr;
  each_ray(rays, [&](std::size_t r, int first) {
    using Way = FanShadows::Way;
    ++tracer_.counts_.shadow;
    Way const way = ways != nullptr ? ways[r] : Way::Unknown;
    bool is = way != Way::Blocked;
    if (way == Way::Filtered) std::copy_n(shadows_->left(light, r), each(), left + first);
    if (way == Way::Unknown) is = visible(lit, r, left != nullptr ? left + first : nullptr);
    seen |= Rays{is} << r;
  });
  return seen;
}

template <int Lanes>
bool Shader<Lanes>::visible(Lit const& lit, std::size_t r, double* left) {
  Vec3 const to_light = lit.aim->direction.get(r);
  double const distance = lit.aim->distance[r];
  if (!(distance > 0)) return true; // behind the plane of parallel light
  geometry::Departure& from = frame_.shadow;
  from.on = frame_.hit.members;
  from.through = glm::dot(met_.geometric->get(r), to_light) < 0;
  geometry::Ray const line{met_.point->get(r), to_light, met_.point_error->get(r)};
  if (stage_.world->occluded(line, &from, opaque_shadow_bit, distance, *tracer_.scratch_))
    return false;
  if (!left) return true;
  filter_shadow(to_light, distance, r, left);
  return any_above(left, each(), 0);
}

template <int Lanes>
void Shader<Lanes>::filter_shadow(Vec3 const& to_light, double distance, std::size_t r,
                                  double* left) {
  PathRay way{{met_.point->get(r), to_light, met_.point_error->get(r)},
              &frame_.shadow,
              frame_.shadow.through ? inside_after_ : inside_,
              0,
              filter_shadow_bit};
  ++tracer_.depth_;
  Beam light = beam_.ray(static_cast<int>(r), each()); // what is left of it
  Tracer::Frame& frame = tracer_.frame(tracer_.depth_, way, light);
  double rest = distance;
  bool lit = true;
  light.throughput = left;
  // What the lamp lies on, within rounding errors, is not in its way.
  while (lit
         && tracer_.stage_.world->closest(way.line, way.from, filter_shadow_bit, rest,
                                          *tracer_.scratch_, frame.hit)
         && frame.hit.t + frame.hit.error < rest) {
    way.inside = tracer_.travel(way, frame.hit.t, light);
    Medium const& medium = stage_.media[static_cast<std::size_t>(tracer_.medium_of(way.inside))];
    InsideNode const* next = tracer_.after_crossings(way.inside, frame.hit);
    if (stage_.has_priorities) tracer_.drop_displaced(way.inside, next, frame.hit);
    double const travelled = way.travelled + frame.hit.t;
    way.travelled = frame.hit.crossings.empty() ? travelled : 0;
    if (tracer_.medium_of(next) != tracer_.medium_of(way.inside))
      for (int k = 0; k < each(); ++k) left[k] *= shadow_fade(medium, light.channel[k], travelled);
    for (auto const& crossing : frame.hit.crossings)
      stage_.reader().tint(frame.hit, crossing, stage_.caustics(crossing.solid),
                           {frame.hit.point, to_light, light.channel, each(), left},
                           tracer_.arena_);
    lit = any_above(left, each(), 0);
    rest -= frame.hit.t;
    frame.through.on = frame.hit.members;
    frame.through.through = true;
    way.line.origin = frame.hit.point;
    way.line.origin_error = frame.hit.point_error;
    way.from = &frame.through;
    way.inside = next;
    if (!(rest > 0)) break;
  }
  if (lit) {
    rest = std::max(rest, 0.0);
    InsideNode const* const at_lamp = tracer_.travel(way, rest, light);
    Medium const& medium = stage_.media[static_cast<std::size_t>(tracer_.medium_of(at_lamp))];
    for (int k = 0; k < each(); ++k) // the lamp stands in it
      left[k] *= shadow_fade(medium, light.channel[k], way.travelled + rest);
  }
  --tracer_.depth_;
}

template class Shader<0>;
template class Shader<1>;
template class Shader<3>;

} // namespace abbe::render
