// SPDX-License-Identifier: MIT
#pragma once

#include "base/random.hpp"
#include "render/stage.hpp"
#include "render/wave_tables.hpp"

#include <span>
#include <vector>

namespace abbe::render {

/// Adds up the light of the camera samples in work.
///
/// Slots of a sample, those of the next behind them: first one a channel, whose value is the mean
/// over that channel (all but light of combs), then for each comb one a tooth (two a band for the
/// published scheme) and one a channel for its control light; for combs that pick one tooth, the
/// same again for what came of the picks. The slot of tooth i holds light L_i of the wavelength
/// lambda_i of this sample. Its colour is that of the wavelength: w_i, the colour-matching
/// functions there times the width of its stratum; the mean of all w_i over the draws is white. Its
/// share of the spectral film is spread over the two bands it falls between (research
/// brief 1.3, 1.4).
///
/// Light of the same paths without dispersion, C_c of channel c, is the control variate: the sample
/// is sum_c W_c C_c + sum_i w_i (L_i - C_c(i)). Its mean is that of sum_i w_i L_i whatever C is,
/// and where dispersion changes nothing it is exact in each sample: grey stays grey for any comb.
/// Of what came of picks, only the picked tooth's difference counts, at 1 / its probability.
class SampleFilm {
public:
  /// @param samples in work at a time, at most
  SampleFilm(Stage const& stage, WaveTables const& waves, std::size_t samples);

  /// Their light is none.
  void start_samples(std::size_t count);
  double* data() { return values_.data(); }
  /// Of all samples.
  std::size_t size() const { return values_.size(); }
  /// Of all slots of a sample that count.
  std::span<double const> light(std::size_t sample) const {
    return {values_.data() + first(sample), slots_};
  }
  /// Whose slot it is.
  std::size_t sample_of(std::uint32_t slot) const { return slot >> stride_bits_; }
  std::uint32_t channel_slot(std::size_t sample, int channel) const {
    return first(sample) + static_cast<std::uint32_t>(channel);
  }

  std::uint32_t tooth_slot(std::size_t sample, int comb, int tooth) const {
    return first(sample) + part(comb).light + static_cast<std::uint32_t>(tooth);
  }
  /// Of the published scheme: `second` for the neighbouring band.
  std::uint32_t doubled_slot(std::size_t sample, int comb, int band, bool second) const {
    return first(sample) + part(comb).light
           + static_cast<std::uint32_t>(2 * band + (second ? 1 : 0));
  }
  bool has_control(int comb) const { return settings(comb).has_control(); }
  std::uint32_t control_slot(std::size_t sample, int comb, int channel) const {
    return first(sample) + part(comb).control + static_cast<std::uint32_t>(channel);
  }
  /// The same for what comes of picks.
  std::uint32_t picked_slot(std::size_t sample, int comb, int tooth) const {
    return first(sample) + part(comb).picked + static_cast<std::uint32_t>(tooth);
  }
  std::uint32_t picked_control_slot(std::size_t sample, int comb, int channel) const {
    return first(sample) + part(comb).picked_control + static_cast<std::uint32_t>(channel);
  }
  /// Light that is put here is lost.
  std::uint32_t unused_slot(std::size_t sample) const { return first(sample) + slots_; }

  /// The sum of what light in some slots of a sample adds to it, linear sRGB, each without sign.
  Vec3 size_of(std::uint32_t const* slots, double const* light, int count, WaveTables& waves) const;
  /// Linear sRGB of a sample; with `bands` (one value a channel) its spectrum too.
  Vec3 resolve(std::size_t sample, WaveTables& waves, std::span<double> bands) const {
    if (!bands.empty() || !stage_.combs.empty()) return resolve_all(sample, waves, bands);
    double const* const light = values_.data() + first(sample);
    Vec3 const* const weights = stage_.rgb_weights.data();
    double r = 0, g = 0, b = 0;
    for (int c = 0; c < stage_.channels; ++c) {
      r += light[c] * weights[c].x;
      g += light[c] * weights[c].y;
      b += light[c] * weights[c].z;
    }
    return {r, g, b};
  }

private:
  /// First slots of a comb, in this order, and the one after its last.
  struct Part {
    std::uint32_t light = 0, control = 0, picked = 0, picked_control = 0, end = 0;
  };
  Part const& part(int comb) const { return parts_[static_cast<std::size_t>(comb)]; }
  optics::Comb const& settings(int comb) const {
    return stage_.combs[static_cast<std::size_t>(comb)];
  }
  std::uint32_t first(std::size_t sample) const {
    return static_cast<std::uint32_t>(sample << stride_bits_);
  }
  /// resolve() where there is more than channels for the picture.
  Vec3 resolve_all(std::size_t sample, WaveTables& waves, std::span<double> bands) const;
  bool is_dark(double const* values, int comb) const;
  /// Adds light of the channels to the spectral film, where there is one.
  void add_plain(std::span<double const> light, std::span<double> bands) const;
  /// What dispersion changes, of one comb: the change of each tooth's light to the picture, and to
  /// the spectral film.
  Vec3 resolve_teeth(std::size_t sample, WaveTables& waves, int comb,
                     std::span<double> bands) const;
  void resolve_doubled(std::size_t sample, WaveTables& waves, int comb) const;
  Vec3 doubled_colour(std::size_t sample, WaveTables& waves, int comb, int channel) const;
  /// The wavelengths of a comb and a sample.
  struct Drawn {
    int comb = -1;
    std::size_t sample = 0;
    std::span<Vec3 const> weights;
    std::span<std::uint16_t const> channels;
    WaveTables::Pick pick;
  };
  Drawn drawn(std::size_t sample, int comb, WaveTables& waves) const;
  /// What one unit of light in a slot adds, counted from the sample's first.
  Vec3 comb_colour(Drawn const& drawn, std::uint32_t slot, WaveTables& waves) const;

  Stage const& stage_;
  std::uint32_t slots_ = 0;       ///< of a sample, that count
  std::uint32_t stride_bits_ = 0; ///< room for them and the unused one: a power of two
  std::vector<double> values_;
  std::vector<Part> parts_; ///< by comb
  mutable std::vector<double> plain_;
};

} // namespace abbe::render
