// SPDX-License-Identifier: MIT
#include "transport/wavelengths/adaptive.hpp"
#include "transport/wavelengths/apart.hpp"
#include "transport/wavelengths/doubled.hpp"
#include "transport/wavelengths/picked.hpp"

namespace abbe::transport {

WavelengthPolicy const& policy_of(optics::Comb const* comb, double tolerance_px) {
  static SplitApart const apart;
  static SplitPicked const picked;
  static SplitDoubled const doubled;
  static SplitAdaptively const adaptively;
  if (comb == nullptr) {
    if (tolerance_px > 0) return adaptively;
    return apart;
  }
  if (comb->picks_one()) return picked;
  if (comb->follow == optics::Comb::Follow::Doubled) return doubled;
  return apart;
}

} // namespace abbe::transport
