// SPDX-License-Identifier: MIT
#pragma once

#include "transport/wavelengths/policy.hpp"

namespace abbe::transport {

/// One tooth of a comb goes on for all (hero, importance), at 1 / its probability; emission lines
/// are few, and each is all there is of its light.
class SplitPicked final : public WavelengthPolicy {
public:
  void split(SplitTools const& tools, SplitRays const& rays) const override;
};

} // namespace abbe::transport
