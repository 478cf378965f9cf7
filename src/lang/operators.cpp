// SPDX-License-Identifier: MIT
// Arithmetic and comparison, component by component.
#include "lang/expression.hpp"
#include "lang/interpreter.hpp"

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
  case Op::LessEqual:
    return yes(a <= b + eps);
  case Op::Equal:
    return yes(std::abs(a - b) < eps);
  case Op::NotEqual:
    return yes(!(std::abs(a - b) < eps));
  case Op::GreaterEqual:
    return yes(a + eps >= b);
  case Op::Greater:
    return yes(a > b);
  }
  return 0;
}

/// A spectrum held by a name, or by a block `spectrum { ... }`.
std::optional<scene::Colour> spectrum_of(ast::Expr const& expr, Interpreter& in) {
  Value held;
  if (auto const* name = ast::get_if<ast::Name>(expr); name && !name->reserved) {
    Value const* const value = in.scope.find(in.scope.symbol(*name));
    bool const may_be = value && !std::holds_alternative<Numeric>(value->any);
    if (!may_be) return std::nullopt;
    held = *value;
  } else if (auto const* block = ast::get_if<ast::Block>(expr);
             block && block->head.text == "spectrum") {
    held = in.reader.block_value(*block);
  } else if (auto const* binary = ast::get_if<ast::Binary>(expr)) {
    if (auto value = in.expressions.scaled_spectrum(*binary)) held = std::move(*value);
  } else if (auto const* paren = ast::get_if<ast::Paren>(expr)) {
    ast::Expr const* const only = Expressions::sole(paren->items);
    return only ? spectrum_of(*only, in) : std::nullopt;
  }
  if (auto const* colour = std::get_if<scene::Colour>(&held.any))
    if (colour->spectrum) return *colour;
  if (auto const* spectrum = std::get_if<std::shared_ptr<optics::Spectrum const>>(&held.any)) {
    scene::Colour colour;
    colour.rgb = Vec3(1);
    colour.spectrum = *spectrum;
    return colour;
  }
  return std::nullopt;
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

std::optional<Value> Expressions::scaled_spectrum(ast::Binary const& node) {
  if (node.op != Op::Mul && node.op != Op::Div) return std::nullopt;
  auto const left = spectrum_of(node.left, in_);
  auto const right = !left && node.op == Op::Mul ? spectrum_of(node.right, in_) : std::nullopt;
  if (!left && !right) return std::nullopt;
  scene::Colour colour = left ? *left : *right;
  Numeric const n = numeric(left ? node.right : node.left);
  Value value;
  if (n.poisoned()) {
    value.any = n;
    return value;
  }
  Numeric const factor = n.promoted(3);
  if (node.op == Op::Mul)
    colour.rgb *= factor.vec3();
  else
    colour.rgb /= factor.vec3();
  value.any = colour;
  return value;
}

} // namespace abbe::lang
