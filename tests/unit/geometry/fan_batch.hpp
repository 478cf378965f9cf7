// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/fan.hpp"

namespace abbe::geometry {

/// The rays of a fan as a batch, which points into it.
/// @param starts one a ray @param groups that they speak of, null: of none
inline RayLines batch_of(FanLines& lines, RayStart const* starts, Groups const* groups = nullptr) {
  auto const arrays = [](FanVectors& v) { return VectorArrays{v.x, v.y, v.z}; };
  return {lines.count,
          arrays(lines.origin),
          arrays(lines.direction),
          arrays(lines.origin_error),
          starts,
          groups};
}

} // namespace abbe::geometry
