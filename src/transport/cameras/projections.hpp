// SPDX-License-Identifier: MIT
#pragma once

#include "transport/cameras/camera.hpp"

/// POV-Ray's projections beside perspective and orthographic, a file each. Their formulas are those
/// of the language notes, section 12, and give POV-Ray's directions to 2e-5, the accuracy of its
/// 16-bit pictures.
namespace abbe::transport {

std::unique_ptr<Camera const> make_fisheye(scene::Camera const&);
std::unique_ptr<Camera const> make_omnimax(scene::Camera const&);
std::unique_ptr<Camera const> make_ultra_wide_angle(scene::Camera const&);
std::unique_ptr<Camera const> make_panoramic(scene::Camera const&);
std::unique_ptr<Camera const> make_cylinder(scene::Camera const&);
std::unique_ptr<Camera const> make_spherical(scene::Camera const&);
std::unique_ptr<Camera const> make_mesh_camera(scene::Camera const&);

} // namespace abbe::transport
