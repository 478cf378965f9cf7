// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/fan.hpp"

namespace abbe::render {

/// Fresnel and Snell where the rays of a fan meet one surface: LaneInterface for each ray.
struct FanInterface {
  geometry::FanVectors normal; ///< unit; made to face the rays
  alignas(32) double n1[geometry::fan_width], n2[geometry::fan_width]; ///< given

  alignas(32) double cos_i[geometry::fan_width];
  alignas(32) double reflectance[geometry::fan_width], transmittance[geometry::fan_width];
  alignas(32) double total[geometry::fan_width]; ///< 1 at total reflection, else 0
  alignas(
      32) double below[geometry::fan_width]; ///< of `mirrored` along the normal: < 0 by rounding
  geometry::FanVectors mirrored, refracted;  ///< directions; refracted where not total
};

/// Fills in what is not given, with the bits of the scalar path. Whole lanes of four.
void meet_fan(geometry::FanVectors const& direction, std::size_t count, FanInterface& face);
/// The same where n1 and n2 are equal for all rays; but refracted, which are the directions.
void meet_fan_unbent(geometry::FanVectors const& direction, std::size_t count, FanInterface& face);

/// One ray that is split at a surface, a lane a wavelength; and what comes of it: written four
/// lanes at a time, so that up to three lanes beyond are overwritten.
struct SplitLanes {
  double const *n1, *n2; ///< whole lanes of four
  std::size_t count;
  double *reflectance, *transmittance;
  bool* total;
  double *x, *y, *z; ///< refracted directions, where not total
};
/// Fresnel and Snell for all of its wavelengths, with the bits of the scalar path.
/// @param direction unit @param normal unit, against it
void meet_lanes(Vec3 const& direction, Vec3 const& normal, double cos_i, SplitLanes const& lanes);

} // namespace abbe::render
