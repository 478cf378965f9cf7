// SPDX-License-Identifier: MIT
#include "geometry/placement.hpp"

#include <cstring>

namespace abbe::geometry {

namespace {

bool same_bits(Transform const& a, Transform const& b) {
  static_assert(sizeof(Transform) == 48 * sizeof(double)); // no gaps
  return std::memcmp(&a, &b, sizeof a) == 0;
}

bool is_diagonal(Mat3 const& m) {
  return m[0][1] == 0 && m[0][2] == 0 && m[1][0] == 0 && m[1][2] == 0 && m[2][0] == 0
         && m[2][1] == 0;
}

} // namespace

Placement::Placement(Transform const& transform)
    : scale_(transform.linear[0][0], transform.linear[1][1], transform.linear[2][2]),
      offset_(transform.offset) {
  if (is_diagonal(transform.linear)
      && same_bits(transform, Transform::scaled_and_moved(scale_, offset_)))
    return;
  whole_ = std::make_shared<Transform const>(transform);
  scale_ = Vec3(1);
  offset_ = Vec3(0);
}

Transform Placement::then(Transform const& next) const {
  if (whole_ || !next.translates()) return transform().then(next);
  // What is asked of the inverse is the moved one's.
  Transform scaled = Transform::scaling(scale_);
  scaled.offset = offset_;
  return scaled.then(next);
}

} // namespace abbe::geometry
