// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/fan.hpp"
#include "scene/scene.hpp"

namespace abbe::render {

/// The ray through a point of the picture, relative to the camera (which stands at the origin).
/// @param x, y in pixels, (0, 0) the upper left corner of the picture
/// @source language notes, section 12
geometry::Ray camera_ray(scene::Camera const& camera, double x, double y, int width, int height);

/// The same for some points side by side, with the same bits. @param rays as many as `count` says
void camera_rays(scene::Camera const& camera, double const* x, double const* y, int width,
                 int height, geometry::FanLines& rays);

/// How large a pixel is at a point that it shows, in scene units: the point's distance from the
/// camera decides, so that what is seen in a mirror counts as nearer than it is.
struct Footprint {
  double size = 0;      ///< of an orthographic camera
  double angle_rad = 0; ///< of a perspective one
  double at(Vec3 const& point) const { return size + angle_rad * glm::length(point); }
};
Footprint pixel_footprint(scene::Camera const& camera, int width, int height);

} // namespace abbe::render
