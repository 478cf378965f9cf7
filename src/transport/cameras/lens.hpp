// SPDX-License-Identifier: MIT
#pragma once

#include "scene/scene.hpp"

#include <optional>
#include <span>

namespace abbe::transport {

class Rays;
struct SampleKey;

/// The lens of focal blur: a disc square to the camera's direction, from which rays aim at where
/// the ray through its middle meets the plane of focus. With `bokeh` it is a square, through which
/// rays go as densely as the pigment is light.
/// @source POV-Ray's pictures: the disc has a radius of a quarter of `aperture`, evenly lit; the
///         square is the one around it, with y downwards; densities go by the grey value, cut off
///         at 1
class Lens {
public:
  /// nullopt: the camera has none.
  static std::optional<Lens> of(scene::Camera const& camera);
  int rays() const { return rays_; }
  /// Each of the first rays becomes rays() rays, which follow each other; there is room for them.
  /// @param keys of the samples that the first rays are of
  void spread(Rays& rays, std::span<SampleKey const> keys) const;

private:
  /// A sample's points on the lens, in its radii.
  class Points;
  Vec3 right_{0}, up_{0}; ///< of the disc's radius
  Vec3 ahead_{0};
  double focal_distance_ = 1;
  int rays_ = 1;
  std::shared_ptr<texture::Pattern const> bokeh_; ///< null: a disc
};

} // namespace abbe::transport
