// SPDX-License-Identifier: MIT
#include "plan/reach.hpp"

#include "geometry/shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace abbe::plan {
namespace {

/// More lights than this are not looked at: the planes to try grow with their square.
constexpr std::size_t most_directions = 24;
constexpr double clear = 1e-6; ///< sine of the angle that an object must keep from the cone

/// The corners of all leaves' bounds in world space; false when one is infinite.
bool corners_of(scene::Object const& object, std::vector<Vec3>& out) {
  if (object.shape) {
    geometry::Bounds const bounds = object.shape->bounds();
    if (bounds.infinite || object.inverse) return false;
    geometry::Transform const placement = object.placement;
    if (!bounds.empty())
      for (int i = 0; i < 8; ++i)
        out.push_back(placement.point({i & 1 ? bounds.high.x : bounds.low.x,
                                       i & 2 ? bounds.high.y : bounds.low.y,
                                       i & 4 ? bounds.high.z : bounds.low.z}));
  }
  if (object.inverse || object.instance) return false;
  return std::all_of(object.children.begin(), object.children.end(),
                     [&](scene::Object const& child) { return corners_of(child, out); });
}

} // namespace

Reach::Reach(scene::Scene const& scene) : eye_(scene.camera.location) {
  scene::Camera const& camera = scene.camera;
  if (camera.kind != scene::Camera::Kind::Perspective || camera.aperture > 0 || camera.normal)
    return;
  std::vector<Vec3> directions;
  // Twice the picture: samples may lie beyond its edge by part of a pixel.
  for (double const x : {-1.0, 1.0})
    for (double const y : {-1.0, 1.0})
      directions.push_back(camera.direction + x * camera.right + y * camera.up);
  for (auto const& light : scene.lights) {
    if (light.shadowless) continue;
    bool const point =
        light.kind == scene::Light::Kind::Point || light.kind == scene::Light::Kind::Spot;
    if (light.area) {
      if (!point || light.area->orient) return; // ways to it go many ways
      // From edge to edge, and half a step beyond where places are drawn.
      for (double const x : {-1.0, 1.0})
        for (double const y : {-1.0, 1.0})
          directions.push_back(light.position - eye_ + x * light.area->axis1
                               + y * light.area->axis2);
      continue;
    }
    directions.push_back(light.position - eye_);
    if (!point) directions.push_back(light.position - light.point_at);
  }
  if (directions.size() > most_directions) return;
  for (Vec3& direction : directions) {
    double const length = glm::length(direction);
    if (!(length > 0) || !std::isfinite(length)) return;
    direction /= length;
  }
  // Planes that touch the cone along two of its directions.
  for (std::size_t i = 0; i < directions.size(); ++i)
    for (std::size_t j = i + 1; j < directions.size(); ++j) {
      Vec3 normal = glm::cross(directions[i], directions[j]);
      double const length = glm::length(normal);
      if (!(length > clear)) continue;
      normal /= length;
      for (Vec3 const& side : {normal, -normal})
        if (std::all_of(directions.begin(), directions.end(),
                        [&](Vec3 const& d) { return glm::dot(side, d) >= -clear * clear; }))
          normals_.push_back(side);
    }
}

bool Reach::apart(scene::Object const& object) const {
  if (normals_.empty()) return false;
  std::vector<Vec3> corners;
  if (!corners_of(object, corners) || corners.empty()) return false;
  for (Vec3& corner : corners) corner -= eye_;
  return std::any_of(normals_.begin(), normals_.end(), [&](Vec3 const& normal) {
    return std::all_of(corners.begin(), corners.end(), [&](Vec3 const& corner) {
      return glm::dot(normal, corner) < -clear * glm::length(corner);
    });
  });
}

} // namespace abbe::plan
