// SPDX-License-Identifier: MIT
#pragma once

#include "base/scalar_field.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace abbe::field {

/// What is known of a number along eight pieces of a line, for each of them: enclosures of its
/// values and of its derivative along the line, and its value in the middle of the piece, `c`, with
/// a bound `e` of how far that is rounded. What is undefined is NaN in `c`.
struct Enclosures {
  static constexpr int lanes = LinePieces::most;
  alignas(64) double v_low[lanes], v_high[lanes], d_low[lanes], d_high[lanes], c[lanes], e[lanes];
};

/// An operation that is carried out piece by piece.
class TapeCall {
public:
  virtual ~TapeCall() = default;
  /// @param operands as many as its step has, @param half half of each piece's length
  virtual void run(Enclosures const* const* operands, double const* half, int count,
                   Enclosures& out) const = 0;
};

/// A function of x, y and z as steps, each of which makes one number of those before it.
struct Tape {
  enum class Op : std::uint8_t {
    Constant,  ///< value
    Parameter, ///< a: 0 x, 1 y, 2 z
    Add,       ///< a + b, and so on
    Sub,
    Mul,
    Div,
    AddConstant, ///< a + value
    MulConstant, ///< a * value
    Square,
    Abs,
    Sqrt,
    Sin,
    Cos,
    Exp,
    Power, ///< a to the power of `value`, a whole number from 3 to 16
    Atan2, ///< the angle of y = a, x = b
    Min,
    Max,
    Call ///< calls[a], of b operands from operands[first]
  };
  struct Step {
    Op op = Op::Constant;
    std::uint32_t a = 0, b = 0, first = 0;
    double value = 0;
  };
  static constexpr std::size_t most_steps = 4096;

  std::vector<Step> steps; ///< the last is the result
  std::vector<std::uint32_t> operands;
  std::vector<std::shared_ptr<TapeCall const>> calls;

  /// ScalarField::along_each.
  void along_each(Vec3 const& origin, Vec3 const& direction, LinePieces& pieces) const;
};

} // namespace abbe::field
