// SPDX-License-Identifier: MIT
#pragma once

#include "transport/stage.hpp"
#include "transport/wave_tables.hpp"

#include <span>
#include <vector>

namespace abbe::transport {

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
///
/// The slots of a sample are a block. Light that is gathered apart first (Captures) has blocks of
/// its own, behind those of the samples.
class SampleFilm {
public:
  using Block = std::uint32_t;
  /// @param samples in work at a time, at most
  SampleFilm(Stage const& stage, WaveTables const& waves, std::size_t samples);

  /// Their light is none.
  void start_samples(std::size_t count);
  /// A block for more light of the sample that has another. Its light is none.
  Block add_block(Block like);
  double& operator[](std::uint32_t slot) { return values_[slot]; }
  double operator[](std::uint32_t slot) const { return values_[slot]; }
  /// Of all slots of a sample that count.
  std::span<double const> light(std::size_t sample) const {
    return {values_.data() + first(static_cast<Block>(sample)), slots_};
  }
  /// How many slots a block has that count.
  std::uint32_t slots() const { return slots_; }
  Block block_of(std::uint32_t slot) const { return slot >> stride_bits_; }
  bool is_sample(Block block) const { return block < samples_; }
  std::size_t sample_of_block(Block block) const { return sample_of_[block]; }
  /// Whose slot it is.
  std::size_t sample_of(std::uint32_t slot) const { return sample_of_[block_of(slot)]; }
  std::uint32_t first(Block block) const { return block << stride_bits_; }
  std::uint32_t channel_slot(Block block, int channel) const {
    return first(block) + static_cast<std::uint32_t>(channel);
  }

  std::uint32_t tooth_slot(Block block, int comb, int tooth) const {
    return first(block) + part(comb).light + static_cast<std::uint32_t>(tooth);
  }
  /// Of the published scheme: the next one is for the neighbouring band.
  std::uint32_t doubled_slot(Block block, int comb, int band) const {
    return first(block) + part(comb).light + static_cast<std::uint32_t>(2 * band);
  }
  bool has_control(int comb) const { return settings(comb).has_control(); }
  std::uint32_t control_slot(Block block, int comb, int channel) const {
    return first(block) + part(comb).control + static_cast<std::uint32_t>(channel);
  }
  /// The same for what comes of picks.
  std::uint32_t picked_slot(Block block, int comb, int tooth) const {
    return first(block) + part(comb).picked + static_cast<std::uint32_t>(tooth);
  }
  std::uint32_t picked_control_slot(Block block, int comb, int channel) const {
    return first(block) + part(comb).picked_control + static_cast<std::uint32_t>(channel);
  }

  /// The sum of what light in some slots, one after another, adds to their sample, linear sRGB,
  /// each without sign. @pre the slots are a sample's
  Vec3 size_of(std::uint32_t slot, double const* light, std::size_t lanes, WaveTables& waves) const;
  /// Linear sRGB of a sample; with `bands` (one value a channel) its spectrum too.
  Vec3 resolve(std::size_t sample, WaveTables& waves, std::span<double> bands) const {
    if (!bands.empty() || !stage_.combs.empty()) return resolve_all(sample, waves, bands);
    double const* const light = values_.data() + first(static_cast<Block>(sample));
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
  std::uint32_t slots_ = 0;              ///< of a block, that count
  std::uint32_t stride_bits_ = 0;        ///< room for them: a power of two
  std::uint32_t samples_ = 0;            ///< in work
  std::vector<std::uint32_t> sample_of_; ///< by block
  std::vector<double> values_;
  std::vector<Part> parts_; ///< by comb
  mutable std::vector<double> plain_;
};

} // namespace abbe::transport
