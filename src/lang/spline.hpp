// SPDX-License-Identifier: MIT
#pragma once

#include "grammar/ast.hpp"
#include "lang/reader.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace abbe::lang {

class Interpreter;

/// A spline (section 20.1 of the language notes): points of up to five components over ascending
/// keys.
struct SplineValue {
  enum class Kind : std::uint8_t { Linear, Quadratic, Cubic, Natural } kind = Kind::Linear;
  struct Point {
    double key;
    Numeric value;
  };
  std::vector<Point> points; ///< ascending keys
  std::uint8_t size = 2;     ///< components of the result

  /// Outside the keys: the end values.
  Numeric at(double key, Kind kind) const;
};

/// The content of `spline { ... }`.
std::shared_ptr<SplineValue> read_spline(Reader&);
/// `S(key [, type])`
Numeric call_spline(SplineValue const&, ast::Call const&, Interpreter&);

} // namespace abbe::lang
