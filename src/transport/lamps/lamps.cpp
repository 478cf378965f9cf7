// SPDX-License-Identifier: MIT
#include "simd/math.hpp"
#include "transport/lamps/cylinder.hpp"
#include "transport/lamps/parallel.hpp"
#include "transport/lamps/point.hpp"
#include "transport/lamps/spot.hpp"

#include <algorithm>
#include <numbers>

namespace abbe::transport {
namespace {

double cos_degrees(double degrees) {
  return simd::cos(degrees * std::numbers::pi / 180);
}

} // namespace

std::unique_ptr<Lamp const> make_lamp(scene::Light const& light, Vec3 const& position,
                                      Lamp::Common common) {
  Vec3 const toward = light.point_at - light.position;
  double const length = glm::length(toward);
  Vec3 const direction = length > 0 ? toward / length : Vec3(0, 0, 1);
  double const cos_radius = cos_degrees(light.radius_deg);
  // A falloff within the radius is a hard edge at the radius.
  double const cos_falloff = std::min(cos_degrees(light.falloff_deg), cos_radius);
  using Kind = scene::Light::Kind;
  switch (light.kind) {
  case Kind::Point:
    return std::make_unique<PointLamp>(std::move(common), position);
  case Kind::Spot:
    return std::make_unique<SpotLamp>(std::move(common), position, direction, cos_radius,
                                      cos_falloff, light.tightness);
  case Kind::Parallel:
    return std::make_unique<ParallelLamp>(std::move(common), position, direction);
  case Kind::Cylinder:
    return std::make_unique<CylinderLamp>(std::move(common), position, direction, light.radius,
                                          light.falloff, light.tightness);
  }
  return nullptr;
}

} // namespace abbe::transport
