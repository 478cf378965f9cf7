// SPDX-License-Identifier: MIT
#include "geometry/half_space_bounds.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::geometry {

Bounds bounds_of(std::vector<HalfSpace> const& given) {
  constexpr std::size_t most = 24;
  constexpr double rounding = 0x1p-36; // of corners, as a share of how far away they are
  if (given.size() < 4 || given.size() > most) return all_space();
  double far = 0;
  for (HalfSpace const& space : given) far = std::max(far, std::fabs(space.most));
  if (!(far > 0x1p-500 && far < 0x1p500)) return all_space();
  // Within a box so large that corners near it say that there is no end.
  std::vector<HalfSpace> all = given;
  double const end = 0x1p20 * far;
  for (int axis = 0; axis < 3; ++axis)
    for (double const side : {-1.0, 1.0}) {
      Vec3 along(0);
      along[axis] = side;
      all.push_back({along, end});
    }
  Bounds result;
  result.low = Vec3(INFINITY);
  result.high = Vec3(-INFINITY);
  // Its corners are where three of the planes meet.
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      Vec3 const across = glm::cross(all[i].normal, all[j].normal);
      for (std::size_t k = j + 1; k < all.size(); ++k) {
        double const volume = glm::dot(across, all[k].normal);
        if (!(std::fabs(volume) > 0x1p-20)) continue;
        Vec3 const corner =
            (all[i].most * glm::cross(all[j].normal, all[k].normal)
             + all[j].most * glm::cross(all[k].normal, all[i].normal) + all[k].most * across)
            / volume;
        double const slack = rounding * (far + glm::length(corner));
        bool const inside = std::all_of(all.begin(), all.end(), [&](HalfSpace const& space) {
          return glm::dot(space.normal, corner) <= space.most + slack;
        });
        if (!inside) continue;
        if (glm::length(corner) > 0x1p-10 * end) return all_space();
        result.low = glm::min(result.low, corner - slack);
        result.high = glm::max(result.high, corner + slack);
      }
    }
  return result.empty() ? all_space() : box_of(result.low, result.high);
}

} // namespace abbe::geometry
