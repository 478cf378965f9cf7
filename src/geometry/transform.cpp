// SPDX-License-Identifier: MIT
#include "geometry/shape.hpp"

#include <cmath>

namespace abbe::geometry {

namespace {

/// Sine and cosine of an angle in degrees, exact at multiples of 90.
struct Turn {
  double sine, cosine;
};
Turn turn(double degrees) {
  double const rest = std::fmod(degrees, 360.0); // exact
  double const quarter = rest / 90.0;
  if (quarter == std::floor(quarter)) {
    int const n = (static_cast<int>(quarter) % 4 + 4) % 4;
    constexpr double values[4] = {0, 1, 0, -1};
    return {values[n], values[(n + 1) % 4]};
  }
  double const angle_rad = rest * 3.141592653589793238462643 / 180.0;
  return {std::sin(angle_rad), std::cos(angle_rad)};
}

/// Rows as written in mathematics; GLM takes columns.
Mat3 from_rows(Vec3 const& a, Vec3 const& b, Vec3 const& c) {
  return {a.x, b.x, c.x, a.y, b.y, c.y, a.z, b.z, c.z};
}

Transform orthogonal(Mat3 const& linear) {
  Transform result;
  result.linear = linear;
  result.inverse_linear = glm::transpose(linear);
  return result;
}

} // namespace

Transform Transform::translation(Vec3 const& by) {
  Transform result;
  result.offset = by;
  result.inverse_offset = -by;
  return result;
}

Transform Transform::scaling(Vec3 const& by) {
  Transform result;
  for (int i = 0; i < 3; ++i) {
    result.linear[i][i] = by[i];
    result.inverse_linear[i][i] = 1.0 / by[i];
  }
  return result;
}

Transform Transform::rotation(Vec3 const& degrees) {
  Turn const x = turn(degrees.x), y = turn(degrees.y), z = turn(degrees.z);
  Mat3 const about_x = from_rows({1, 0, 0}, {0, x.cosine, -x.sine}, {0, x.sine, x.cosine});
  Mat3 const about_y = from_rows({y.cosine, 0, y.sine}, {0, 1, 0}, {-y.sine, 0, y.cosine});
  Mat3 const about_z = from_rows({z.cosine, -z.sine, 0}, {z.sine, z.cosine, 0}, {0, 0, 1});
  return orthogonal(about_z * about_y * about_x);
}

Transform Transform::rotation_about(Vec3 const& axis, double degrees) {
  Turn const r = turn(degrees);
  Vec3 const a = glm::normalize(axis);
  double const rest = 1.0 - r.cosine;
  // Rodrigues; the same sense as rotation() about x, y, z.
  return orthogonal(from_rows({a.x * a.x * rest + r.cosine, a.x * a.y * rest - a.z * r.sine,
                               a.x * a.z * rest + a.y * r.sine},
                              {a.x * a.y * rest + a.z * r.sine, a.y * a.y * rest + r.cosine,
                               a.y * a.z * rest - a.x * r.sine},
                              {a.x * a.z * rest - a.y * r.sine, a.y * a.z * rest + a.x * r.sine,
                               a.z * a.z * rest + r.cosine}));
}

std::optional<Transform> Transform::matrix(double const (&rows)[12]) {
  for (double const value : rows) {
    if (!std::isfinite(value)) return std::nullopt;
  }
  Transform result;
  // p' = p M with row vectors: the rows of M are our columns.
  Vec3 const a(rows[0], rows[1], rows[2]), b(rows[3], rows[4], rows[5]),
      c(rows[6], rows[7], rows[8]);
  result.linear = Mat3(a, b, c);
  result.offset = {rows[9], rows[10], rows[11]};
  Vec3 const bc = glm::cross(b, c), ca = glm::cross(c, a), ab = glm::cross(a, b);
  double const determinant = glm::dot(a, bc);
  if (determinant == 0.0 || !std::isfinite(determinant)) return std::nullopt;
  result.inverse_linear = from_rows(bc / determinant, ca / determinant, ab / determinant);
  result.inverse_offset = -(result.inverse_linear * result.offset);
  return result;
}

Transform Transform::then(Transform const& next) const {
  Transform result;
  result.linear = next.linear * linear;
  result.offset = next.linear * offset + next.offset;
  result.inverse_linear = inverse_linear * next.inverse_linear;
  result.inverse_offset = -(result.inverse_linear * result.offset);
  return result;
}

Transform Transform::inverse() const {
  return {inverse_linear, inverse_offset, linear, offset};
}

bool Transform::identity() const {
  return linear == Mat3(1) && offset == Vec3(0);
}

} // namespace abbe::geometry
