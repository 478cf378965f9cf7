// SPDX-License-Identifier: MIT
#pragma once

#include "grammar/ast.hpp"
#include "lang/value.hpp"

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace abbe::lang {

class Interpreter;

/// A user function, `function(a, b) { ... }`: an expression of floats, compiled when it is
/// declared, or a block (see block_function.hpp). What it names besides its parameters is captured
/// by value then. Its body has no messages: division by zero gives infinities.
struct FunctionValue {
  /// One operation; operands are places in `nodes`, or in `operands` for calls.
  struct Node {
    enum class Kind : std::uint8_t {
      Constant,
      Parameter,
      Add,
      Sub,
      Mul,
      Div,
      And,
      Or,
      Less,
      LessEqual,
      Equal,
      NotEqual,
      GreaterEqual,
      Greater,
      Negate,
      Builtin,
      Min,
      Max,
      Select,
      Function,
      Part,
      Sum,
      Product,
      Noise,
      NoiseGenerator,
      Ridged,
      Hetero
    } kind = Kind::Constant;
    std::uint32_t a = 0, b = 0; ///< operands; of calls: first in `operands` and their number
    std::uint32_t c = 0;        ///< parameter, built-in or called function
    double value = 0;           ///< of Part: which, of the vector that the called function gives
  };
  std::vector<Node> nodes; ///< operands before their users; the last is the result
  std::vector<std::uint32_t> operands;
  std::vector<std::shared_ptr<FunctionValue const>> called;
  std::size_t parameters = 3;
  std::size_t slots = 0;   ///< parameters and loop variables, when there are any of the latter
  std::string unsupported; ///< why it cannot be called, empty as a rule
  /// Instead of nodes: what a function made of a block yields.
  std::function<Numeric(std::span<double const>)> block;
  bool vector = false;                                     ///< `block` yields a vector or colour
  double least = -std::numeric_limits<double>::infinity(); ///< what `block` yields is not below
  double most = std::numeric_limits<double>::infinity();   ///< and not above
  /// Of `function 100, 80 { ... }`, which stands for a picture; else 0.
  int picture_width = 0, picture_height = 0;
};

/// Compiles a function; nullptr after an error (reported).
std::shared_ptr<FunctionValue> make_function(ast::Function const&, Interpreter&);
/// @param arguments as many as the function has parameters
Numeric evaluate_function(FunctionValue const&, std::span<double const> arguments);

} // namespace abbe::lang
