// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace abbe::render {

/// The wavelengths that the lanes of a beam stand for, as number of a wave table (wave_tables.hpp).
/// Polychromatic: the whole of each channel; a ray that no dispersing surface has split yet.
inline constexpr int polychromatic = -2;
/// The mean wavelength of each channel: the deterministic modes.
inline constexpr int band_means = -1;
/// Of a beam that no stochastic material has met.
inline constexpr int no_comb = -1;

/// What travels along one ray: lanes of light, each of one channel of the film.
///
/// A polychromatic beam has a lane a channel, or a tooth of a comb, in order; a monochromatic one
/// has one lane, and the published stochastic scheme (optics::Comb::Follow::Doubled) has two lanes
/// on one ray: the bands between which its wavelength falls. `slot` says where on the sample's film
/// a lane is added up (SampleFilm): light of combs is kept apart because it stands for the drawn
/// wavelengths until the sample is resolved.
struct Beam {
  int lanes = 0;
  std::uint16_t const* channel = nullptr; ///< of materials and lights, per lane
  std::uint16_t const* tooth = nullptr;   ///< of the lanes' wave table, per lane
  std::uint32_t const* slot = nullptr;    ///< of the sample's film, per lane
  double* throughput = nullptr;           ///< per lane
  int wave = polychromatic;
  int wave_tooth = 0; ///< the tooth of `wave` that a monochromatic beam follows
  /// Light that met a stochastic material keeps the wavelengths that were drawn there, whatever it
  /// meets later.
  int comb = no_comb;
  /// Not to be split again: false for a polychromatic beam and for the faithful scheme's doubled
  /// rays before their second refraction.
  bool locked = false;
  /// The companion of a beam that met a stochastic material: it goes on as if such materials did
  /// not disperse (SampleFilm says what for).
  bool control = false;

  bool monochromatic() const { return wave != polychromatic; }
  /// Lane k alone.
  Beam lane(int k) const { return ray(k, 1); }
  /// The light of ray k of a fan whose rays have `lanes_each`.
  Beam ray(int k, int lanes_each) const {
    Beam out = from(k * lanes_each, lanes_each);
    out.wave_tooth = out.tooth[0];
    return out;
  }
  /// `count` lanes, the first number k.
  Beam from(int k, int count) const {
    Beam out = *this;
    out.lanes = count;
    out.channel += k;
    out.tooth += k;
    out.slot += k;
    out.throughput += k;
    return out;
  }
};

} // namespace abbe::render
