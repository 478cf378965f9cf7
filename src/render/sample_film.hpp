// SPDX-License-Identifier: MIT
#pragma once

#include "base/random.hpp"
#include "render/stage.hpp"
#include "render/wave_tables.hpp"

#include <span>
#include <vector>

namespace abbe::render {

/// Adds up the light of one camera sample.
///
/// Slots: first one a channel, whose value is the mean over that band (all but stochastic paths),
/// then for each stochastic setting one a channel (`jittered`), or two a channel for the published
/// scheme. A jittered slot i holds light of the wavelength lambda_i(xi) of this sample. Its colour
/// is exact: the colour-matching functions at that wavelength times the band's width, scaled so
/// that the comb of all bands is white (research brief 1.4); its share of the spectral film is
/// spread over the two bands it falls between (1.3).
class SampleFilm {
public:
  explicit SampleFilm(Stage const& stage);

  void start_sample();
  double* data() { return values_.data(); }
  std::size_t size() const { return values_.size(); }

  std::uint32_t jittered_slot(int jitter, int channel) const {
    return jitter_base_[static_cast<std::size_t>(jitter)] + static_cast<std::uint32_t>(channel);
  }
  /// Slot of the published scheme: `second` for the neighbouring band.
  std::uint32_t faithful_slot(int jitter, int channel, bool second) const {
    return jitter_base_[static_cast<std::size_t>(jitter)]
           + static_cast<std::uint32_t>(2 * channel + (second ? 1 : 0));
  }

  /// Linear sRGB of the sample; with `bands` (one value a channel) its spectrum too.
  Vec3 resolve(WaveTables& waves, std::span<double> bands) const;

private:
  Vec3 resolve_locked(WaveTables& waves, int jitter, std::span<double> bands) const;
  void resolve_faithful(WaveTables& waves, int jitter, std::span<double> plain) const;

  Stage const& stage_;
  std::vector<double> values_;
  std::vector<std::uint32_t> jitter_base_;
  mutable std::vector<double> plain_;
};

} // namespace abbe::render
