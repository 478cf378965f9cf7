// SPDX-License-Identifier: MIT
#include "render/fan_shadows.hpp"
#include "render/shader.hpp"

#include <algorithm>
#include <cmath>

/// What lamps add to a surface.
namespace abbe::render {

bool towards(CompiledLight const& light, Vec3 const& point, Vec3& direction, double& distance) {
  if (light.kind == scene::Light::Kind::Parallel) {
    distance = glm::dot(point - light.position, light.direction);
    direction = -light.direction;
    return distance > 0; // not behind the plane of the light
  }
  direction = light.position - point;
  distance = glm::length(direction);
  if (distance == 0) return false;
  direction /= distance;
  return true;
}

namespace {

/// Of a lamp's light in this direction and at this distance.
double strength_of(CompiledLight const& light, Vec3 const& to_light, double distance) {
  double strength = 1;
  if (light.kind == scene::Light::Kind::Spot) {
    double const cosine = -glm::dot(to_light, light.direction);
    if (cosine <= 0 || cosine < light.cos_falloff) return 0;
    if (light.tightness > 0) strength = std::pow(cosine, light.tightness);
    if (cosine < light.cos_radius) {
      double const x = (cosine - light.cos_falloff) / (light.cos_radius - light.cos_falloff);
      strength *= x * x * (3 - 2 * x);
    }
  }
  if (light.fade_power > 0 && light.fade_distance != 0)
    strength *= 2 / (1 + std::pow(distance / light.fade_distance, light.fade_power));
  return strength;
}

/// Highlights by phong and specular.
double shine_of(CompiledFinish const& finish, Vec3 const& view, Vec3 const& normal,
                Vec3 const& to_light) {
  double shine = 0;
  if (finish.phong != 0) {
    Vec3 const mirrored = view - normal * (2 * glm::dot(view, normal));
    double const along = glm::dot(mirrored, to_light);
    if (along > 0)
      shine += finish.phong * (finish.phong_size == 1 ? along : std::pow(along, finish.phong_size));
  }
  if (finish.specular != 0) {
    Vec3 const half = to_light - view;
    double const length = glm::length(half);
    double const along = length > 0 ? glm::dot(normal, half) / length : 0;
    if (along > 0) shine += finish.specular * std::pow(along, 1 / finish.roughness);
  }
  return shine;
}

} // namespace

template <int Lanes>
auto Shader<Lanes>::light_up(CompiledLight const& light, CompiledFinish const& finish,
                             Pigments const& pigment, bool double_illuminate, Rays rays, Lit& out)
    -> Rays {
  bool const shines = !light.shadowless && (finish.phong != 0 || finish.specular != 0);
  Rays lit = 0;
  each_ray(rays, [&](std::size_t r, int) {
    Vec3 to_light;
    double distance = 0;
    bool const comes = shadows_ ? shadows_->towards(light, r, to_light, distance)
                                : towards(light, met_.point->get(r), to_light, distance);
    if (!comes) return;
    double const strength = strength_of(light, to_light, distance);
    if (strength == 0) return;
    Vec3 const normal = met_.normal->get(r);
    double const cosine = glm::dot(normal, to_light);
    double diffuse = 0;
    if (pigment.opaque[r] != 0) {
      double const amount = cosine > 0 || double_illuminate ? finish.diffuse : finish.diffuse_back;
      if (amount != 0 && cosine != 0) {
        double const lambert = std::abs(cosine);
        diffuse = pigment.opaque[r] * amount
                  * (finish.brilliance == 1 ? lambert : std::pow(lambert, finish.brilliance));
      }
    }
    double const shine = shines && (cosine > 0 || double_illuminate)
                             ? shine_of(finish, met_.direction->get(r), normal, to_light)
                             : 0;
    if (diffuse == 0 && shine == 0) return;
    lit |= Rays{1} << r;
    out.strength[r] = strength;
    out.diffuse[r] = diffuse;
    out.shine[r] = shine;
    out.cosine[r] = cosine;
    out.distance[r] = distance;
    out.to_light.set(r, to_light);
  });
  return lit;
}

template <int Lanes>
void Shader<Lanes>::add_light(CompiledLight const& light, CompiledFinish const& finish,
                              Pigments const& pigment, bool double_illuminate, Rays rays,
                              double const* passed) {
  Lit lit;
  rays = light_up(light, finish, pigment, double_illuminate, rays, lit);
  if (rays == 0) return;
  Arena::Scope const scope(tracer_.arena_);
  bool const filtered = !light.shadowless && stage_.has_filter_shadows;
  double* const left = filtered ? take_lanes(1.0) : nullptr;
  each_ray(rays, [&](std::size_t r, int first) {
    if (!light.shadowless && !visible(light, lit, r, filtered ? left + first : nullptr)) return;
    double const diffuse = lit.diffuse[r], shine = lit.shine[r], strength = lit.strength[r];
    double const tint =
        finish.metallic != 0 ? finish.metallic * (1 - metallic_falloff(lit.cosine[r])) : 0;
    for (int k = first; k < first + each(); ++k) {
      double const arriving = light.value[beam_.channel[k]] * strength * (filtered ? left[k] : 1);
      double const gloss = shine * (1 + tint * (pigment.colour[k] - 1));
      tracer_.out_[beam_.slot[k]] +=
          beam_.throughput[k] * passed[k] * arriving * (pigment.colour[k] * diffuse + gloss);
    }
  });
}

template <int Lanes>
bool Shader<Lanes>::visible(CompiledLight const& light, Lit const& lit, std::size_t r,
                            double* left) {
  ++tracer_.counts_.shadow;
  if (shadows_) {
    FanShadows::Way const way = shadows_->way(light, r);
    if (way == FanShadows::Way::Filtered) std::copy_n(shadows_->left(light, r), each(), left);
    if (way != FanShadows::Way::Unknown) return way != FanShadows::Way::Blocked;
  }
  Vec3 const to_light = lit.to_light.get(r);
  geometry::Departure& from = frame_.shadow;
  from.on = frame_.hit.members;
  from.through = glm::dot(met_.geometric->get(r), to_light) < 0;
  geometry::Ray const line{met_.point->get(r), to_light, met_.point_error->get(r)};
  if (stage_.world->occluded(line, &from, opaque_shadow_bit, lit.distance[r], *tracer_.scratch_))
    return false;
  if (!left) return true;
  filter_shadow(to_light, lit.distance[r], r, left);
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
  while (lit
         && tracer_.stage_.world->closest(way.line, way.from, filter_shadow_bit, rest,
                                          *tracer_.scratch_, frame.hit)) {
    way.inside = tracer_.travel(way, frame.hit.t, light);
    Medium const& medium = stage_.media[static_cast<std::size_t>(tracer_.medium_of(way.inside))];
    InsideNode const* next = tracer_.after_crossings(way.inside, frame.hit);
    if (stage_.has_priorities) tracer_.drop_displaced(way.inside, next, frame.hit);
    double const travelled = way.travelled + frame.hit.t;
    way.travelled = frame.hit.crossings.empty() ? travelled : 0;
    if (tracer_.medium_of(next) != tracer_.medium_of(way.inside))
      for (int k = 0; k < each(); ++k)
        left[k] *= distance_fade(medium, light.channel[k], travelled);
    for (auto const& crossing : frame.hit.crossings)
      tint(stage_, stage_.surfaces[crossing.primitive], frame.hit.point, light.channel, each(),
           left, tracer_.arena_);
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
      left[k] *= distance_fade(medium, light.channel[k], way.travelled + rest);
  }
  --tracer_.depth_;
}

template class Shader<0>;
template class Shader<1>;
template class Shader<3>;

} // namespace abbe::render
