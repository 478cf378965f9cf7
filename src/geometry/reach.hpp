// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/shape.hpp"

#include <cstdint>

namespace abbe::geometry {

class Placed;

/// What a line must come near to meet a placed shape: a ball or a plane, in world space. Asked
/// before the line is taken to object space, it says no to most lines for some twenty operations.
///
/// Conservative: `misses` is true only where Shape::crossings() gives nothing that counts, also
/// after all roundings of its own (bounds of Placed and of the kernels included). So what is found
/// does not depend on whether it was asked.
class Reach {
public:
  /// Says "may be met" to everything.
  Reach() = default;
  Reach(Placed const& placed, Transform const& placement);

  /// No crossing with t > 0 beyond what is at the start, and up to `until`. The primitive must not
  /// be one that the ray starts on.
  bool misses(Ray const& ray, double until) const {
    if (kind_ == Kind::Ball) return misses_ball(place_, size_, ray, until);
    return kind_ == Kind::Plane && misses_plane(ray, until);
  }
  /// The same of a ball. @param size its squared radius
  static bool misses_ball(Vec3 const& centre, double size, Ray const& ray, double until);
  bool unknown() const { return kind_ == Kind::Unknown; }
  /// The squared radius of a ball about `centre`; 0: none, or not there.
  double ball_about(Vec3 const& centre) const {
    return kind_ == Kind::Ball && place_ == centre ? size_ : 0;
  }

private:
  enum class Kind : std::uint8_t { Unknown, Ball, Plane };
  bool misses_plane(Ray const& ray, double until) const;
  void set_ball(Placed const& placed, Transform const& at);
  void set_plane(Placed const& placed);

  /// Share of radius and distance by which balls are wider than they are: at least six times what
  /// to_object rounds (16 roundings of origin and of direction, by sums of components, lengthened
  /// max_turning_ times: under 2^-41) and the kernels (2^-44) together.
  static constexpr double share_ = 0x1p-38;
  /// How much a rounding of object space may count in the world.
  static constexpr double max_turning_ = 64;

  Vec3 place_{0};   ///< centre; or normal, scaled as in HalfSpaces
  double size_ = 0; ///< squared radius; or level
  double rest_ = 0; ///< plane: what its offset adds to the error at rest
  Kind kind_ = Kind::Unknown;
};

inline bool Reach::misses_ball(Vec3 const& centre, double size, Ray const& ray, double until) {
  Vec3 const to = centre - ray.origin;
  Vec3 const& d = ray.direction;
  double const distance2 = to.x * to.x + to.y * to.y + to.z * to.z;
  double const along = to.x * d.x + to.y * d.y + to.z * d.z;
  double const length2 = d.x * d.x + d.y * d.y + d.z * d.z;
  // Wide enough for the roundings of either side: of the ball, and of the way to it.
  double const wide = size + share_ * distance2;
  if ((distance2 - wide) * length2 > along * along) return true;
  if (along < 0 && distance2 > wide) return true;
  double const beyond = along - until * length2;
  return beyond > 0 && beyond * beyond > wide * length2;
}

} // namespace abbe::geometry
