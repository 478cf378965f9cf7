// SPDX-License-Identifier: MIT
#pragma once

#include "optics/bands.hpp"

#include <vector>

namespace abbe::optics {

/// The channels of light of a rendering that tells wavelengths apart: one a band (or some bands of
/// a fine grid, with weights of their own: a basis), then one an emission line. Values of bands are
/// means relative to D65; the value of a line is its power relative to that of D65 in one nm there.
struct ChannelSet {
  Bands bands;
  /// Of a basis: bands that stand for all of them, ascending, and the colour of each. Empty: every
  /// band stands for itself.
  std::vector<int> chosen;
  std::vector<Vec3> chosen_rgb;
  std::vector<double> lines_nm; ///< ascending

  bool is_basis() const { return !chosen.empty(); }
  int band_count() const { return is_basis() ? static_cast<int>(chosen.size()) : bands.count(); }
  int count() const { return band_count() + static_cast<int>(lines_nm.size()); }
  bool is_line(int channel) const { return channel >= band_count(); }
  /// The wavelength that a channel is traced at in the deterministic modes.
  double lambda_nm(int channel) const;
  /// Linear sRGB of one unit of a channel.
  Vec3 rgb_weight(int channel) const;

  /// From values of all bands to values of the channels; lines get 0.
  std::vector<double> from_bands(std::vector<double> const& values) const;
};

} // namespace abbe::optics
