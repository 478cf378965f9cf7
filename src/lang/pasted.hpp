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
  static bool calls_macro(ast::Binary const& node, Interpreter& in) {
    return node.calls && (calls_macro(node.left, in) || calls_macro(node.right, in));
  }
  static bool calls_macro(ast::Unary const& node, Interpreter& in) {
    return node.calls && calls_macro(node.operand, in);
  }

  /// The operands and operators of an expression, in which the macros are expanded.
  void add(ast::Expr const&);
  void add(ast::Binary const&);
  void add(ast::Unary const&);
  /// The same of what a macro yields, of which the operators outside take the first or last
  /// operand.
  void add_open(ast::Expr const&);
  /// One operand.
  void add(Value, Span);
  /// What has been added as one value; empty after an error.
  Value value();

private:
  struct Operand {
    ast::BinaryOp op; ///< before it; of the first it has no meaning
    Value value;      ///< with its signs
    Span span;
  };
  Value level(int least);
  Value apply(ast::BinaryOp, Value const& left, Value const& right, Span at, Span right_at);

  Interpreter& in_;
  std::vector<Operand> operands_;
  std::size_t next_ = 0;                  ///< to be grouped
  ast::BinaryOp op_ = ast::BinaryOp::Add; ///< before the next operand
  std::vector<ast::UnaryOp> signs_;       ///< of it
};

} // namespace abbe::lang
