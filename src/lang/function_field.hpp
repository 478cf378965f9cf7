// SPDX-License-Identifier: MIT
#pragma once

#include "base/scalar_field.hpp"
#include "lang/function.hpp"

#include <memory>

namespace abbe::lang {

/// A user function of x, y, z as a field: its operations carried out on intervals, with the
/// derivative along the line carried along (forward differentiation). Enclosures hold what
/// evaluate_function() gives, for any rounding of the library functions up to 4 units in the last
/// place. Steps (comparisons, floor, select ...) have a slope of anything where they may step;
/// noise has the bound of its slope.
class FunctionField final : public ScalarField {
public:
  /// @param function of 3 parameters, callable
  explicit FunctionField(std::shared_ptr<FunctionValue const> function);
  double value(Vec3 const& point) const override;
  Along along(Vec3 const& origin, Vec3 const& direction, Interval const& part) const override;
  bool smooth() const override { return smooth_; }
  Vec3 gradient(Vec3 const& point) const override;

private:
  std::shared_ptr<FunctionValue const> function_;
  bool smooth_;
};

} // namespace abbe::lang
