// SPDX-License-Identifier: MIT
#pragma once

#include "base/source.hpp"
#include "base/vec.hpp"
#include "texture/pattern.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

namespace abbe::scene {

struct Normal;

/// Meshes whose faces are the pixels of a picture. The camera's location and direction tell by
/// their z alone: how far in front of the faces rays begin, and to which side they go.
struct MeshCamera {
  struct Face {
    std::array<Vec3, 3> corners;
    Vec3 normal{0};              ///< unit
    std::array<Vec3, 3> normals; ///< unit, where smooth
    std::array<Vec2, 3> uv;
    bool smooth = false;
  };
  int rays_per_pixel = 1;
  /// 0: a mesh a ray; 1: all meshes together; 2: meshes side by side; 3: by uv.
  int distribution = 0;
  bool smooth = false; ///< of distribution 3: normals between the corners'
  double longest = 0;  ///< what is seen is nearer than this; 0: as far as it may be
  std::vector<std::vector<Face>> meshes;
};

/// As POV-Ray's camera after look_at, angle and transforms have been worked in.
struct Camera {
  enum class Kind : std::uint8_t {
    Perspective,
    Orthographic,
    Fisheye,
    UltraWideAngle,
    Omnimax,
    Panoramic,
    Cylinder,
    Spherical,
    Mesh
  };
  Span span;
  Kind kind = Kind::Perspective;
  std::uint8_t cylinder_type = 1; ///< 1 to 4, as written
  Vec3 location{0};
  Vec3 direction{0, 0, 1};
  Vec3 up{0, 1, 0};
  Vec3 right{1.33, 0, 0};
  /// What the picture shows across and, of Spherical, down; of kinds from Fisheye on.
  double angle_deg = 90, vertical_angle_deg = 90;
  /// Focal blur, of perspective and orthographic cameras: the diameter of the lens, the distance
  /// along `direction` at which all is sharp, and the rays of a sample. No lens: 0.
  double aperture = 0, focal_distance = 0;
  int blur_samples = 0;
  /// Fewer rays of the lens are enough once the variance of their mean is this with that
  /// confidence.
  double blur_variance = 1.0 / 128, blur_confidence = 0.9;
  /// How densely rays go through the lens, which then is a square, from <0, 0, 0> to <1, 1, 0>:
  /// values from 0 to 1. Null: a disc, evenly.
  std::shared_ptr<texture::Pattern const> bokeh;
  std::shared_ptr<MeshCamera const> mesh; ///< of Kind::Mesh
  /// Tilts its rays; looked up where the kind puts a point of the picture (Camera::place). Not
  /// moved with the camera.
  std::shared_ptr<Normal const> normal;
};
inline constexpr std::string_view camera_words[] = {
    "perspective", "orthographic", "fisheye",   "ultra_wide_angle", "omnimax",
    "panoramic",   "cylinder",     "spherical", "mesh_camera"};

} // namespace abbe::scene
