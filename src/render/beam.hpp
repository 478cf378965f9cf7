// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace abbe::render {

/// The wavelengths that the lanes of a beam stand for, as number of a wave table (wave_tables.hpp).
/// Polychromatic: the whole of each channel; a ray that no dispersing surface has split yet.
inline constexpr int polychromatic = -2;
/// The mean wavelength of each band: the deterministic mode.
inline constexpr int band_means = -1;

/// What travels along one ray: lanes of light, each of one channel of the film.
///
/// A polychromatic beam has a lane a channel, a monochromatic one has one lane, and the published
/// stochastic scheme ("faithful") has two lanes on one ray: the bands between which its wavelength
/// falls. `slot` says where on the sample's film a lane is added up (SampleFilm): stochastic paths
/// are kept apart because their bands stand for the jittered wavelengths until the sample is
/// resolved.
struct Beam {
  int lanes = 0;
  std::uint16_t const* channel = nullptr; ///< of materials and lights, per lane
  std::uint32_t const* slot = nullptr;    ///< of the sample's film, per lane
  double* throughput = nullptr;           ///< per lane
  int wave = polychromatic;
  int wave_band = 0; ///< the band of `wave` that a monochromatic beam follows
  /// Not to be split again: false for a polychromatic beam and for the faithful scheme's doubled
  /// rays before their second refraction.
  bool locked = false;
  /// The companion of a beam that met a stochastic material: it goes on as if such materials did
  /// not disperse (SampleFilm says what for).
  bool control = false;

  bool monochromatic() const { return wave != polychromatic; }
};

} // namespace abbe::render
