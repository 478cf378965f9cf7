// SPDX-License-Identifier: MIT
// Arithmetic and comparison, component by component.
#include "lang/expression.hpp"
#include "lang/interpreter.hpp"
#include "lang/pasted.hpp"

#include <cmath>
#include <limits>

namespace abbe::lang {
namespace {

using Op = ast::BinaryOp;
constexpr double eps = 1e-10; ///< POV-Ray's: equality and what counts as true

double apply(Op op, double a, double b) {
  auto const yes = [](bool b1) { return b1 ? 1.0 : 0.0; };
  switch (op) {
  case Op::Add:
    return a + b;
  case Op::Sub:
    return a - b;
  case Op::Mul:
    return a * b;
  case Op::Div:
    return b == 0 ? std::numeric_limits<double>::infinity() : a / b;
  case Op::And:
    return yes(std::abs(a) > eps && std::abs(b) > eps);
  case Op::Or:
    return yes(std::abs(a) > eps || std::abs(b) > eps);
  case Op::Less:
    return yes(a < b);
  case Op::LessEqual: // what is not a number is equal to all, as POV-Ray's
    return yes(!(a > b + eps));
  case Op::Equal:
    return yes(!(std::abs(a - b) > eps));
  case Op::NotEqual:
    return yes(std::abs(a - b) > eps);
  case Op::GreaterEqual:
    return yes(!(a + eps < b));
  case Op::Greater:
    return yes(a > b);
  }
  return 0;
}

/// May the expression be a spectrum? Decided without evaluating it: yes for calls of macros.
bool may_be_spectral(ast::Expr const& expr, Interpreter& in) {
  if (auto const* name = ast::get_if<ast::Name>(expr); name && !name->reserved) {
    Value const* const value = in.scope.find(in.scope.symbol(*name));
    return value
           && (std::holds_alternative<scene::Colour>(value->any)
               || std::holds_alternative<std::shared_ptr<optics::Spectrum const>>(value->any));
  }
  if (auto const* call = ast::get_if<ast::Call>(expr); call && !call->callee.reserved) {
    Value const* const value = in.scope.find(in.scope.symbol(call->callee));
    return value && std::holds_alternative<MacroValue>(value->any);
  }
  if (auto const* block = ast::get_if<ast::Block>(expr)) return block->head.text == "spectrum";
  if (auto const* paren = ast::get_if<ast::Paren>(expr)) {
    ast::Expr const* const only = Expressions::sole(paren->items);
    return only && may_be_spectral(*only, in);
  }
  auto const* binary = ast::get_if<ast::Binary>(expr);
  return binary && (binary->op == Op::Mul || binary->op == Op::Div)
         && (may_be_spectral(binary->left, in) || may_be_spectral(binary->right, in));
}

/// The value as a colour with a spectrum, if it is one.
std::optional<scene::Colour> spectral(Value const& value) {
  if (auto const* colour = std::get_if<scene::Colour>(&value.any)) return *colour;
  auto const* spectrum = std::get_if<std::shared_ptr<optics::Spectrum const>>(&value.any);
  if (!spectrum) return std::nullopt;
  scene::Colour colour;
  colour.rgb = Vec3(1);
  colour.spectrum = *spectrum;
  return colour;
}

} // namespace

Numeric Expressions::binary(Op op, Numeric const& a, Numeric const& b, Span span) {
  if (a.poisoned() || b.poisoned()) return poison();
  bool zero_divisor = false;
  if (a.size == 1 && b.size == 1) {
    zero_divisor = b.c[0] == 0;
    if (op == Op::Div && zero_divisor) in_.warning("division by zero", span);
    return scalar_of(apply(op, a.c[0], b.c[0]));
  }
  int const size = std::max(a.size, b.size);
  Numeric const left = a.promoted(size);
  Numeric const right = b.promoted(size);
  Numeric result;
  result.size = static_cast<std::uint8_t>(size);
  result.colour = (a.colour || b.colour) && size == 5;
  for (std::size_t i = 0; i < result.size; ++i) {
    zero_divisor = zero_divisor || right.c[i] == 0;
    result.c[i] = apply(op, left.c[i], right.c[i]);
  }
  if (op == Op::Div && zero_divisor) in_.warning("division by zero", span);
  return result;
}

std::optional<Value> Expressions::spectral_product(ast::Binary const& node) {
  bool const may = node.op == Op::Mul || node.op == Op::Div;
  if (!may || !(may_be_spectral(node.left, in_) || may_be_spectral(node.right, in_)))
    return std::nullopt;
  if (Pasted::calls_macro(node, in_)) {
    Pasted pasted(in_);
    pasted.add(node);
    return pasted.value();
  }
  return product(node.op, value(node.left), ast::span_of(node.left), value(node.right),
                 ast::span_of(node.right));
}

Value Expressions::product(Op op, Value const& left, Span left_at, Value const& right,
                           Span right_at) {
  auto colour = spectral(left);
  bool const swapped = !colour && op == Op::Mul;
  if (swapped) colour = spectral(right);
  Value result;
  if (!colour) {
    Numeric const a = to_numeric(left, left_at);
    result.any = binary(op, a, to_numeric(right, right_at), joined(left_at, right_at));
    return result;
  }
  Numeric const n = to_numeric(swapped ? left : right, swapped ? left_at : right_at);
  if (n.poisoned()) {
    result.any = n;
    return result;
  }
  Vec3 const factor = n.promoted(3).vec3();
  colour->rgb = op == Op::Mul ? colour->rgb * factor : colour->rgb / factor;
  result.any = *colour;
  return result;
}

} // namespace abbe::lang
