// SPDX-License-Identifier: MIT
#include "lang/pasted.hpp"

#include "lang/interpreter.hpp"

#include <utility>

namespace abbe::lang {
namespace {

using Op = ast::BinaryOp;
constexpr std::size_t usual_length = 4;

/// How tightly an operator holds its operands.
int tightness(Op op) {
  switch (op) {
  case Op::Mul:
  case Op::Div:
    return 3;
  case Op::Add:
  case Op::Sub:
    return 2;
  case Op::And:
  case Op::Or:
    return 0;
  default:
    return 1;
  }
}

MacroValue const* macro_of(ast::Expr const& expr, Interpreter& in) {
  auto const* const call = ast::get_if<ast::Call>(expr);
  if (call == nullptr || call->callee.reserved || !call->element.empty()) return nullptr;
  Value const* const value = in.scope.find(in.scope.symbol(call->callee));
  return value != nullptr ? std::get_if<MacroValue>(&value->any) : nullptr;
}

} // namespace

bool Pasted::calls_macro(ast::Expr const& expr, Interpreter& in) {
  if (auto const* const binary = ast::get_if<ast::Binary>(expr)) return calls_macro(*binary, in);
  if (auto const* const unary = ast::get_if<ast::Unary>(expr)) return calls_macro(*unary, in);
  return macro_of(expr, in) != nullptr;
}

void Pasted::add(ast::Binary const& node) {
  add(node.left);
  op_ = node.op;
  add(node.right);
}

void Pasted::add(ast::Unary const& node) {
  signs_.push_back(node.op);
  add(node.operand);
}

void Pasted::add_open(ast::Expr const& expr) {
  if (auto const* const binary = ast::get_if<ast::Binary>(expr)) {
    add_open(binary->left);
    op_ = binary->op;
    add_open(binary->right);
  } else if (auto const* const unary = ast::get_if<ast::Unary>(expr)) {
    signs_.push_back(unary->op);
    add_open(unary->operand);
  } else {
    add(expr);
  }
}

/// What holds no macros is one operand: its own operators hold tighter than those around it.
void Pasted::add(ast::Expr const& expr) {
  if (auto const* const binary = ast::get_if<ast::Binary>(expr);
      binary && calls_macro(*binary, in_))
    return add(*binary);
  if (auto const* const unary = ast::get_if<ast::Unary>(expr); unary && calls_macro(*unary, in_))
    return add(*unary);
  if (MacroValue const* const macro = macro_of(expr, in_)) {
    MacroValue const copy = *macro; // the macro may redefine itself
    return in_.reader.paste(*ast::get_if<ast::Call>(expr), copy, *this);
  }
  add(in_.expressions.value(expr), ast::span_of(expr));
}

void Pasted::add(Value value, Span span) {
  for (; !signs_.empty(); signs_.pop_back())
    value.any = with_sign(signs_.back(), in_.expressions.to_numeric(value, span));
  if (operands_.empty()) operands_.reserve(usual_length);
  operands_.push_back({op_, std::move(value), span});
}

Value Pasted::value() {
  next_ = 0;
  return level(0);
}

Value Pasted::level(int least) {
  if (least > 3) return std::move(operands_[next_++].value);
  Span const at = operands_[next_].span;
  Value left = level(least + 1);
  while (next_ < operands_.size() && tightness(operands_[next_].op) == least) {
    Op const op = operands_[next_].op;
    Span const right_at = operands_[next_].span;
    left = apply(op, left, level(least + 1), at, right_at);
  }
  return left;
}

Value Pasted::apply(Op op, Value const& left, Value const& right, Span at, Span right_at) {
  Value result;
  auto const* const a = std::get_if<Numeric>(&left.any);
  auto const* const b = std::get_if<Numeric>(&right.any);
  auto const* const text = std::get_if<std::string>(&left.any);
  if (a != nullptr && b != nullptr) {
    result.any = in_.expressions.binary(op, *a, *b, joined(at, right_at));
  } else if (op == Op::Mul || op == Op::Div) {
    return in_.expressions.product(op, left, at, right, right_at);
  } else if (text != nullptr && tightness(op) == 1) {
    result.any = in_.expressions.comparison(op, *text, right, right_at);
  } else {
    in_.expressions.to_numeric(left, at);
    in_.expressions.to_numeric(right, right_at);
    result.any = poison();
  }
  return result;
}

} // namespace abbe::lang
