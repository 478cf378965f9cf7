// SPDX-License-Identifier: MIT
#pragma once

#include "transport/wavelengths/policy.hpp"

namespace abbe::transport {

/// One ray a lane: a band (deterministic), or a tooth of a comb (stochastic).
class SplitApart final : public WavelengthPolicy {
public:
  void split(SplitTools const& tools, SplitRays const& rays) const override;
};

} // namespace abbe::transport
