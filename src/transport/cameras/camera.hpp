// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/batch.hpp"
#include "scene/scene.hpp"

#include <cstddef>
#include <limits>
#include <memory>

namespace abbe::transport {

/// How large a pixel is at a point that it shows, in scene units: the point's distance from the
/// camera decides, so that what is seen in a mirror counts as nearer than it is.
struct Footprint {
  double size = 0;      ///< where rays are side by side
  double angle_rad = 0; ///< where they come from one point
  double at(Vec3 const& point) const { return size + angle_rad * glm::length(point); }
};

/// Points of the picture, in pixels: (0, 0) is its upper left corner, (width, height) the lower
/// right one.
struct PicturePoints {
  double const *x, *y;
  std::size_t count;
  int width, height;
};

/// Rays of points of the picture, relative to the camera's location. A new one: a file here, and a
/// line in cameras.cpp.
/// @source language notes, section 12
class Camera {
public:
  explicit Camera(Vec3 const& location) : location_(location) {}
  virtual ~Camera() = default;
  /// In the scene's coordinates: the origin of the stage.
  Vec3 const& location() const { return location_; }
  /// Do all rays start at its location?
  virtual bool has_one_point() const = 0;
  /// Has every point of the picture a ray?
  virtual bool sees_all() const { return true; }
  /// So many rays each point of the picture has, whose mean counts; they follow each other.
  virtual int rays_of_point() const { return 1; }
  /// What is farther away on a ray is not seen.
  virtual double longest() const { return std::numeric_limits<double>::infinity(); }
  /// @param directions unit; 0 for a point that shows nothing. Origins and directions have room for
  /// all rays of the points
  virtual void rays(PicturePoints const& points, geometry::VectorArrays const& origins,
                    geometry::VectorArrays const& directions) const = 0;
  virtual Footprint footprint(int width, int height) const = 0;
  /// Where a `normal` of the camera is looked up, <x, y, 0>, for a point of the picture: the
  /// numbers that its projection begins with.
  /// @param a from -1/2 at the left to 1/2  @param b from -1/2 at the bottom to 1/2
  /// @source POV-Ray's pictures: rays of each projection to 2e-5
  virtual Vec2 place(double a, double b) const { return {a, b}; }

private:
  Vec3 location_;
};

/// Height or width of a pixel on the picture plane, whichever is less.
double pixel_size(scene::Camera const& camera, int width, int height);

/// The camera that the scene's is.
std::unique_ptr<Camera const> make_camera(scene::Camera const& camera);

} // namespace abbe::transport
