// SPDX-License-Identifier: MIT
#include "optics/refract.hpp"
#include "render/shader.hpp"

#include <algorithm>
#include <cmath>

/// What happens where a ray meets a surface: Fresnel and Snell per lane, then the reflected and the
/// transmitted rays, split by wavelength where the material disperses.
namespace abbe::render {
namespace {

/// cos and sin^2 of the angle of incidence for unit vectors, the sine without cancellation.
struct Incidence {
  double cos_i;
  double sin2_i;
};
Incidence incidence(Vec3 const& direction, Vec3 const& normal) {
  Vec3 const cross = glm::cross(direction, normal);
  return {std::clamp(-glm::dot(direction, normal), 0.0, 1.0),
          std::min(1.0, glm::dot(cross, cross))};
}

} // namespace

void Tracer::find_normals(PathRay const& ray, Frame& frame, LaneInterface& face) {
  face.carrier = carrier_of(frame.hit.crossings);
  auto const& chosen = frame.hit.crossings[face.carrier];
  auto const [smoothed, geometric] =
      stage_.world->normals(chosen.primitive, chosen.face, frame.hit.point);
  face.normal = smoothed;
  face.geometric = geometric;
  Vec3 const& d = ray.line.direction;
  if (glm::dot(d, face.geometric) > 0) face.geometric = -face.geometric;
  // Corner normals need not agree with the winding of their face.
  if (glm::dot(face.normal, face.geometric) < 0) face.normal = -face.normal;
  // A smoothed normal may lean away from the viewer.
  if (glm::dot(d, face.normal) >= 0) face.normal = face.geometric;
}

void Tracer::find_interface(Beam const& beam, Vec3 const& direction, LaneInterface& face) {
  auto const n = static_cast<std::size_t>(beam.lanes);
  face.reflectance = arena_.take<double>(n);
  face.transmittance = arena_.take<double>(n);
  face.total = arena_.take<bool>(n);
  auto const [cos_i, sin2_i] = incidence(direction, face.normal);
  face.cos_i = cos_i;
  Medium const& before = stage_.media[static_cast<std::size_t>(face.before)];
  Medium const& after = stage_.media[static_cast<std::size_t>(face.after)];
  face.fresnel = before.fresnel || after.fresnel;
  face.split_medium = after.dispersive ? face.after : face.before;
  Medium const& governing = stage_.media[static_cast<std::size_t>(face.split_medium)];
  bool const disperses = face.before != face.after && !beam.locked && governing.dispersive;
  face.comb = beam.comb != no_comb ? beam.comb : governing.comb;
  optics::Comb const* const comb =
      face.comb != no_comb ? &stage_.combs[static_cast<std::size_t>(face.comb)] : nullptr;
  face.doubles = comb && comb->follow == optics::Comb::Follow::Doubled;
  face.picks = disperses && comb && comb->picks_one();
  // The companion of a comb goes on as if nothing dispersed.
  face.splits = disperses && !(beam.control && comb);
  if (!face.splits) {
    double const n1 = index_of(face.before, beam);
    double const n2 = index_of(face.after, beam);
    face.bends = n1 != n2;
    face.common = face.bends ? optics::fresnel<double>(n1, n2, n2 - n1, cos_i, sin2_i)
                             : optics::Interface<double>{cos_i, 1, 0, 0, 1, false};
    std::fill_n(face.reflectance, n, face.common.reflectance);
    std::fill_n(face.transmittance, n, face.common.transmittance);
    std::fill_n(face.total, n, face.common.total);
    return;
  }
  face.bends = true;
  face.split_wave = !comb                                  ? band_means
                    : face.doubles && beam.comb != no_comb ? waves_.second_draw(face.comb)
                                                           : waves_.first_draw(face.comb);
  // What meets its first comb gets the teeth of it next (meet_comb).
  if (comb && beam.comb == no_comb && !face.doubles) return;
  std::size_t const sample = sample_of(beam);
  auto const n1 = waves_.indices(face.before, face.split_wave, sample);
  auto const n2 = waves_.indices(face.after, face.split_wave, sample);
  int const first = beam.comb == no_comb ? 0 : waves_.first_tooth(beam.comb, sample);
  face.per_lane = arena_.take<optics::Interface<double>>(n);
  for (std::size_t k = 0; k < n; ++k) {
    auto const c = static_cast<std::size_t>(beam.tooth[k] - first);
    face.per_lane[k] = optics::fresnel<double>(n1[c], n2[c], n2[c] - n1[c], cos_i, sin2_i);
    face.reflectance[k] = face.per_lane[k].reflectance;
    face.transmittance[k] = face.per_lane[k].transmittance;
    face.total[k] = face.per_lane[k].total;
  }
}

void Tracer::interact(PathRay const& ray, Beam& beam, Frame& frame) {
  LaneInterface face;
  InsideNode const* after = after_crossings(ray.inside, frame.hit);
  if (stage_.has_priorities) {
    drop_displaced(ray.inside, after, frame.hit);
    if (frame.hit.crossings.empty()) return pass(ray, beam, frame, after);
  }
  face.before = medium_of(ray.inside);
  face.after = medium_of(after);
  Medium const& before = stage_.media[static_cast<std::size_t>(face.before)];
  if (ray.inside != after && before.fade_distance != 0)
    for (int k = 0; k < beam.lanes; ++k)
      beam.throughput[k] *= distance_fade(before, beam.channel[k], ray.travelled + frame.hit.t);
  find_normals(ray, frame, face);
  find_interface(beam, ray.line.direction, face);
  if (face.splits && face.comb != no_comb && beam.comb == no_comb)
    return meet_comb(ray, beam, frame, face, after);
  LaneSurface const surface = shade(ray, beam, frame, face, after);
  reflect(ray, beam, frame, face, surface);
  transmit(ray, beam, frame, face, surface, after);
}

void Tracer::pass(PathRay const& ray, Beam const& beam, Frame& frame, InsideNode const* after) {
  frame.through.on = frame.hit.members;
  frame.through.through = true;
  PathRay next = ray;
  next.line = {frame.hit.point, ray.line.direction, frame.hit.point_error};
  next.from = &frame.through;
  next.inside = after;
  next.travelled += frame.hit.t;
  trace(next, beam);
}

Vec3 Tracer::mirrored_direction(Vec3 const& incident, LaneInterface const& face) {
  Vec3 const direction = optics::reflected(incident, face.normal);
  double const below = glm::dot(direction, face.geometric);
  if (!(below < 0)) return direction;
  // A smoothed normal must not send it through the surface.
  return glm::normalize(direction - face.geometric * (2 * below));
}

void Tracer::reflect(PathRay const& ray, Beam const& beam, Frame& frame, LaneInterface const& face,
                     LaneSurface const& surface) {
  bool const returns =
      surface.mirrors || face.fresnel
      || std::any_of(face.total, face.total + beam.lanes, [](bool total) { return total; });
  if (!returns) return;
  Arena::Scope const scope(arena_);
  Beam mirrored = beam;
  mirrored.throughput = arena_.take<double>(static_cast<std::size_t>(beam.lanes));
  bool captures = surface.mirrors && surface.exponent != 1;
  bool const passes = any_above(surface.passed, beam.lanes, 0);
  for (int k = 0; k < beam.lanes; ++k) {
    captures = captures && !face.total[k];
    mirrored.throughput[k] = beam.throughput[k] * surface.mirrored_weight(face, k, passes);
  }
  if (!any_above(mirrored.throughput, beam.lanes, stage_.adc_bailout))
    return cut(mirrored, beam.lanes);
  if (face.splits && face.doubles && beam.comb == no_comb) mirrored = doubled(mirrored, face.comb);
  frame.back.on = frame.hit.members;
  frame.back.through = false;
  PathRay const next{
      {frame.hit.point, mirrored_direction(ray.line.direction, face), frame.hit.point_error},
      &frame.back,
      ray.inside,
      ray.level + 1,
      reflection_bit};
  ++counts_.reflected;
  if (captures)
    reflect_bent(next, mirrored, surface.exponent);
  else
    trace(next, mirrored);
}

void Tracer::transmit(PathRay const& ray, Beam const& beam, Frame& frame, LaneInterface const& face,
                      LaneSurface const& surface, InsideNode const* after) {
  if (!any_but_zero(surface.passed, beam.lanes)) return;
  Arena::Scope const scope(arena_);
  Beam passed = beam;
  passed.throughput = arena_.take<double>(static_cast<std::size_t>(beam.lanes));
  for (int k = 0; k < beam.lanes; ++k)
    passed.throughput[k] = beam.throughput[k] * surface.passed_weight(face, k);
  if (!any_above(passed.throughput, beam.lanes, stage_.adc_bailout)) return cut(passed, beam.lanes);
  frame.through.on = frame.hit.members;
  frame.through.through = true;
  if (face.splits) return split(ray, passed, frame, face, after);
  if (face.picks) passed.slot = picked_control_slots(passed);
  PathRay next{{frame.hit.point, ray.line.direction, frame.hit.point_error},
               &frame.through,
               after,
               ray.level,
               ray.mask};
  if (face.bends) {
    next.line.direction = optics::refracted(face.common, ray.line.direction, face.normal);
    ++next.level;
  }
  ++counts_.refracted;
  trace(next, passed);
}

} // namespace abbe::render
