// SPDX-License-Identifier: MIT
#pragma once

#include "scene/scene.hpp"

#include <cstdint>
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
  /// Of each sample, at most.
  std::uint64_t rays() const { return rays_; }
  /// How many to take of a sample before enough() is asked first, and then of each that has
  /// `taken`.
  std::uint64_t next_rays(std::uint64_t taken) const;
  /// Is the variance of the mean of `count` lights, as far as they show, small enough with the
  /// camera's confidence? By the sum of their squares' distances from it, of one component.
  /// @source Lee, Redner, Uselton: Statistically Optimized Sampling for Distributed Ray Tracing,
  /// SIGGRAPH 1985 (a chi-squared test); its quantiles by Wilson and Hilferty 1931
  bool enough(std::uint64_t count, double squares) const;
  /// Moves each of the first rays to where ray number SampleKey::lens passes the lens.
  /// @param keys of the samples that the rays are of; those of one sample follow each other
  void spread(Rays& rays, std::span<SampleKey const> keys) const;

private:
  /// A sample's points on the lens, in its radii.
  class Points;
  Vec3 right_{0}, up_{0}; ///< of the disc's radius
  Vec3 ahead_{0};
  double focal_distance_ = 1;
  std::uint64_t rays_ = 1;
  double variance_ = 0;
  double quantile_ = 0; ///< of the normal distribution, which `confidence` is above
  std::shared_ptr<texture::Pattern const> bokeh_; ///< null: a disc
};

} // namespace abbe::transport
