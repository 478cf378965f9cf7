// SPDX-License-Identifier: MIT
#pragma once

#include "base/interval.hpp"
#include "base/vec.hpp"

namespace abbe {

/// A number at each point of space. The leaf libraries see a function of the scene language through
/// this interface.
class ScalarField {
public:
  /// Enclosures over a piece of a line: of the values, and of their derivative along the line.
  struct Along {
    Interval value;
    Interval slope = Interval::everything();
  };

  virtual ~ScalarField() = default;
  virtual double value(Vec3 const& point) const = 0;
  /// Over origin + t direction, t in `part`. Also where it is a single number: then the width of
  /// the value is the bound of its rounding.
  virtual Along along(Vec3 const& origin, Vec3 const& direction, Interval const& part) const = 0;
  /// Do enclosures of slopes shrink with the piece? Not where the field has steps or noise in it.
  virtual bool smooth() const = 0;
  /// Not of unit length.
  virtual Vec3 gradient(Vec3 const& point) const = 0;
};

} // namespace abbe
