// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/line_query.hpp"
#include "simd/lane.hpp"

#include <cmath>
#include <span>
#include <vector>

/// Many half-spaces at once, in world space and four at a time, as a filter: it tells which of them
/// bound what a line has in common with all of them, and where about. The crossings themselves are
/// then computed by the shapes, so that a filtered answer has the bits of the unfiltered one.
///
/// Both the filter's t of a plane and the shape's own t +- error (with the slack) lie within
/// (at_rest + |t| per_t) / |speed| of the filter's t, where speed is the rate at which the line
/// nears the plane: whatever is farther apart than that is so for the shapes, too. What is not is
/// said to be unclear, and left to the general way.
namespace abbe::geometry {

class HalfSpaces {
public:
  /// @param primitive a plane (is_plane)
  /// @param outside_counts what is outside the plane is taken instead
  void add(PrimitiveId primitive, Placed const& placed, bool outside_counts);
  /// Call after the last add, which came in the order of primitives.
  void finish();
  bool empty() const { return primitives_.empty(); }

  /// A plane in world space, scaled so that the largest component of a bound on its absolute normal
  /// is 1: normal . p - level <= 0.
  struct Scaled {
    Vec3 normal;
    double level;
  };
  static Scaled scaled(Placed const& placed, bool outside_counts);
  /// The two parts of the bound above. @param offset_size sum of the sizes of an offset's
  /// components
  static double at_rest(Vec3 const& origin, Vec3 const& origin_error, double offset_size) {
    return rounding_ * (sum_of_sizes(origin) + 2 * offset_size) + 2 * sum_of_sizes(origin_error);
  }
  static double per_t(Vec3 const& direction) { return rounding_ * sum_of_sizes(direction); }
  /// A plane is nearly parallel below this many times per_t.
  static constexpr double clear_factor = 1024;
  std::span<PrimitiveId const> primitives() const { return primitives_; }
  std::size_t count() const { return primitives_.size(); }
  /// Place of a primitive among them, or -1.
  std::size_t place_of(PrimitiveId primitive) const;
  bool outside_counts(std::size_t k) const { return outside_counts_[k] != 0; }
  Scaled plane(std::size_t k) const {
    return {{normal_x_[k], normal_y_[k], normal_z_[k]}, level_[k]};
  }
  /// The same in floats.
  struct Narrow {
    float x, y, z, level;
  };
  Narrow const& narrow_plane(std::size_t k) const { return narrow_[k]; }
  /// Largest size of a level.
  double widest_level() const { return widest_level_; }
  /// at_rest() and per_t() of the planes here, for any lane type.
  template <class L>
  L at_rest_of(lane::Vec<L> const& origin, lane::Vec<L> const& origin_error) const {
    return L(rounding_) * (lane::sum(lane::abs(origin)) + L(2 * offset_size_))
           + L(2.0) * lane::sum(lane::abs(origin_error));
  }
  template <class L>
  L per_t_of(lane::Vec<L> const& direction) const {
    return L(rounding_) * lane::sum(lane::abs(direction));
  }

  enum class Verdict : std::uint8_t { Unclear, Nothing, Something };
  /// One end of the common part.
  struct End {
    double t = 0;
    double error = 0; ///< bound on the distance to the shape's own t +- error
    std::size_t plane = 0;
  };
  /// What of the line after its start is in all half-spaces.
  struct Common {
    End in;  ///< t = -infinity when the start is in all of them
    End out; ///< t = infinity when there is no end
    double at_rest = 0, per_t = 0;
  };
  /// Unclear when the start lies on a plane by the departure's or its own error, or when a plane is
  /// nearly parallel. The two ends need not be in order.
  Verdict common(Ray const& ray, Departure const* from, HalfSpaceScratch& scratch,
                 Common& out) const;
  /// How many planes' crossings after the start may be within their errors of `t` +- `error`, of
  /// those that enter the common part (those that leave it).
  int entering_near(Common const& common, double t, double error, HalfSpaceScratch const&) const;
  int leaving_near(Common const& common, double t, double error, HalfSpaceScratch const&) const;

private:
  /// Roundings: of the filter and of the shape's t 22 each at most, of the shape's error bound 26
  /// times group_margin, in terms of the bounds of the absolute normals; the rest pays for products
  /// of errors and for the speed in the denominator being off by a thousandth.
  static constexpr double rounding_ = gamma_bound(256);
  static double sum_of_sizes(Vec3 const& v) {
    return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z);
  }
  Verdict apply_departure(Departure const& from, double steep, HalfSpaceScratch& scratch) const;

  std::vector<PrimitiveId> primitives_; ///< ascending
  std::vector<std::uint8_t> outside_counts_;
  /// normal . p - level <= 0, in the plane's own scale: the largest component of a bound on the
  /// absolute normal is 1. Filled up to whole lanes by repetition.
  std::vector<double> normal_x_, normal_y_, normal_z_, level_;
  std::vector<Narrow> narrow_;
  double widest_level_ = 0;
  double offset_size_ = 0; ///< largest sum of the components of Placed::offset_size()
};

bool is_plane(Shape const& shape);

} // namespace abbe::geometry
