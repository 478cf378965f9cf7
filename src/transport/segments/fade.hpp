// SPDX-License-Identifier: MIT
#pragma once

#include "transport/segments/segment.hpp"

namespace abbe::transport {

/// POV-Ray's `fade_distance` and `fade_power`: by the distance from where the medium was entered to
/// where it is left.
class Fade final : public Segment {
public:
  /// @param colour that is left far inside, by channel
  Fade(double distance, double power, surface::Channels colour)
      : distance_(distance), power_(power), colour_(std::move(colour)) {}
  void leave(Passage const& way) const override;
  bool acts_where_left() const override { return true; }

private:
  double distance_, power_;
  surface::Channels colour_;
};

} // namespace abbe::transport
