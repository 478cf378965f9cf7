// SPDX-License-Identifier: MIT
#include "geometry/placed.hpp"

#include "geometry/bounds.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

namespace abbe::geometry {

namespace {

std::uint64_t bits(double x) {
  return std::bit_cast<std::uint64_t>(x);
}

} // namespace

bool Placed::uniform(Transform const& at) {
  double const by = at.linear[0][0], inverse = 1.0 / by;
  std::uint64_t const scale = bits(by), back = bits(inverse),
                      error = bits(Transform::error_of_inverse(by, inverse));
  std::uint64_t other = 0; // bits that should not be there
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      std::uint64_t const here = i == j ? ~std::uint64_t{0} : 0;
      other |= (bits(at.linear[i][j]) ^ (scale & here)) | bits(at.linear_error[i][j])
               | (bits(at.inverse_linear[i][j]) ^ (back & here))
               | (bits(at.inverse_linear_error[i][j]) ^ (error & here));
    }
  }
  return other == 0;
}

Placed::Whole Placed::whole_of(Transform const& at) {
  Mat3 const& m = at.inverse_linear;
  Whole out{m, Mat3(0), m == Mat3(m[0][0], 0, 0, 0, m[1][1], 0, 0, 0, m[2][2]), {}, {}};
  for (int row = 0; row < 3; ++row) {
    int entries = 0;
    double largest = 0;
    for (int column = 0; column < 3; ++column) {
      double const entry = std::fabs(m[column][row]);
      entries += entry != 0 ? 1 : 0;
      largest = std::fmax(largest, entry);
    }
    for (int column = 0; column < 3; ++column) {
      bool const none = entries == 1 && m[column][row] == 0;
      double const off = at.inverse_linear_error[column][row];
      out.size[column][row] = (none ? 0.0 : largest) + off / rounding;
      out.along_axes = out.along_axes && (row == column || off == 0);
    }
  }
  return out;
}

Placed::Placed(ShapePtr shape, Transform const& at)
    : shape_(std::move(shape)), offset_(at.offset), offset_error_(at.offset_error) {
  if (uniform(at)) {
    scale_ = at.linear[0][0];
    inverse_scale_ = at.inverse_linear[0][0];
    size_ = std::fabs(inverse_scale_) + at.inverse_linear_error[0][0] / rounding;
    Reach const reach(*this, at);
    ball_ = reach.ball_about(offset_);
    if (reach.unknown() || ball_ > 0) return;
  }
  auto whole = std::make_unique<Whole>(whole_of(at));
  whole->bounds = bounds_of(*shape_, at, whole->size);
  Whole& own = *whole;
  whole_ = std::move(whole);
  own.reach = Reach(*this, at);
}

Bounds Placed::bounds() const {
  if (whole_) return whole_->bounds;
  // What bounds_of() says, with a third of the work.
  Bounds const own = shape_->bounds();
  if (own.infinite || own.empty()) return own;
  double const size = std::fabs(scale_);
  double const inverse_error = Transform::error_of_inverse(scale_, inverse_scale_);
  Vec3 const middle = own.low * 0.5 + own.high * 0.5, half = own.high * 0.5 - own.low * 0.5;
  Vec3 const centre = scale_ * middle + offset_;
  Vec3 const reach = size * half;
  Vec3 const far = size * glm::abs(middle) + reach;
  Vec3 const off = offset_error_ + size * (inverse_error * far + size_ * offset_error_);
  Vec3 const wide = reach + gamma_bound(64) * (far + glm::abs(offset_)) + off;
  return box_of(centre - wide, centre + wide);
}

void Placed::half_spaces(std::vector<HalfSpace>& out) const {
  if (Bounds const own = bounds(); !own.infinite) {
    for (int axis = 0; axis < 3 && !own.empty(); ++axis) {
      Vec3 along(0);
      along[axis] = 1;
      out.push_back({along, own.high[axis]});
      out.push_back({-along, -own.low[axis]});
    }
    return;
  }
  std::size_t const first = out.size();
  shape_->half_spaces(out);
  for (std::size_t i = first; i < out.size(); ++i) {
    Vec3 const normal = to_world_normal(out[i].normal);
    double const length = glm::length(normal);
    out[i] = {normal / length, (out[i].most + glm::dot(normal, offset_)) / length};
  }
}

Ray Placed::to_object(Ray const& world) const {
  Vec3 const from_here = world.origin - offset_;
  Vec3 const off = rounding * glm::abs(from_here) + offset_rounding();
  Vec3 const turned = rounding * glm::abs(world.direction);
  if (!whole_) {
    return {inverse_scale_ * from_here, inverse_scale_ * world.direction,
            size_ * world.origin_error, size_ * off, size_ * turned};
  }
  Mat3 const &m = whole_->inverse_linear, &s = whole_->size;
  if (whole_->along_axes) { // the same bits with a third of the work
    Vec3 const scale(m[0][0], m[1][1], m[2][2]), size(s[0][0], s[1][1], s[2][2]);
    return {scale * from_here, scale * world.direction, size * world.origin_error, size * off,
            size * turned};
  }
  return {m * from_here, m * world.direction, s * world.origin_error, s * off, s * turned};
}

Vec3 Placed::to_object(Vec3 const& world_point) const {
  Vec3 const from_here = world_point - offset_;
  return whole_ ? whole_->inverse_linear * from_here : inverse_scale_ * from_here;
}

Vec3 Placed::normal(std::uint32_t face, Vec3 const& world_point, bool geometric) const {
  Vec3 const point = to_object(world_point);
  return to_unit_world_normal(geometric ? shape().geometric_normal(point, face)
                                        : shape().normal(point, face));
}

Vec3 Placed::facing(std::uint32_t face, Vec3 const& world_point) const {
  Vec3 const n = to_unit_world_normal(shape().facing(to_object(world_point), face));
  if (shape().side() != Side::FacingByAxis) return n;
  Vec3 const size = glm::abs(n);
  int axis = size.y > size.x ? 1 : 0;
  if (size.z > size[axis]) axis = 2;
  return (n[axis] > 0) == (axis == 1) ? n : -n;
}

Vec3 Placed::to_unit_world_normal(Vec3 const& n) const {
  // The direction only: scaled to the order of 1 first, so that no square overflows.
  Vec3 world;
  if (whole_ && whole_->along_axes) {
    Mat3 const& back = whole_->inverse_linear;
    world = n * Vec3(back[0][0], back[1][1], back[2][2]);
  } else {
    world = to_world_normal(n);
  }
  Vec3 const size = glm::abs(world);
  double const largest = std::max(size.x, std::max(size.y, size.z));
  return glm::normalize(world / largest);
}

Bounds Placed::bounds_of(Shape const& shape, Transform const& at, Mat3 const& inverse_size) {
  Bounds const own = shape.bounds();
  if (own.infinite || own.empty()) return own;
  Mat3 const size(glm::abs(at.linear[0]), glm::abs(at.linear[1]), glm::abs(at.linear[2]));
  Vec3 const middle = own.low * 0.5 + own.high * 0.5, half = own.high * 0.5 - own.low * 0.5;
  Vec3 const centre = at.point(middle);
  Vec3 const reach = size * half;
  Vec3 const far = size * glm::abs(middle) + reach;
  // What to_object is off by, taken back to the world.
  Vec3 const off = at.offset_error + at.linear_error * (glm::abs(middle) + half)
                   + size * (at.inverse_linear_error * far + inverse_size * at.offset_error);
  Vec3 const wide = reach + gamma_bound(64) * (far + glm::abs(at.offset)) + off;
  return box_of(centre - wide, centre + wide);
}

} // namespace abbe::geometry
