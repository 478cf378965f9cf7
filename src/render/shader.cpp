// SPDX-License-Identifier: MIT
#include "render/shader.hpp"

#include "render/fan_shadows.hpp"
#include "render/pigment.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace abbe::render {
namespace {

/// POV-Ray's "Fresnel" tint of metallic highlights, x = angle / 90 degrees.
double metallic_falloff(double cosine) {
  double const x = std::acos(std::clamp(cosine, -1.0, 1.0)) / (std::numbers::pi / 2);
  double const d = x - 1.12;
  return std::clamp(0.014567225 / (d * d) - 0.011612903, 0.0, 1.0);
}

double largest(double const* values, int n) {
  double best = 0;
  for (int k = 0; k < n; ++k) best = std::max(best, values[k]);
  return best;
}

} // namespace

double distance_fade(Medium const& medium, int channel, double distance) {
  if (medium.fade_power == 0 || medium.fade_distance == 0) return 1;
  double const colour =
      medium.fade_colour.empty() ? 0 : medium.fade_colour[static_cast<std::size_t>(channel)];
  double const depth = distance / medium.fade_distance;
  if (medium.fade_power >= 1000) return std::exp(-(1 - colour) * depth);
  return colour + (1 - colour) / (1 + std::pow(depth, medium.fade_power));
}

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

template <int Lanes>
Shader<Lanes>::Shader(Tracer& tracer, PathRay const& ray, Beam const& beam, Tracer::Frame& frame,
                      LaneInterface const& face, InsideNode const* inside_after,
                      FanShadows* shadows, std::size_t lane)
    : tracer_(tracer),
      stage_(tracer.stage_),
      ray_(ray),
      beam_(beam),
      frame_(frame),
      face_(face),
      inside_after_(inside_after),
      shadows_(shadows),
      lane_(lane) {}

template <int Lanes>
LaneSurface Shader<Lanes>::shade() {
  LaneSurface out;
  out.passed = take_lanes(1.0);
  out.mirrored = take_lanes(0.0);
  // What is left comes before what is entered: that is the order in which the light meets them.
  for (bool const entering : {false, true})
    for (auto const& crossing : frame_.hit.crossings)
      if (crossing.entering == entering) {
        shade_surface(crossing, out);
        if (!any_left(out.passed)) return out;
      }
  return out;
}

template <int Lanes>
void Shader<Lanes>::shade_surface(geometry::SurfaceCrossing const& crossing, LaneSurface& out) {
  Surface const& surface = stage_.surfaces[crossing.primitive];
  bool const carries = &crossing == &frame_.hit.crossings[face_.carrier];
  if (!crossing.entering && !surface.interior_layers.empty())
    return shade_layers(surface.interior_layers, surface.double_illuminate, carries, out);
  if (surface.face_layers.empty())
    return shade_layers(surface.layers, surface.double_illuminate, carries, out);
  auto const of_face = [&](int number) -> std::vector<int> const& {
    return number < 0 ? surface.layers : surface.face_layers[static_cast<std::size_t>(number)];
  };
  geometry::Shape const& shape = stage_.world->shape(crossing.primitive);
  auto const blend = stage_.world->face_blend(crossing.primitive, crossing.face, frame_.hit.point);
  if (!blend)
    return shade_layers(of_face(shape.face_texture(crossing.face)), surface.double_illuminate,
                        carries, out);

  // Each texture shades its share of the light.
  auto const n = static_cast<std::size_t>(lanes());
  double* const arriving = out.passed;
  double* const left = take_lanes(0.0);
  double* const part = take_lanes();
  double* const mirrored = take_lanes();
  std::copy_n(out.mirrored, n, mirrored);
  for (std::size_t corner = 0; corner < blend->count; ++corner) {
    double const share = blend->share[corner];
    for (std::size_t k = 0; k < n; ++k) {
      part[k] = arriving[k] * share;
      out.mirrored[k] = 0;
    }
    out.passed = part;
    shade_layers(of_face(blend->texture[corner]), surface.double_illuminate, carries, out);
    for (std::size_t k = 0; k < n; ++k) {
      left[k] += part[k];
      mirrored[k] += out.mirrored[k] * share;
    }
  }
  std::copy_n(mirrored, n, out.mirrored);
  out.passed = left;
}

template <int Lanes>
void Shader<Lanes>::shade_layers(std::vector<int> const& layers, bool double_illuminate,
                                 bool carries, LaneSurface& out) {
  for (auto layer = layers.rbegin(); layer != layers.rend(); ++layer) {
    Arena::Scope const scope(tracer_.arena_);
    shade_layer(stage_.layers[static_cast<std::size_t>(*layer)], double_illuminate, carries, out);
    double const rest = largest(out.passed, lanes());
    if (rest == 0 || (rest <= stage_.adc_bailout && stage_.adc_bailout > 0)) break;
  }
}

template <int Lanes>
void Shader<Lanes>::shade_layer(CompiledLayer const& layer, bool double_illuminate, bool carries,
                                LaneSurface& out) {
  CompiledFinish const& finish = layer.finish;
  PigmentValue const pigment = pigment_at(layer, frame_.hit.point);
  double const opaque = opacity(stage_, pigment, lanes());
  if (opaque != 0) add_glow(finish, pigment.colour, opaque, out.passed);
  bool const shines = finish.phong != 0 || finish.specular != 0;
  bool const scatters = opaque != 0 && (finish.diffuse != 0 || finish.diffuse_back != 0);
  if (shines || scatters) add_lights(finish, pigment.colour, opaque, double_illuminate, out.passed);

  double* mirror = nullptr;
  if (finish.reflection) {
    mirror = take_lanes();
    reflectivity(*finish.reflection, pigment.colour, carries, mirror);
    for (int k = 0; k < lanes(); ++k) {
      out.mirrored[k] += mirror[k];
      out.mirrors = out.mirrors || mirror[k] != 0;
    }
    if (carries || out.exponent == 1) out.exponent = finish.reflection->exponent;
    out.explicit_reflection = out.explicit_reflection || carries;
  }
  for (int k = 0; k < lanes(); ++k) {
    out.passed[k] *= pigment.filter * pigment.colour[k] + pigment.transmit;
    if (mirror && finish.conserve_energy)
      out.passed[k] *= std::min(1.0, std::max(0.0, 1 - mirror[k]));
  }
}

template <int Lanes>
PigmentValue Shader<Lanes>::pigment_at(CompiledLayer const& layer, Vec3 const& world_point) {
  CompiledPigment const& pigment = stage_.pigments[static_cast<std::size_t>(layer.pigment)];
  if (!pigment.pattern) return plain_pigment<Lanes>(pigment, beam_, tracer_.arena_);
  return evaluate_pigment<Lanes>(stage_, layer.pigment,
                                 layer.to_texture_linear * world_point + layer.to_texture_offset,
                                 beam_, tracer_.arena_);
}

template <int Lanes>
void Shader<Lanes>::add_glow(CompiledFinish const& finish, double const* pigment, double opaque,
                             double const* passed) {
  if (finish.ambient.empty() && finish.emission.empty()) return;
  for (int k = 0; k < lanes(); ++k) {
    double glow = 0;
    if (!finish.ambient.empty()) glow += finish.ambient[beam_.channel[k]];
    if (!finish.emission.empty()) glow += finish.emission[beam_.channel[k]];
    tracer_.out_[beam_.slot[k]] += beam_.throughput[k] * passed[k] * pigment[k] * opaque * glow;
  }
}

template <int Lanes>
void Shader<Lanes>::add_lights(CompiledFinish const& finish, double const* pigment, double opaque,
                               bool double_illuminate, double const* passed) {
  for (auto const& light : stage_.lights)
    add_light(light, finish, pigment, opaque, double_illuminate, passed);
}

template <int Lanes>
void Shader<Lanes>::add_light(CompiledLight const& light, CompiledFinish const& finish,
                              double const* pigment, double opaque, bool double_illuminate,
                              double const* passed) {
  Vec3 to_light;
  double distance = 0;
  bool const comes = shadows_ ? shadows_->towards(light, lane_, to_light, distance)
                              : towards(light, frame_.hit.point, to_light, distance);
  if (!comes) return;
  double strength = 1;
  if (light.kind == scene::Light::Kind::Spot) {
    double const cosine = -glm::dot(to_light, light.direction);
    if (cosine <= 0 || cosine < light.cos_falloff) return;
    if (light.tightness > 0) strength = std::pow(cosine, light.tightness);
    if (cosine < light.cos_radius) {
      double const x = (cosine - light.cos_falloff) / (light.cos_radius - light.cos_falloff);
      strength *= x * x * (3 - 2 * x);
    }
  }
  if (light.fade_power > 0 && light.fade_distance != 0)
    strength *= 2 / (1 + std::pow(distance / light.fade_distance, light.fade_power));
  if (strength == 0) return;

  double const cosine = glm::dot(face_.normal, to_light);
  double diffuse = 0;
  if (opaque != 0) {
    double const amount = cosine > 0 || double_illuminate ? finish.diffuse : finish.diffuse_back;
    if (amount != 0 && cosine != 0) {
      double const lambert = std::abs(cosine);
      diffuse = opaque * amount
                * (finish.brilliance == 1 ? lambert : std::pow(lambert, finish.brilliance));
    }
  }
  double shine = 0;
  if (!light.shadowless && (cosine > 0 || double_illuminate)) {
    Vec3 const& view = ray_.line.direction;
    if (finish.phong != 0) {
      Vec3 const mirrored = view - face_.normal * (2 * glm::dot(view, face_.normal));
      double const along = glm::dot(mirrored, to_light);
      if (along > 0)
        shine +=
            finish.phong * (finish.phong_size == 1 ? along : std::pow(along, finish.phong_size));
    }
    if (finish.specular != 0) {
      Vec3 const half = to_light - view;
      double const length = glm::length(half);
      double const along = length > 0 ? glm::dot(face_.normal, half) / length : 0;
      if (along > 0) shine += finish.specular * std::pow(along, 1 / finish.roughness);
    }
  }
  if (diffuse == 0 && shine == 0) return;

  Arena::Scope const scope(tracer_.arena_);
  double* left = nullptr;
  if (!light.shadowless) {
    left = take_lanes(1.0);
    if (!visible(light, to_light, distance, left)) return;
  }
  double const tint = finish.metallic != 0 ? finish.metallic * (1 - metallic_falloff(cosine)) : 0;
  for (int k = 0; k < lanes(); ++k) {
    double const arriving = light.value[beam_.channel[k]] * strength * (left ? left[k] : 1);
    double const gloss = shine * (1 + tint * (pigment[k] - 1));
    tracer_.out_[beam_.slot[k]] +=
        beam_.throughput[k] * passed[k] * arriving * (pigment[k] * diffuse + gloss);
  }
}

template <int Lanes>
void Shader<Lanes>::reflectivity(CompiledReflection const& reflection, double const* pigment,
                                 bool carries, double* out) {
  double const cosine = face_.cos_i;
  double const weight =
      reflection.fresnel || reflection.falloff == 0 ? 0 : std::pow(1 - cosine, reflection.falloff);
  double const tint =
      reflection.metallic != 0 ? reflection.metallic * (1 - metallic_falloff(cosine)) : 0;
  for (int k = 0; k < lanes(); ++k) {
    auto const c = beam_.channel[k];
    double const f = reflection.fresnel        ? (carries ? face_.reflectance[k] : 0)
                     : reflection.falloff == 0 ? 1
                                               : weight;
    if (!reflection.metal_n.empty()) {
      out[k] = optics::conductor_reflectance<double>(reflection.metal_n[c], reflection.metal_k[c],
                                                     cosine);
      continue;
    }
    out[k] = f * reflection.maximum[c] + (1 - f) * reflection.minimum[c];
    if (tint != 0) out[k] *= 1 + tint * (pigment[k] - 1);
  }
}

template <int Lanes>
bool Shader<Lanes>::visible(CompiledLight const& light, Vec3 const& to_light, double distance,
                            double* left) {
  ++tracer_.counts_.shadow;
  if (shadows_) {
    FanShadows::Way const way = shadows_->way(light, lane_);
    if (way != FanShadows::Way::Unknown) return way == FanShadows::Way::Free;
  }
  geometry::Departure& from = frame_.shadow;
  from.on = frame_.hit.members;
  from.through = glm::dot(face_.geometric, to_light) < 0;
  geometry::Ray const line{frame_.hit.point, to_light, frame_.hit.point_error};
  if (stage_.world->occluded(line, &from, opaque_shadow_bit, distance, *tracer_.scratch_))
    return false;
  if (stage_.has_filter_shadows) {
    filter_shadow(to_light, distance, left);
    return any_left(left);
  }
  return true;
}

template <int Lanes>
void Shader<Lanes>::filter_shadow(Vec3 const& to_light, double distance, double* left) {
  PathRay way{{frame_.hit.point, to_light, frame_.hit.point_error},
              &frame_.shadow,
              frame_.shadow.through ? inside_after_ : ray_.inside,
              0,
              filter_shadow_bit};
  ++tracer_.depth_;
  Tracer::Frame& frame = tracer_.frame(tracer_.depth_, way, beam_);
  double rest = distance;
  bool lit = true;
  Beam light = beam_; // what is left of it
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
      for (int k = 0; k < lanes(); ++k)
        left[k] *= distance_fade(medium, beam_.channel[k], travelled);
    for (auto const& crossing : frame.hit.crossings) {
      for (int const number : stage_.surfaces[crossing.primitive].layers) {
        Arena::Scope const scope(tracer_.arena_);
        CompiledLayer const& layer = stage_.layers[static_cast<std::size_t>(number)];
        PigmentValue const pigment = pigment_at(layer, frame.hit.point);
        for (int k = 0; k < lanes(); ++k)
          left[k] *= pigment.filter * pigment.colour[k] + pigment.transmit;
      }
    }
    lit = any_left(left);
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
    for (int k = 0; k < lanes(); ++k) // the lamp stands in it
      left[k] *= distance_fade(medium, beam_.channel[k], way.travelled + rest);
  }
  --tracer_.depth_;
}

LaneSurface Tracer::shade(PathRay const& ray, Beam const& beam, Frame& frame,
                          LaneInterface const& face, InsideNode const* after, FanShadows* shadows,
                          std::size_t lane) {
  if (beam.lanes == 1)
    return Shader<1>(*this, ray, beam, frame, face, after, shadows, lane).shade();
  if (beam.lanes == 3)
    return Shader<3>(*this, ray, beam, frame, face, after, shadows, lane).shade();
  return Shader<0>(*this, ray, beam, frame, face, after, shadows, lane).shade();
}

} // namespace abbe::render
