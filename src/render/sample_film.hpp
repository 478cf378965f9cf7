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
/// scheme, and one a channel for its control light. A jittered slot i holds light L_i of the
/// wavelength lambda_i(xi) of this sample. Its colour is that of the wavelength: w_i(xi), the
/// colour-matching functions there times the band's width, whose mean over xi is the colour W_i of
/// the band. Its share of the spectral film is spread over the two bands it falls between (research
/// brief 1.3, 1.4).
///
/// Light of the same paths without dispersion, C_i, is the control variate: the sample is
/// sum_i W_i C_i + w_i(xi) (L_i - C_i). Its mean is that of w_i(xi) L_i whatever C_i is, and where
/// dispersion changes nothing it is exact in each sample: grey stays grey for any number of bands.
class SampleFilm {
public:
  explicit SampleFilm(Stage const& stage);

  void start_sample();
  double* data() { return values_.data(); }
  /// Of all slots that count.
  std::span<double const> light() const { return {values_.data(), values_.size() - 1}; }
  std::size_t size() const { return values_.size(); }

  std::uint32_t jittered_slot(int jitter, int channel) const {
    return parts_[static_cast<std::size_t>(jitter)].light + static_cast<std::uint32_t>(channel);
  }
  /// Slot of the published scheme: `second` for the neighbouring band.
  std::uint32_t faithful_slot(int jitter, int channel, bool second) const {
    return parts_[static_cast<std::size_t>(jitter)].light
           + static_cast<std::uint32_t>(2 * channel + (second ? 1 : 0));
  }
  /// Triangular jitter needs none: its light is the band's, whole.
  bool has_control(int jitter) const {
    JitterSettings const& settings = stage_.jitters[static_cast<std::size_t>(jitter)];
    return settings.faithful || settings.jitter != scene::DispersionMode::Jitter::Triangular;
  }
  std::uint32_t control_slot(int jitter, int channel) const {
    return parts_[static_cast<std::size_t>(jitter)].control + static_cast<std::uint32_t>(channel);
  }
  /// Light that is put here is lost.
  std::uint32_t unused_slot() const { return static_cast<std::uint32_t>(values_.size() - 1); }

  /// What one unit of light in a slot adds to the sample, linear sRGB.
  Vec3 colour(std::uint32_t slot, WaveTables& waves) const;
  /// Linear sRGB of the sample; with `bands` (one value a channel) its spectrum too.
  Vec3 resolve(WaveTables& waves, std::span<double> bands) const;
  /// The same of light by channel alone.
  Vec3 resolve_plain(std::span<double const> light, std::span<double> bands) const;

private:
  /// First slots of a stochastic setting.
  struct Part {
    std::uint32_t light = 0, control = 0;
  };
  bool is_dark(int jitter) const;
  /// What dispersion changes, of one stochastic setting.
  Vec3 resolve_locked(WaveTables& waves, int jitter, std::span<double> bands) const;
  void resolve_faithful(WaveTables& waves, int jitter) const;
  Vec3 faithful_colour(WaveTables& waves, int jitter, int channel) const;

  Stage const& stage_;
  std::vector<double> values_;
  std::vector<Part> parts_; ///< by jitter
  mutable std::vector<double> plain_;
};

} // namespace abbe::render
