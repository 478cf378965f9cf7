// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace abbe::optics {

/// The wavelengths at which light goes on where a stochastic material splits it: one tooth in each
/// of equal strata of the range (the bands, unless `teeth` says otherwise), drawn anew for every
/// sample, and which of them are followed.
struct Comb {
  /// Where a tooth lies in its stratum.
  /// LowDiscrepancy: all at one offset, which takes golden-ratio steps over a pixel's samples.
  /// Uniform: all at one offset, drawn for each sample by itself.
  /// Triangular: the same, drawn from the hat function of the stratum.
  /// Stratified: each at an offset of its own.
  /// BlueNoise: as LowDiscrepancy; neighbouring pixels start far apart.
  enum class Jitter : std::uint8_t { LowDiscrepancy, Uniform, Triangular, Stratified, BlueNoise };
  /// Every: each tooth is a ray. Doubled: each becomes two, of the bands between which its
  /// wavelength falls, drawn anew at the second refraction: the published scheme. Hero: one tooth,
  /// all alike. Importance: one tooth, the more often the more it is worth to the eye.
  enum class Follow : std::uint8_t { Every, Doubled, Hero, Importance };

  int teeth = 0; ///< 0: one a band
  Jitter jitter = Jitter::LowDiscrepancy;
  /// Whole extent of the jitter, in strata. Any whole width (of the triangle: even) covers the
  /// range evenly: unbiased. Less samples the middle of each stratum only.
  double width = 1;
  Follow follow = Follow::Every;

  /// Is the light of its wavelengths kept apart, with a control light (SampleFilm)? A triangle
  /// needs none: its light is the band's, whole.
  bool has_control() const { return follow == Follow::Doubled || jitter != Jitter::Triangular; }
  bool picks_one() const { return follow == Follow::Hero || follow == Follow::Importance; }
  bool operator==(Comb const&) const = default;
};

inline constexpr std::array<std::string_view, 5> jitter_words{
    "low_discrepancy", "uniform", "triangular", "stratified", "blue_noise"};

/// Offset xi in strata, within width/2 of 0, for u uniform in [0, 1).
double jitter_offset(Comb const& comb, double u);

} // namespace abbe::optics
