// SPDX-License-Identifier: MIT
#pragma once

#include "base/scalar_field.hpp"

#include <complex>
#include <cstdint>

namespace abbe::geometry {

/// What is done to a number again and again: `c` is added to its function.
struct JuliaRule {
  enum class Function : std::uint8_t {
    Sqr,
    Cube,
    Exp,
    Reciprocal,
    Sin,
    Cos,
    Sinh,
    Cosh,
    Tan,
    Tanh,
    Asin,
    Acos,
    Atan,
    Asinh,
    Acosh,
    Atanh,
    Ln,
    Power
  };
  bool quaternion = true; ///< Sqr and Cube only; else hypercomplex: ij = k, ii = jj = -1, kk = 1
  Function function = Function::Sqr;
  Vec4 c{0};
  std::complex<double> power{0}; ///< of Power
  int rounds = 20;               ///< numbers looked at, the point itself being the first
  Vec4 slice{0, 0, 0, 1};        ///< unit normal of the space of three dimensions that is seen
  double slice_distance = 0;
  double bailout() const; ///< what none of the numbers may be larger than
  /// No point further from zero keeps all its numbers within the bailout: x -> |x^2 + c| is at
  /// least |x|^2 - |c|, and so for cubes; of the other functions it is the bailout.
  double reach() const;
};

/// Below zero where none of the numbers that begin with a point is larger than the bailout. It is
/// the square of the largest less that of the bailout, and of the last number where one that is
/// beyond the bailout never comes back.
///
/// Enclosures along a line are balls: a middle and a radius, for the number and for its derivative
/// along the line. Quaternions and complex numbers multiply their sizes, so a ball's image is a
/// ball whose radius is that of the polynomial of sizes. A hypercomplex number is two complex ones.
class JuliaField final : public ScalarField {
public:
  explicit JuliaField(JuliaRule const& rule);
  double value(Vec3 const& point) const override;
  Along along(Vec3 const& origin, Vec3 const& direction, Interval const& part) const override;
  void along_each(Vec3 const& origin, Vec3 const& direction, LinePieces& pieces) const override;
  int side_by_side() const override { return polynomial() ? LinePieces::most : 1; }
  bool smooth() const override;
  bool total() const override { return true; }
  Vec3 gradient(Vec3 const& point) const override;

private:
  /// A polynomial, whose enclosures are made side by side (julia_lanes.hpp).
  bool polynomial() const {
    return rule_.function == JuliaRule::Function::Sqr
           || rule_.function == JuliaRule::Function::Cube;
  }
  Vec4 lifted(Vec3 const& point) const;
  Vec3 quaternion_gradient(Vec3 const& point) const;
  Vec3 pair_gradient(Vec3 const& point) const;
  Along quaternions(Vec4 number, double radius, Vec4 slope) const;
  Along complex_pairs(Vec4 const& number, double radius, Vec4 const& slope) const;

  JuliaRule rule_;
  double limit_; ///< square of the bailout
  bool returns_; ///< may a number come back from beyond the bailout?
};

} // namespace abbe::geometry
