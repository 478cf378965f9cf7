// SPDX-License-Identifier: MIT
#include "optics/channel_set.hpp"

namespace abbe::optics {

double ChannelSet::lambda_nm(int channel) const {
  if (is_line(channel)) return lines_nm[static_cast<std::size_t>(channel - band_count())];
  return bands.center(is_basis() ? chosen[static_cast<std::size_t>(channel)] : channel);
}

Vec3 ChannelSet::rgb_weight(int channel) const {
  if (is_line(channel)) return bands.rgb_density(lambda_nm(channel)); // of one nm
  return is_basis() ? chosen_rgb[static_cast<std::size_t>(channel)] : bands.rgb_weight(channel);
}

std::vector<double> ChannelSet::from_bands(std::vector<double> const& values) const {
  std::vector<double> out;
  if (is_basis())
    for (int const band : chosen) out.push_back(values[static_cast<std::size_t>(band)]);
  else
    out = values;
  out.resize(static_cast<std::size_t>(count()), 0.0);
  return out;
}

} // namespace abbe::optics
