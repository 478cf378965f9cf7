// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/shape.hpp"
#include "scene/scene.hpp"

namespace abbe::render {

/// The ray through a point of the picture, relative to the camera (which stands at the origin).
/// @param x, y in pixels, (0, 0) the upper left corner of the picture
/// @source language notes, section 12
geometry::Ray camera_ray(scene::Camera const& camera, double x, double y, int width, int height);

} // namespace abbe::render
