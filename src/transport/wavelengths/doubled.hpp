// SPDX-License-Identifier: MIT
#pragma once

#include "transport/wavelengths/policy.hpp"

namespace abbe::transport {

/// The published scheme: at the first refraction each band's light goes on at a drawn wavelength as
/// light of the two bands that it falls between; at the second each of these at one of its own.
class SplitDoubled final : public WavelengthPolicy {
public:
  void split(SplitTools const& tools, SplitRays const& rays) const override;
};

} // namespace abbe::transport
