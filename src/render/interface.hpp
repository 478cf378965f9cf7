// SPDX-License-Identifier: MIT
#pragma once

#include "base/vec.hpp"
#include "geometry/fan.hpp"
#include "optics/fresnel.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace abbe::render {

/// Is there light at all? What has none is not even cut.
inline bool any_but_zero(double const* values, int n) {
  for (int k = 0; k < n; ++k)
    if (values[k] != 0) return true;
  return false;
}
inline bool any_above(double const* values, int n, double threshold) {
  for (int k = 0; k < n; ++k)
    if (values[k] > threshold) return true;
  return false;
}

/// The crossing (of a hit's) whose surface is shown where several coincide: the first that is
/// entered, else the first left. @return its place; 0 where there is none at all
inline std::size_t carrier_of(std::vector<geometry::SurfaceCrossing> const& crossings) {
  for (std::size_t i = 0; i < crossings.size(); ++i)
    if (crossings[i].entering) return i;
  return 0;
}

/// What an interface does to the lanes of a beam that meets it. Arrays are per lane, in the arena.
struct LaneInterface {
  Vec3 normal{0};    ///< unit shading normal on the side the ray comes from
  Vec3 geometric{0}; ///< the true one, same side
  /// carrier_of() the hit. Where others coincide with it, it alone reflects by Fresnel: there is
  /// one interface.
  std::size_t carrier = 0;
  double cos_i = 1;
  int before = 0; ///< media
  int after = 0;
  bool bends = false;   ///< the index changes
  bool splits = false;  ///< each lane goes its own way
  bool fresnel = false; ///< a real dielectric: reflects by Fresnel unasked
  int split_wave = 0;   ///< wave table of the split
  int split_medium = 0; ///< whose mode governs it
  int comb = -1;        ///< that draws the wavelengths of the split, or none
  bool doubles = false; ///< by the published scheme
  bool picks = false;   ///< one tooth goes on alone, or would if this were not its control light
  /// Fresnel reflectance and transmittance; 1 and 0 at total reflection.
  double* reflectance = nullptr;
  double* transmittance = nullptr;
  bool* total = nullptr;
  /// Snell for all lanes alike, where they do not split.
  optics::Interface<double> common{};
  /// For lanes that split.
  optics::Interface<double>* per_lane = nullptr;
};

/// What the textures at the interface let through and mirror, per lane.
struct LaneSurface {
  double* passed = nullptr;
  double* mirrored = nullptr; ///< asked for by `reflection`, to be added as it is
  bool mirrors = false;
  bool explicit_reflection =
      false; ///< a `reflection` item was given: Fresnel does not come unasked
  double exponent = 1;

  /// What returns of a lane's light, and what goes on.
  /// @param first the face's lane that is this one's first
  double mirrored_weight(LaneInterface const& face, int k, bool any_passes, int first = 0) const {
    double const asked = mirrored[k];
    // Total reflection returns everything that would have passed (unfiltered, as in POV-Ray).
    if (face.total[first + k]) return any_passes ? 1 : asked;
    bool const unasked = face.fresnel && !explicit_reflection;
    return unasked && passed[k] > 0 ? asked + face.reflectance[first + k] : asked;
  }
  double passed_weight(LaneInterface const& face, int k, int first = 0) const {
    bool const unasked = face.fresnel && !explicit_reflection;
    return passed[k] * (face.total[first + k] ? 0 : unasked ? face.transmittance[first + k] : 1);
  }
};

/// LaneSurface for each ray of a fan; arrays have the lanes of all.
struct FanSurface {
  double* passed = nullptr;
  double* mirrored = nullptr;
  bool mirrors[geometry::fan_width]{}, explicit_reflection[geometry::fan_width]{};
  double exponent[geometry::fan_width];

  FanSurface() { std::fill_n(exponent, geometry::fan_width, 1.0); }

  /// Of ray r, where each has so many lanes.
  LaneSurface of(std::size_t r, int lanes_each) const {
    int const first = static_cast<int>(r) * lanes_each;
    return {passed + first, mirrored + first, mirrors[r], explicit_reflection[r], exponent[r]};
  }
};

} // namespace abbe::render
