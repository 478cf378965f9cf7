// SPDX-License-Identifier: MIT
#pragma once

#include "base/vec.hpp"

#include <optional>

namespace abbe::geometry {

/// p -> linear * p + offset, with its inverse.
///
/// Each number carries a bound of its error: |what stands here - what exact arithmetic makes of the
/// steps as they were given| is at most that, entry by entry, for chains of any length. Steps that
/// are exact (translations, scaling by powers of two, quarter turns) have none; what a composition
/// adds is the rounding that really happened, not its bound, so that exact sums stay exact. Bounds
/// scale with the scene: by 2^k, the same bits.
struct Transform {
  Mat3 linear{1};
  Vec3 offset{0};
  Mat3 inverse_linear{1};
  Vec3 inverse_offset{0};
  Mat3 linear_error{0};
  Vec3 offset_error{0};
  Mat3 inverse_linear_error{0};
  Vec3 inverse_offset_error{0};

  static Transform translation(Vec3 const& by);
  /// By a place that was computed with at most `roundings` relative rounding errors a component.
  static Transform rounded_translation(Vec3 const& by, int roundings);
  static Transform scaling(Vec3 const& by);
  /// What 1 / by is off by, where `inverse` stands for it.
  static double error_of_inverse(double by, double inverse);
  /// scaling(scale).then(translation(offset)), bit by bit; of 1 and 0, none.
  static Transform scaled_and_moved(Vec3 const& scale, Vec3 const& offset);
  /// POV-Ray's rotate: about x, then y, then z, degrees, left-handed.
  static Transform rotation(Vec3 const& degrees);
  static Transform rotation_about(Vec3 const& axis, double degrees);
  /// POV-Ray's `matrix <...>`: 12 numbers, rows of a row-vector matrix; nullopt when singular.
  static std::optional<Transform> matrix(double const (&rows)[12]);
  /// `*this` first, then `next`.
  Transform then(Transform const& next) const;
  Transform inverse() const;
  Vec3 point(Vec3 const& p) const { return linear * p + offset; }
  Vec3 vector(Vec3 const& v) const { return linear * v; }
  /// Direction of a normal (transposed inverse), not normalised.
  Vec3 normal(Vec3 const& n) const { return glm::transpose(inverse_linear) * n; }
  bool identity() const;
  /// identity(), exactly: then() such a one changes nothing.
  bool none() const;
  /// A translation, exactly.
  bool translates() const;

private:
  /// then() such a one: what most placements are made of.
  Transform moved(Vec3 const& by, Vec3 const& by_error) const;
  void set_inverse_offset();
  bool inverse_is_diagonal() const;
};

} // namespace abbe::geometry
