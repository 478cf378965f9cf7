// SPDX-License-Identifier: MIT
#pragma once

#include "base/parameters.hpp"
#include "geometry/roots.hpp"
#include "geometry/shape.hpp"

#include <limits>
#include <vector>

namespace abbe::geometry {

/** @scene poly { order, <k1, k2, ...> [sturm] }
All points where a polynomial in x, y and z is zero; inside, it is negative. The coefficients stand
in this order: by falling powers of x, then of y, then of z, so for order 2 those of x^2, xy, xz, x,
y^2, yz, y, z^2, z, 1. `cubic { <20 coefficients> }` and `quartic { <35 coefficients> }` are of
order 3 and 4. `sturm` is accepted and has no effect.

| name | type | unit | default | range |
|---|---|---|---|---|
| order | integer | - | - | 2 to 35 |
| k1, k2, ... | (order + 1) (order + 2) (order + 3) / 6 numbers | - | - | any, not all of the powers
zero |

    poly { 2, <1, 0, 0, 0, 1, 0, 0, 1, 0, -1> }
*/
/// Canonical form: the coefficients divided by a power of two. One face, 0.
///
/// The line is moved to its closest approach to the origin and measured in a power of two of the
/// size of the surface's features there; the polynomial in the line's parameter is composed by
/// Horner's scheme and its roots are isolated on the whole line (roots.hpp). What doubles leave
/// open is composed again in Twofold numbers, closest approach included, and where features
/// are of very different size, once more for the piece of the line that is in question.
class PolynomialSurface final : public Shape {
public:
  /// @param coefficients as in the scene language; finite, some power with one that is not zero
  PolynomialSurface(int order, std::vector<double> coefficients);
  void crossings(Ray const& ray, Start const* start, Crossings& out) const override {
    find(ray, start, std::numeric_limits<double>::infinity(), true, out);
  }
  void crossings_ahead(Ray const& ray, Start const* start, double until,
                       Crossings& out) const override {
    find(ray, start, until, start != nullptr, out);
  }
  bool inside(Vec3 const& point) const override { return local<false>(point).value < 0; }
  Vec3 normal(Vec3 const& point, std::uint32_t face) const override;
  Bounds bounds() const override;

private:
  /// @param all else only what crossings_ahead() has to find
  void find(Ray const& ray, Start const* start, double until, bool all, Crossings& out) const;
  struct Window; ///< a line and the unit that it is measured in
  struct Local {
    double value;
    Vec3 slope;
  };
  /// Value and gradient; `Sizes`: of the polynomial with |coefficients|.
  template <bool Sizes>
  Local local(Vec3 const& point) const;
  Polynomial<double> compose(Window const& window) const;
  /// The same of a piece of the line, with its own error.
  Polynomial<Twofold> compose_piece(Window const& window, Twofold const& low, double width) const;
  template <class N>
  Polynomial<N> along(std::array<N, 3> const& point, std::array<N, 3> const& step) const;
  /// Sum of |coefficient| reach^degree.
  double size_within(double reach) const;

  int order_;
  std::vector<double> coefficients_;
  std::vector<double> size_; ///< by degree: sum of |coefficient|
  double feature_;           ///< power of two: all that is not far away is within this
};

std::optional<PlacedShape> make_polynomial(int order, std::vector<double> coefficients);
std::optional<PlacedShape> read_poly(Parameters& parameters);
/// `polynomial { order, xyz(i, j, k): coefficient, ... }`: the others are 0.
std::optional<PlacedShape> read_polynomial(Parameters& parameters);
std::optional<PlacedShape> read_cubic(Parameters& parameters);
std::optional<PlacedShape> read_quartic(Parameters& parameters);

} // namespace abbe::geometry
