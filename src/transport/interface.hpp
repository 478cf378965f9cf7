// SPDX-License-Identifier: MIT
#pragma once

#include "transport/chunk.hpp"

namespace abbe::transport {

/// Turns the normals of what the rays met to the side they come from, a smoothed one to agree with
/// the true one, and finds the angle of incidence and the mirrored directions.
/// @param smoothed some normal is not the geometric one
void face_rays(Chunk& chunk, bool smoothed);

/// Fresnel and Snell where each ray has one wavelength, or none distinguished: by Chunk::n1 and n2.
/// Refracted directions have no meaning at total reflection.
void refract_rays(Chunk& chunk);

/// Rays that are split at a surface: a lane a wavelength.
struct SplitLanes {
  double *reflectance = nullptr, *transmittance = nullptr; ///< a lane
  bool* total = nullptr;                                   ///< a lane
  double *x = nullptr, *y = nullptr, *z = nullptr; ///< refracted directions, where not total
};
/// Fresnel and Snell for all wavelengths of one ray; written four at a time, so that up to three
/// lanes beyond are overwritten.
/// @param n1, n2 indices of its lanes, whole lanes of four
void refract_lanes(Chunk const& chunk, std::size_t ray, double const* n1, double const* n2,
                   SplitLanes const& out);

} // namespace abbe::transport
