// SPDX-License-Identifier: MIT
#pragma once

#include "base/parameters.hpp"
#include "geometry/shape.hpp"
#include "simd/lane_types.hpp"
#include "simd/math.hpp"

#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

/// Small checks that the readers of shapes share.
namespace abbe::geometry {

inline bool finite(Vec3 const& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
/// Not zero, not so small that its inverse overflows, not infinite.
inline bool usable_size(double size) {
  return std::isfinite(size) && size != 0.0 && std::isfinite(1.0 / size);
}
inline std::optional<PlacedShape> or_report(std::optional<PlacedShape> shape,
                                            Parameters& parameters, std::string_view code,
                                            std::string_view message) {
  if (!shape) parameters.report(Severity::Error, code, message);
  return shape;
}

/// What POV-Ray reads without a word and shows as nothing: a warning says so.
/// @return what stands for it, so that the caller can return it as its own shape
inline std::nullopt_t left_out(Parameters& parameters, std::string_view code,
                               std::string_view message) {
  parameters.report(Severity::Warning, code, message);
  return std::nullopt;
}

/// `n, <x, y> ...`: the number of points and the points; nullopt (reported) when there are fewer.
inline std::optional<std::vector<Vec2>> read_points(Parameters& parameters, int least) {
  int const count = parameters.integer("number of points", least, 1 << 24);
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) {
    if (i > 0 && !parameters.has_value()) {
      parameters.report(Severity::Error, "E0616",
                        "there are fewer points than the number of points says");
      return std::nullopt;
    }
    points.push_back(parameters.vec2("point"));
  }
  return points;
}

/// Length without overflow or underflow of the squares.
inline double vector_length(Vec3 const& v) {
  double const square = glm::dot(v, v);
  if (square > 0x1p-900 && square < 0x1p900) return std::sqrt(square);
  return simd::hypot(simd::hypot(v.x, v.y), v.z);
}
/// v / |v|, of the same bits when v is scaled by a power of two. @param v finite, not zero
inline Vec3 unit_vector(Vec3 const& v) {
  double const largest = std::fmax(std::fabs(v.x), std::fmax(std::fabs(v.y), std::fabs(v.z)));
  // A power of two: exact.
  double const size = largest >= std::numeric_limits<double>::min()
                          ? largest / simd::significand(largest)
                          : std::exp2(std::ilogb(largest));
  Vec3 const even = v / size;
  return even / glm::length(even);
}

/// Turns +y to the direction of `axis` (not zero) and keeps lengths. Exact where axis is along x, y
/// or z. Which way x and z turn is unspecified: only for bodies of revolution about y.
inline Transform y_to(Vec3 const& axis) {
  Vec3 const y = unit_vector(axis);
  Vec3 const size = glm::abs(y);
  // The coordinate axis that is furthest from y spans a plane with it in the most stable way.
  Vec3 const other = size.x <= size.y && size.x <= size.z
                         ? Vec3(1, 0, 0)
                         : (size.z <= size.y ? Vec3(0, 0, 1) : Vec3(0, 1, 0));
  Vec3 const z = glm::normalize(glm::cross(other, y));
  Transform result;
  result.linear = Mat3(glm::cross(y, z), y, z);
  result.inverse_linear = glm::transpose(result.linear);
  return result;
}

} // namespace abbe::geometry
