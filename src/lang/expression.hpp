// SPDX-License-Identifier: MIT
#pragma once

#include "grammar/ast.hpp"
#include "lang/builtins.hpp"
#include "lang/value.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace abbe::lang {

class Interpreter;

/// Evaluates expressions (section 2 of the language notes). An expression that is wrong is reported
/// where it is wrong and yields a poisoned value (Numeric of size 0, an empty Value), which spreads
/// silently, so that one mistake gives one message.
class Expressions {
public:
  explicit Expressions(Interpreter& interpreter) : in_(interpreter) {}

  /// A float, vector or colour. Anything else is an error.
  Numeric numeric(ast::Expr const&);
  /// A value that must be a float; nullopt when it is not (reported). `what` ("a subscript") is for
  /// messages.
  std::optional<double> number(ast::Expr const&, std::string_view what);
  /// The same with 0 for a wrong value.
  double scalar(ast::Expr const&, std::string_view what);
  /// `#if`, `#while`: |value| > 1e-10. nullopt when the expression is wrong (reported).
  std::optional<bool> condition(ast::Expr const&);
  std::string string(ast::Expr const&, std::string_view what);
  /// Anything that can be declared.
  Value value(ast::Expr const&);

  /// Does the expression yield a string? Decided without evaluating it.
  bool is_string(ast::Expr const&);
  /// The one expression in a list of items, nullptr when there is more or else in it.
  static ast::Expr const* sole(ast::Items const&);

  /// `A[i][j]`: the element, or nullptr (reported). An element without a value is no error here.
  Value* element(ast::Index const&);
  /// The same, and an element without a value is reported, too.
  Value* set_element(ast::Index const&);
  /// element() as a cell that shares ownership with its array; for call by reference and
  /// assignment.
  std::shared_ptr<Value> element_cell(ast::Index const&);
  /// The array that the element belongs to, nullptr (reported) when it is none.
  std::shared_ptr<ArrayValue> array_of(ast::Index const&);

  Numeric name(ast::Name const&);
  Numeric binary(ast::BinaryOp, Numeric const&, Numeric const&, Span);
  /// A name that stands for nothing: reported with suggestions.
  void undeclared(ast::Name const&);
  void use_deprecated(ast::Name const&);

  // One for each node of the tree.
  Numeric operator()(ast::Number const&);
  Numeric operator()(ast::LiteralVector const&);
  Numeric operator()(ast::Name const& node) { return name(node); }
  Numeric operator()(ast::String const&);
  Numeric operator()(ast::Vector const&);
  Numeric operator()(ast::Unary const&);
  Numeric operator()(ast::Binary const&);
  Numeric operator()(ast::Conditional const&);
  Numeric operator()(ast::Member const&);
  Numeric operator()(ast::Index const&);
  Numeric operator()(ast::Call const&);
  Numeric operator()(ast::Paren const&);
  Numeric operator()(ast::Array const&);
  Numeric operator()(ast::Function const&);
  Numeric operator()(ast::Block const&);

  /// `S * f`, `f * S` where S is a spectrum or a colour with one. nullopt, and nothing evaluated,
  /// when neither operand can be one; the ordinary product when it turns out that neither is.
  std::optional<Value> spectral_product(ast::Binary const&);
  /// A product or quotient of values, of which one may be a spectrum.
  Value product(ast::BinaryOp, Value const& left, Span, Value const& right, Span);
  /// The order of two strings as `op` asks for it. A right side that is none is reported.
  Numeric comparison(ast::BinaryOp, std::string const& left, Value const& right, Span);
  /// The value as a number, reported when it is none.
  Numeric to_numeric(Value const&, Span);
  /// A call of anything but a macro, on evaluated arguments.
  Value call(ast::Call const&);

private:
  Numeric plain(ast::Binary const&);
  Numeric operand(ast::Expr const&);
  std::string text_of(Value const&, std::string_view what, Span);
  Numeric call_numeric(ast::Call const&, Value const& callee);
  /// What is called, nullptr (reported) when it is nothing.
  Value const* callee(ast::Call const&);
  Value array(ast::Array const&);
  bool fill(ArrayValue&, ast::Items const&, std::size_t dimension, std::size_t& next, Span);

  Interpreter& in_;
};

Numeric with_sign(ast::UnaryOp, Numeric);
/// From the first to the second, which may stand in another text.
inline Span joined(Span first, Span second) {
  bool const one = first.source == second.source && second.end > first.begin;
  return one ? Span{first.source, first.begin, second.end} : first;
}

inline Numeric poison() {
  Numeric n;
  n.size = 0;
  return n;
}

} // namespace abbe::lang
