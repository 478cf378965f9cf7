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
/// Slots: first one a channel, whose value is the mean over that channel (all but light of combs),
/// then for each comb one a tooth (two a band for the published scheme) and one a channel for its
/// control light; for combs that pick one tooth, the same again for what came of the picks. The
/// slot of tooth i holds light L_i of the wavelength lambda_i of this sample. Its colour is that of
/// the wavelength: w_i, the colour-matching functions there times the width of its stratum; the
/// mean of all w_i over the draws is white. Its share of the spectral film is spread over the two
/// bands it falls between (research brief 1.3, 1.4).
///
/// Light of the same paths without dispersion, C_c of channel c, is the control variate: the sample
/// is sum_c W_c C_c + sum_i w_i (L_i - C_c(i)). Its mean is that of sum_i w_i L_i whatever C is,
/// and where dispersion changes nothing it is exact in each sample: grey stays grey for any comb.
/// Of what came of picks, only the picked tooth's difference counts, at 1 / its probability.
class SampleFilm {
public:
  SampleFilm(Stage const& stage, WaveTables const& waves);

  void start_sample();
  double* data() { return values_.data(); }
  /// Of all slots that count.
  std::span<double const> light() const { return {values_.data(), values_.size() - 1}; }
  std::size_t size() const { return values_.size(); }

  std::uint32_t tooth_slot(int comb, int tooth) const {
    return part(comb).light + static_cast<std::uint32_t>(tooth);
  }
  /// Of the published scheme: `second` for the neighbouring band.
  std::uint32_t doubled_slot(int comb, int band, bool second) const {
    return part(comb).light + static_cast<std::uint32_t>(2 * band + (second ? 1 : 0));
  }
  bool has_control(int comb) const { return settings(comb).has_control(); }
  std::uint32_t control_slot(int comb, int channel) const {
    return part(comb).control + static_cast<std::uint32_t>(channel);
  }
  /// The same for what comes of picks.
  std::uint32_t picked_slot(int comb, int tooth) const {
    return part(comb).picked + static_cast<std::uint32_t>(tooth);
  }
  std::uint32_t picked_control_slot(int comb, int channel) const {
    return part(comb).picked_control + static_cast<std::uint32_t>(channel);
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
  /// First slots of a comb, in this order, and the one after its last.
  struct Part {
    std::uint32_t light = 0, control = 0, picked = 0, picked_control = 0, end = 0;
  };
  Part const& part(int comb) const { return parts_[static_cast<std::size_t>(comb)]; }
  optics::Comb const& settings(int comb) const {
    return stage_.combs[static_cast<std::size_t>(comb)];
  }
  bool is_dark(int comb) const;
  /// Adds light of the channels to the spectral film, where there is one.
  void add_plain(std::span<double const> light, std::span<double> bands) const;
  /// What dispersion changes, of one comb: the change of each tooth's light to the picture, and to
  /// the spectral film.
  Vec3 resolve_teeth(WaveTables& waves, int comb, std::span<double> bands) const;
  void resolve_doubled(WaveTables& waves, int comb) const;
  Vec3 doubled_colour(WaveTables& waves, int comb, int channel) const;
  Vec3 comb_colour(int comb, std::uint32_t slot, WaveTables& waves) const;

  Stage const& stage_;
  std::vector<double> values_;
  std::vector<Part> parts_; ///< by comb
  mutable std::vector<double> plain_;
};

} // namespace abbe::render
