// SPDX-License-Identifier: MIT
// What an expression that stands as an item is to those who read the items: decided by what its
// names stand for now.
#include "lang/function.hpp"
#include "lang/interpreter.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace abbe::lang {

void ReaderImpl::classify_value(Value const& value, Span span) {
  Next kind = Next::Identifier;
  if (std::holds_alternative<Numeric>(value.any)) kind = Next::Numeric;
  if (std::holds_alternative<std::string>(value.any)) kind = Next::String;
  set(kind, span);
  peek_.value = &value;
}

void ReaderImpl::classify_owned(Value&& value, Span span) {
  peek_.owned = std::move(value);
  if (peek_.owned.empty()) peek_.owned.any = poison(); // reported already
  classify_value(peek_.owned, span);
}

void ReaderImpl::classify_name(ast::Name const& name, Span span) {
  if (name.reserved) {
    set(Next::Numeric, span);
    return;
  }
  Value const* const value = in_.scope.find(in_.scope.symbol(name));
  if (value && !value->empty()) {
    in_.expressions.use_deprecated(name);
    if (std::holds_alternative<MacroValue>(value->any)) {
      in_.error("E0305",
                fmt::format("'{}' is a macro: its call needs parentheses, '{}(...)'", name.text,
                            name.text),
                span);
      classify_owned({}, span);
      return;
    }
    classify_value(*value, span);
    return;
  }
  set(Next::Word, span);
  peek_.word = name.text;
  peek_.undeclared = true;
}

void ReaderImpl::classify_element(ast::Index const& index) {
  Value const* const value = in_.expressions.set_element(index);
  if (value)
    classify_value(*value, index.span);
  else
    classify_owned({}, index.span);
}

/// `P (R*2)`, where P is a plain value: two items written without a comma.
ast::Call const* ReaderImpl::split_call(ast::Expr const& expr) {
  auto const* call = ast::get_if<ast::Call>(expr);
  if (!call || call->callee.reserved) return nullptr;
  Value const* value = in_.scope.find(in_.scope.symbol(call->callee));
  // The elements of an array are of one type: any of them tells, without evaluating subscripts.
  while (value && !call->element.empty()) {
    auto const* array = std::get_if<std::shared_ptr<ArrayValue>>(&value->any);
    if (!array) break;
    auto const set = std::ranges::find_if((*array)->elements, [](auto& e) { return !e.empty(); });
    value = set == (*array)->elements.end() ? nullptr : &*set;
  }
  if (!value) return call;
  bool const callable = std::holds_alternative<MacroValue>(value->any)
                        || std::holds_alternative<std::shared_ptr<FunctionValue>>(value->any)
                        || std::holds_alternative<std::shared_ptr<SplineValue>>(value->any);
  return callable ? nullptr : call;
}

void ReaderImpl::classify_call(ast::Call const& call, Span span) {
  if (call.callee.reserved) {
    Builtin const* const builtin = find_builtin(in_.scope.symbol(call.callee));
    set(builtin && builtin->yields_string ? Next::String : Next::Numeric, span);
    return;
  }
  Value const* const value = in_.scope.find(in_.scope.symbol(call.callee));
  auto const* macro = value ? std::get_if<MacroValue>(&value->any) : nullptr;
  if (macro && call.element.empty()) {
    in_.expressions.use_deprecated(call.callee);
    ++frames_.back().position;
    push_macro(call, *macro);
    return;
  }
  if (!split_call(*peek_.expr)) {
    set(Next::Numeric, span);
    return;
  }
  if (frames_.back().part > 0)
    set(Next::Numeric, span);
  else if (call.element.empty())
    classify_name(call.callee, call.callee.span);
  else
    classify_element(call.element.front());
  peek_.split = &call;
}

namespace {

/// The first operand of a chain of operators, if it is a name, an element, a call or a string and
/// a sign follows it.
ast::Expr const* before_sign(ast::Binary const& node) {
  if (auto const* const inner = ast::get_if<ast::Binary>(node.left)) return before_sign(*inner);
  if (node.op != ast::BinaryOp::Add && node.op != ast::BinaryOp::Sub) return nullptr;
  auto const* const name = ast::get_if<ast::Name>(node.left);
  bool const may = (name != nullptr && !name->reserved) || ast::get_if<ast::String>(node.left)
                   || ast::get_if<ast::Call>(node.left) || ast::get_if<ast::Index>(node.left);
  return may ? &node.left : nullptr;
}

/// Does the macro yield a block, as far as its body tells?
bool yields_block(MacroValue const& macro) {
  ast::Items const& body = macro.tree->body;
  return !body.empty() && ast::get_if<ast::Block>(body.back()) != nullptr;
}

/// The chain without that operand: the sign belongs to what follows it.
ast::Expr without_first(ast::Binary const& node) {
  auto const* const inner = ast::get_if<ast::Binary>(node.left);
  ast::Binary rest = node;
  if (inner != nullptr) {
    rest.left = without_first(*inner);
    return ast::Expr(std::move(rest));
  }
  auto const op = node.op == ast::BinaryOp::Sub ? ast::UnaryOp::Minus : ast::UnaryOp::Plus;
  return ast::Expr(ast::Unary{ast::span_of(node.right), op, node.calls, node.right});
}

} // namespace

/// `Object -y`, `"text" -1`, where what stands before the sign is no number: two items written
/// without a comma.
/// @return false when it is one value
bool ReaderImpl::classify_sum(ast::Expr const& expr, ast::Binary const& sum) {
  ast::Expr const* const first = before_sign(sum);
  if (first == nullptr) return false;
  if (auto const* const name = ast::get_if<ast::Name>(*first)) {
    Value const* const value = in_.scope.find(in_.scope.symbol(*name));
    bool const number =
        value == nullptr || value->empty() || std::holds_alternative<Numeric>(value->any)
        || std::holds_alternative<MacroValue>(value->any)
        || std::holds_alternative<scene::Colour>(value->any)
        || std::holds_alternative<std::shared_ptr<optics::Spectrum const>>(value->any);
    if (number) return false;
  }
  if (ast::get_if<ast::Index>(*first) && !in_.expressions.is_string(*first)) return false;
  if (auto const* const call = ast::get_if<ast::Call>(*first); call && call->callee.reserved) {
    if (!in_.expressions.is_string(*first)) return false;
  } else if (call != nullptr) {
    Value const* const value = in_.scope.find(in_.scope.symbol(call->callee));
    auto const* const macro = value ? std::get_if<MacroValue>(&value->any) : nullptr;
    if (macro == nullptr || !yields_block(*macro)) return false;
    if (frames_.back().part == 0) {
      frames_.back().part = 1;
      in_.expressions.use_deprecated(call->callee);
      push_macro(*call, *macro);
      return true;
    }
  }
  if (frames_.back().part == 0) {
    classify(*first);
    peek_.rest = &expr;
    return true;
  }
  ast::Expr const& rest = rests_[&sum] = without_first(sum);
  set(Next::Numeric, ast::span_of(rest));
  peek_.expr = &rest;
  peek_.rest = &expr;
  return true;
}

void ReaderImpl::classify(ast::Expr const& expr) {
  peek_.expr = &expr;
  if (ast::get_if<ast::LiteralVector>(expr) || ast::get_if<ast::Number>(expr)) {
    set(Next::Numeric, ast::span_of(expr));
    return;
  }
  Span const span = ast::span_of(expr);
  if (auto const* name = ast::get_if<ast::Name>(expr)) return classify_name(*name, span);
  if (auto const* block = ast::get_if<ast::Block>(expr)) {
    set(Next::Block, span);
    peek_.block = block;
    peek_.word = block->head.text;
    return;
  }
  if (ast::get_if<ast::String>(expr)) return set(Next::String, span);
  if (auto const* call = ast::get_if<ast::Call>(expr)) return classify_call(*call, span);
  if (auto const* index = ast::get_if<ast::Index>(expr)) {
    classify_element(*index);
    peek_.expr = &expr;
    return;
  }
  if (ast::get_if<ast::Array>(expr) || ast::get_if<ast::Function>(expr)) {
    Value value = in_.expressions.value(expr);
    peek_.expr = &expr;
    return classify_owned(std::move(value), span);
  }
  if (auto const* binary = ast::get_if<ast::Binary>(expr)) {
    if (classify_sum(expr, *binary)) return;
    if (auto scaled = in_.expressions.spectral_product(*binary)) {
      peek_.expr = &expr;
      return classify_owned(std::move(*scaled), span);
    }
  }
  set(in_.expressions.is_string(expr) ? Next::String : Next::Numeric, span);
}

} // namespace abbe::lang
