// SPDX-License-Identifier: MIT
#include "geometry/box_probe.hpp"

namespace abbe::geometry {

void NodeProbe::leave_untested(Ray const& ray, bool near) {
  for (int i = 0; i < 3; ++i) {
    double const size = std::fabs(axes_[i].inverse[0]);
    bool const usable = size >= BoxRange::smallest_inverse && size <= BoxRange::largest_inverse;
    // Across the axis, the quotients are infinite as they should be.
    if (near && (usable || ray.direction[i] == 0)) continue;
    axes_[i].inverse = same(std::numeric_limits<double>::quiet_NaN());
  }
}

} // namespace abbe::geometry
