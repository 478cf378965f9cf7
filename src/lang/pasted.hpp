// SPDX-License-Identifier: MIT
#pragma once

#include "grammar/ast.hpp"
#include "lang/value.hpp"

#include <vector>

namespace abbe::lang {

class Interpreter;

/// A chain of operators of which macros write a part. Macros are text: `P() * 10` with the body
/// `1 + 2` is 1 + 2 * 10, and `P() < "b"` may compare strings. The operands and operators are
/// gathered in the order of the text, each operand evaluated where it stands; value() then groups
/// them.
class Pasted {
public:
  explicit Pasted(Interpreter& interpreter) : in_(interpreter) {}

  /// Does a macro write one of the operands? Decided without evaluating them.
  static bool calls_macro(ast::Expr const&, Interpreter&);
  static bool calls_macro(ast::Binary const&, Interpreter&);

  /// The operands and operators of an expression, in which the macros are expanded.
  void add(ast::Expr const&);
  void add(ast::Binary const&);
  void add(ast::Unary const&);
  /// One operand.
  void add(Value, Span);
  /// What has been added as one value; empty after an error.
  Value value();

private:
  struct Operand {
    ast::BinaryOp op; ///< before it; of the first it has no meaning
    std::vector<ast::UnaryOp> signs;
    Value value;
    Span span;
  };
  Value level(int least);
  Value signed_operand();
  Value apply(ast::BinaryOp, Value const& left, Value const& right, Span at, Span right_at);

  Interpreter& in_;
  std::vector<Operand> operands_;
  std::size_t next_ = 0;                  ///< to be grouped
  ast::BinaryOp op_ = ast::BinaryOp::Add; ///< before the next operand
  std::vector<ast::UnaryOp> signs_;       ///< of it
};

} // namespace abbe::lang
