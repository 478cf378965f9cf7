// SPDX-License-Identifier: MIT
#pragma once

#include "transport/wavelengths/policy.hpp"

#include <vector>

namespace abbe::transport {

/// Splits in work: lanes at the ends of a range go alone, and when their routes agree those between
/// go together, on the route of the middle one.
class AdaptiveSplits {
public:
  AdaptiveSplits(Stage const& stage, Footprint const& footprint, Paths& paths)
      : stage_(stage), footprint_(footprint), paths_(paths) {}

  void start() {
    splits_.clear();
    between_.clear();
  }
  /// Sends the ends of the ranges of a split.
  void add(SplitTools const& tools, SplitRays const& rays, std::size_t r);
  /// All rays that were sent have gone their way: sends those that are next. @return false: none
  bool go_on(SplitTools const& tools);

private:
  /// One ray at the surface that splits it: a chunk without the others.
  struct Split {
    LightKind kind;
    std::uint8_t mask;
    int wave;
    std::size_t lanes;
    std::size_t first; ///< in lights_, ways_, channels_
    double tolerance_px;
    std::uint32_t slot, sample, stack, path;
    std::uint16_t tooth, level;
    Vec3 point, point_error;
    geometry::RayStart start;
  };
  /// Lanes whose ends have gone.
  struct Between {
    std::uint32_t split;
    int first, last;
    std::uint32_t from, to; ///< routes of the ends
  };
  std::uint32_t send_alone(SplitTools const& tools, Split const& split, int lane);
  void send(SplitTools const& tools, Split const& split, int first, int count, int way,
            std::uint32_t path);
  void part(SplitTools const& tools, Between const& between);

  Stage const& stage_;
  Footprint footprint_;
  Paths& paths_;
  std::vector<Split> splits_;
  std::vector<Between> between_, next_;
  std::vector<double> lights_;
  std::vector<Vec3> ways_;
  std::vector<std::uint16_t> channels_;
};

/// Lanes go together where their neighbours' routes agree within the tolerance.
class SplitAdaptively final : public WavelengthPolicy {
public:
  void split(SplitTools const& tools, SplitRays const& rays) const override;
};

} // namespace abbe::transport
