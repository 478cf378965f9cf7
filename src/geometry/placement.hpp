// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/transform.hpp"

#include <memory>

namespace abbe::geometry {

/// A Transform, kept small: none, and a scaling followed by an exact translation, which is where
/// most shapes stand, are 6 numbers; any other is kept whole, once for all copies. What was put in
/// comes out bit by bit.
class Placement {
public:
  Placement() = default;
  Placement(Transform const& transform);
  /// Transform::scaled_and_moved.
  static Placement scaled_and_moved(Vec3 const& scale, Vec3 const& offset) {
    Placement result;
    result.scale_ = scale;
    result.offset_ = 0.0 + offset; // no negative zero, as there
    return result;
  }

  Transform transform() const {
    return whole_ ? *whole_ : Transform::scaled_and_moved(scale_, offset_);
  }
  operator Transform() const { return transform(); }
  Transform then(Transform const& next) const;
  Transform inverse() const { return transform().inverse(); }
  Vec3 point(Vec3 const& p) const { return transform().point(p); }
  Vec3 vector(Vec3 const& v) const { return transform().vector(v); }
  /// Never moved.
  bool none() const { return !whole_ && scale_ == Vec3(1) && offset_ == Vec3(0); }
  /// By place and direction; its error bounds may say more than those of none.
  bool identity() const {
    return whole_ ? whole_->identity() : scale_ == Vec3(1) && offset_ == Vec3(0);
  }

private:
  Vec3 scale_{1}, offset_{0}; ///< unless `whole_`
  std::shared_ptr<Transform const> whole_;
};

} // namespace abbe::geometry
