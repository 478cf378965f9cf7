// SPDX-License-Identifier: MIT
#include "geometry/transform.hpp"

#include "simd/math.hpp"

#include <cmath>

namespace abbe::geometry {

namespace {

/// Pays for the roundings of a bound itself.
constexpr double upward = 1 + gamma_bound(64);

Mat3 sizes(Mat3 const& m) {
  return {glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2])};
}

/// A sum and the sum of the sizes of the rounding errors that were made (Knuth; products by fma).
struct Sum {
  double value = 0, error = 0;
  void add(double term) {
    double const sum = value + term, back = sum - value;
    error += std::fabs((value - (sum - back)) + (term - back));
    value = sum;
  }
  void add_product(double a, double b) {
    if (a == 0 || b == 0) return;
    double const product = a * b;
    error += std::fabs(std::fma(a, b, -product));
    add(product);
  }
};

/// m * v + w; what m, v and w are off by goes through, what is rounded comes on top.
struct Image {
  Vec3 value{0}, error{0};
};
Image image(Mat3 const& m, Mat3 const& m_error, Vec3 const& v, Vec3 const& v_error,
            Vec3 const& w = Vec3(0), Vec3 const& w_error = Vec3(0)) {
  // As the sums below would have it: nothing is rounded, and no zero is negative.
  if (v == Vec3(0) && v_error == Vec3(0)) return {w + 0.0, w_error + 0.0};
  Image result;
  for (int row = 0; row < 3; ++row) {
    Sum sum, off;
    for (int column = 0; column < 3; ++column) {
      sum.add_product(m[column][row], v[column]);
      off.add_product(std::fabs(m[column][row]), v_error[column]);
      off.add_product(m_error[column][row], std::fabs(v[column]) + v_error[column]);
    }
    sum.add(w[row]);
    off.add(w_error[row]);
    off.add(sum.error);
    result.value[row] = sum.value;
    // Only where it was rounded itself: a power of two scales it, bit by bit.
    result.error[row] = off.error == 0 ? off.value : upward * off.value;
  }
  return result;
}

struct Product {
  Mat3 value{0}, error{0};
};
Product product(Mat3 const& a, Mat3 const& a_error, Mat3 const& b, Mat3 const& b_error) {
  Mat3 const zero(0), unit(1);
  // As image() would have it.
  if (a == unit && a_error == zero) return {b + zero, b_error + zero};
  if (b == unit && b_error == zero) return {a + zero, a_error + zero};
  Product result;
  for (int column = 0; column < 3; ++column) {
    Image const made = image(a, a_error, b[column], b_error[column]);
    result.value[column] = made.value;
    result.error[column] = made.error;
  }
  return result;
}

/// Sine and cosine of an angle in degrees, exact at multiples of 90; and what they are off by.
struct Turn {
  double sine, cosine, error;
};
Turn turn(double degrees) {
  double const rest = std::fmod(degrees, 360.0); // exact
  double const quarter = rest / 90.0;
  if (quarter == std::floor(quarter)) {
    int const n = (static_cast<int>(quarter) % 4 + 4) % 4;
    constexpr double values[4] = {0, 1, 0, -1};
    return {values[n], values[(n + 1) % 4], 0};
  }
  constexpr double pi = 3.141592653589793238462643, pi_rest = 1.2246467991473532e-16;
  double const product = rest * pi, angle_rad = product / 180.0;
  // What the angle is off by, and a unit in the last place of values of at most 1.
  double const off =
      std::fma(-180.0, angle_rad, product) + std::fma(rest, pi, -product) + rest * pi_rest;
  return {simd::sin(angle_rad), simd::cos(angle_rad),
          upward * (std::fabs(off) / 180.0 + unit_roundoff)};
}

/// Rows as written in mathematics; GLM takes columns.
Mat3 from_rows(Vec3 const& a, Vec3 const& b, Vec3 const& c) {
  return {a.x, b.x, c.x, a.y, b.y, c.y, a.z, b.z, c.z};
}

Transform orthogonal(Product const& linear) {
  Transform result;
  result.linear = linear.value;
  result.linear_error = linear.error;
  result.inverse_linear = glm::transpose(linear.value);
  result.inverse_linear_error = glm::transpose(linear.error);
  return result;
}

/// What sine and cosine of a turn about an axis are off by, where they stand.
Mat3 turn_error(int axis, double error) {
  Mat3 result(error);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result[i][j] = i == axis || j == axis ? 0.0 : error;
  }
  return result;
}

/// Bound of |exact inverse - x|, entry by entry, for a computed inverse x of a:
/// a^-1 - x = (1 - x a) a^-1. Twice the first order, for the a^-1 on the right.
Mat3 inverse_error(Mat3 const& a, Mat3 const& x) {
  Product const residual = product(x, Mat3(0), a, Mat3(0));
  Mat3 off = residual.error;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) off[i][j] += std::fabs(residual.value[i][j] - (i == j ? 1 : 0));
  }
  return off * sizes(x) * 2.0;
}

} // namespace

Transform Transform::translation(Vec3 const& by) {
  Transform result;
  result.offset = by;
  result.inverse_offset = -by;
  return result;
}

Transform Transform::rounded_translation(Vec3 const& by, int roundings) {
  Transform result = translation(by);
  result.offset_error = result.inverse_offset_error = gamma_bound(roundings) * glm::abs(by);
  return result;
}

Transform Transform::scaling(Vec3 const& by) {
  Transform result;
  for (int i = 0; i < 3; ++i) {
    result.linear[i][i] = by[i];
    double const inverse = 1.0 / by[i];
    result.inverse_linear[i][i] = inverse;
    result.inverse_linear_error[i][i] = error_of_inverse(by[i], inverse);
  }
  return result;
}

double Transform::error_of_inverse(double by, double inverse) {
  return upward * std::fabs(std::fma(-by, inverse, 1.0) * inverse);
}

Transform Transform::scaled_and_moved(Vec3 const& scale, Vec3 const& offset) {
  if (scale == Vec3(1) && offset == Vec3(0)) return {};
  Transform result = scaling(scale);
  for (int i = 0; i < 3; ++i) {
    result.offset[i] = 0.0 + offset[i]; // as a sum: no negative zero
  }
  result.set_inverse_offset();
  return result;
}

Transform Transform::rotation(Vec3 const& degrees) {
  Turn const x = turn(degrees.x), y = turn(degrees.y), z = turn(degrees.z);
  Mat3 const about_x = from_rows({1, 0, 0}, {0, x.cosine, -x.sine}, {0, x.sine, x.cosine});
  Mat3 const about_y = from_rows({y.cosine, 0, y.sine}, {0, 1, 0}, {-y.sine, 0, y.cosine});
  Mat3 const about_z = from_rows({z.cosine, -z.sine, 0}, {z.sine, z.cosine, 0}, {0, 0, 1});
  Product const zy = product(about_z, turn_error(2, z.error), about_y, turn_error(1, y.error));
  return orthogonal(product(zy.value, zy.error, about_x, turn_error(0, x.error)));
}

Transform Transform::rotation_about(Vec3 const& axis, double degrees) {
  Turn const r = turn(degrees);
  Vec3 const a = glm::normalize(axis);
  double const rest = 1.0 - r.cosine;
  // Rodrigues; the same sense as rotation() about x, y, z.
  Mat3 const linear = from_rows({a.x * a.x * rest + r.cosine, a.x * a.y * rest - a.z * r.sine,
                                 a.x * a.z * rest + a.y * r.sine},
                                {a.x * a.y * rest + a.z * r.sine, a.y * a.y * rest + r.cosine,
                                 a.y * a.z * rest - a.x * r.sine},
                                {a.x * a.z * rest - a.y * r.sine, a.y * a.z * rest + a.x * r.sine,
                                 a.z * a.z * rest + r.cosine});
  // The axis has four roundings a component, the sums six more; no factor is above 2.
  double const error = gamma_bound(32) + 3 * r.error;
  return orthogonal({linear, Mat3(Vec3(error), Vec3(error), Vec3(error))});
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
  result.inverse_linear_error = inverse_error(result.linear, result.inverse_linear);
  result.set_inverse_offset();
  return result;
}

bool Transform::inverse_is_diagonal() const {
  bool diagonal = true;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      diagonal =
          diagonal && (i == j || (inverse_linear[i][j] == 0 && inverse_linear_error[i][j] == 0));
  return diagonal;
}

void Transform::set_inverse_offset() {
  if (inverse_is_diagonal()) { // image() without the terms that are zero
    for (int i = 0; i < 3; ++i) {
      double const m = inverse_linear[i][i], v = offset[i];
      Sum sum, off;
      sum.add_product(m, v);
      off.add_product(std::fabs(m), offset_error[i]);
      off.add_product(inverse_linear_error[i][i], std::fabs(v) + offset_error[i]);
      sum.add(0.0);
      off.add(0.0);
      off.add(sum.error);
      inverse_offset[i] = -sum.value;
      inverse_offset_error[i] = off.error == 0 ? off.value : upward * off.value;
    }
    return;
  }
  Image const back = image(inverse_linear, inverse_linear_error, offset, offset_error);
  inverse_offset = -back.value;
  inverse_offset_error = back.error;
}

Transform Transform::then(Transform const& next) const {
  if (next.translates()) return moved(next.offset, next.offset_error);
  Transform result;
  Product const ahead = product(next.linear, next.linear_error, linear, linear_error);
  result.linear = ahead.value;
  result.linear_error = ahead.error;
  Image const moved =
      image(next.linear, next.linear_error, offset, offset_error, next.offset, next.offset_error);
  result.offset = moved.value;
  result.offset_error = moved.error;
  Product const back =
      product(inverse_linear, inverse_linear_error, next.inverse_linear, next.inverse_linear_error);
  result.inverse_linear = back.value;
  result.inverse_linear_error = back.error;
  result.set_inverse_offset();
  return result;
}

bool Transform::translates() const {
  Mat3 const none(0), same(1);
  return linear == same && inverse_linear == same && linear_error == none
         && inverse_linear_error == none;
}

bool Transform::none() const {
  return translates() && offset == Vec3(0) && offset_error == Vec3(0);
}

Transform Transform::moved(Vec3 const& by, Vec3 const& by_error) const {
  Transform result = *this;
  Vec3 made(0);
  for (int i = 0; i < 3; ++i) {
    Sum sum{offset[i], 0};
    sum.add(by[i]);
    result.offset[i] = sum.value;
    made[i] = sum.error;
  }
  result.offset_error = upward * (offset_error + by_error + made);
  result.set_inverse_offset();
  return result;
}

Transform Transform::inverse() const {
  return {inverse_linear,       inverse_offset,       linear,       offset,
          inverse_linear_error, inverse_offset_error, linear_error, offset_error};
}

bool Transform::identity() const {
  return linear == Mat3(1) && offset == Vec3(0);
}

} // namespace abbe::geometry
