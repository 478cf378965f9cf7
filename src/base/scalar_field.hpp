// SPDX-License-Identifier: MIT
#pragma once

#include "base/interval.hpp"
#include "base/vec.hpp"

namespace abbe {

/// Pieces of one line that are looked at side by side, and what is found there. Arrays, so that
/// kernels load them.
struct LinePieces {
  static constexpr int most = 8;
  int count = 0; ///< whoever asks fills the rest of `low` and `high` with copies
  alignas(64) double low[most], high[most];               ///< ends of each piece
  alignas(64) double value_low[most], value_high[most];   ///< enclosure of the values
  alignas(64) double slope_low[most], slope_high[most];   ///< of their derivative along the line
  alignas(64) double middle_low[most], middle_high[most]; ///< of the value in the middle
};

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
  /// Encloses what the field does at origin + t direction, t in `part`. Where `part` is a single
  /// number, the width of the value is the bound of its rounding.
  virtual Along along(Vec3 const& origin, Vec3 const& direction, Interval const& part) const = 0;
  /// Looks at several pieces as along() does at one, and at the value in the middle of each.
  virtual void along_each(Vec3 const& origin, Vec3 const& direction, LinePieces& pieces) const {
    for (int i = 0; i < pieces.count; ++i) {
      Interval const part(pieces.low[i], pieces.high[i]);
      Along const over = along(origin, direction, part);
      pieces.value_low[i] = over.value.low;
      pieces.value_high[i] = over.value.high;
      pieces.slope_low[i] = over.slope.low;
      pieces.slope_high[i] = over.slope.high;
      Interval const middle = along(origin, direction, Interval(part.middle())).value;
      pieces.middle_low[i] = middle.low;
      pieces.middle_high[i] = middle.high;
    }
  }
  /// How many pieces along_each() looks at in about the time of one.
  virtual int side_by_side() const { return 1; }
  /// Do enclosures of slopes shrink with the piece? Not where the field has steps or noise in it.
  virtual bool smooth() const = 0;
  /// Is it a number everywhere, as far as is known? Else enclosures hold what is one, and pieces
  /// may have parts where it is none.
  virtual bool total() const { return false; }
  /// Not of unit length.
  virtual Vec3 gradient(Vec3 const& point) const = 0;
};

} // namespace abbe
