// SPDX-License-Identifier: MIT
#pragma once

#include "base/sampled_field.hpp"
#include "lang/function.hpp"

#include <limits>
#include <memory>

namespace abbe::lang {

struct FunctionTape;

/// A user function of x, y, z as a field: its operations carried out on intervals, with the
/// derivative along the line carried along (forward differentiation). Enclosures hold what
/// evaluate_function() gives, for any rounding of the library functions up to 4 units in the last
/// place. Steps (comparisons, floor, select ...) have a slope of anything where they may step;
/// noise has that of its cell. Patterns, pigments and splines are known at points alone.
class FunctionField final : public SampledField {
public:
  /// @param function of 3 parameters, callable
  explicit FunctionField(std::shared_ptr<FunctionValue const> function);
  double value(Vec3 const& point) const override;
  Along along(Vec3 const& origin, Vec3 const& direction, Interval const& part) const override;
  void along_each(Vec3 const& origin, Vec3 const& direction, LinePieces& pieces) const override;
  int side_by_side() const override;
  bool smooth() const override { return smooth_; }
  bool total() const override;
  std::shared_ptr<ScalarField const> with_slope(double most) const override;
  Vec3 gradient(Vec3 const& point) const override;

private:
  Along enclosure(Vec3 const& origin, Vec3 const& direction, Interval const& part) const;
  std::shared_ptr<FunctionValue const> function_;
  std::shared_ptr<FunctionTape const> tape_; ///< null: enclosures one by one
  bool smooth_;
  double most_slope_ = std::numeric_limits<double>::infinity();
};

} // namespace abbe::lang
