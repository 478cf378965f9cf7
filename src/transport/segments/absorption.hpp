// SPDX-License-Identifier: MIT
#pragma once

#include "transport/segments/segment.hpp"

namespace abbe::transport {

/// Lambert's and Beer's: exp(-alpha distance).
class Absorption final : public Segment {
public:
  /// @param alpha per scene unit and channel
  explicit Absorption(surface::Channels alpha) : alpha_(std::move(alpha)) {}
  void along(Passage const& way) const override;

private:
  surface::Channels alpha_;
};

} // namespace abbe::transport
