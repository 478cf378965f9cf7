// SPDX-License-Identifier: MIT
#include "lang/expression.hpp"

#include "lang/arrays.hpp"
#include "lang/block_function.hpp"
#include "lang/function.hpp"
#include "lang/interpreter.hpp"
#include "lang/pasted.hpp"
#include "lang/spline.hpp"

#include <cmath>
#include <fmt/format.h>

namespace abbe::lang {

Numeric Numeric::promoted(int to) const {
  Numeric n = *this;
  if (size >= to) return n;
  if (size == 1) n.c.fill(c[0]);
  for (int i = size == 1 ? to : size; i < 5; ++i) n.c[static_cast<std::size_t>(i)] = 0;
  n.size = static_cast<std::uint8_t>(to);
  return n;
}

ast::Expr const* Expressions::sole(ast::Items const& items) {
  return items.size() == 1 ? ast::get_if<ast::Expr>(items.front()) : nullptr;
}

Numeric Expressions::numeric(ast::Expr const& expr) {
  return ast::visit(*this, expr);
}

double Expressions::scalar(ast::Expr const& expr, std::string_view what) {
  return number(expr, what).value_or(0);
}

std::optional<double> Expressions::number(ast::Expr const& expr, std::string_view what) {
  Numeric const n = numeric(expr);
  if (n.size == 1) return n.c[0];
  if (n.size > 1)
    in_.error("E0302", fmt::format("{} must be a float, not a vector", what), ast::span_of(expr));
  return std::nullopt;
}

std::optional<bool> Expressions::condition(ast::Expr const& expr) {
  auto const value = number(expr, "a condition");
  if (!value) return std::nullopt;
  return std::abs(*value) > 1e-10;
}

std::string Expressions::string(ast::Expr const& expr, std::string_view what) {
  return text_of(value(expr), what, ast::span_of(expr));
}

std::string Expressions::text_of(Value const& v, std::string_view what, Span span) {
  if (auto const* text = std::get_if<std::string>(&v.any)) return *text;
  auto const* number = std::get_if<Numeric>(&v.any);
  bool const reported = v.empty() || (number && number->poisoned());
  if (!reported)
    in_.error("E0301", fmt::format("expected {} (a string), found {}", what, type_name(v)), span);
  return {};
}

bool Expressions::is_string(ast::Expr const& expr) {
  if (ast::get_if<ast::String>(expr)) return true;
  if (auto const* name = ast::get_if<ast::Name>(expr)) {
    Value const* const v = name->reserved ? nullptr : in_.scope.find(in_.scope.symbol(*name));
    return v && std::holds_alternative<std::string>(v->any);
  }
  if (auto const* call = ast::get_if<ast::Call>(expr)) {
    Builtin const* const builtin =
        call->callee.reserved ? find_builtin(in_.scope.symbol(call->callee)) : nullptr;
    return builtin && builtin->yields_string;
  }
  if (auto const* index = ast::get_if<ast::Index>(expr)) {
    Value const* const v = in_.scope.find(in_.scope.symbol(index->array));
    auto const* array = v ? std::get_if<std::shared_ptr<ArrayValue>>(&v->any) : nullptr;
    if (!array || (*array)->elements.empty()) return false;
    Value const* const e = element(*index);
    return e && std::holds_alternative<std::string>(e->any);
  }
  if (auto const* paren = ast::get_if<ast::Paren>(expr)) {
    ast::Expr const* const only = sole(paren->items);
    return only && is_string(*only);
  }
  return false;
}

Numeric Expressions::to_numeric(Value const& value, Span span) {
  if (auto const* n = std::get_if<Numeric>(&value.any)) return *n;
  if (!value.empty())
    in_.error("E0301", fmt::format("expected a number, found {}", type_name(value)), span);
  return poison();
}

Value Expressions::value(ast::Expr const& expr) {
  Value v;
  if (auto const* text = ast::get_if<ast::String>(expr)) {
    v.any = text->text;
  } else if (auto const* name = ast::get_if<ast::Name>(expr); name && !name->reserved) {
    Value const* const found = in_.scope.find(in_.scope.symbol(*name));
    if (found && !found->empty()) {
      use_deprecated(*name);
      return copy_of(*found);
    }
    undeclared(*name);
  } else if (auto const* index = ast::get_if<ast::Index>(expr)) {
    if (Value const* const found = set_element(*index)) return copy_of(*found);
  } else if (auto const* call_node = ast::get_if<ast::Call>(expr)) {
    return call(*call_node);
  } else if (auto const* block = ast::get_if<ast::Block>(expr)) {
    return in_.reader.block_value(*block);
  } else if (auto const* array_node = ast::get_if<ast::Array>(expr)) {
    return array(*array_node);
  } else if (auto const* function = ast::get_if<ast::Function>(expr)) {
    if (auto made = make_function(*function, in_)) v.any = std::move(made);
  } else if (auto const* paren = ast::get_if<ast::Paren>(expr)) {
    return in_.reader.value_of(paren->items, paren->span);
  } else {
    if (auto const* binary_node = ast::get_if<ast::Binary>(expr))
      if (auto scaled = spectral_product(*binary_node)) return *scaled;
    v.any = numeric(expr);
  }
  return v;
}

// ------------------------------------------------------------------------------------- nodes

Numeric Expressions::operator()(ast::Number const& node) {
  return scalar_of(node.value);
}

Numeric Expressions::operator()(ast::LiteralVector const& node) {
  Numeric n;
  n.size = node.size;
  std::copy(node.values, node.values + 5, n.c.begin());
  return n;
}

Numeric Expressions::operator()(ast::String const& node) {
  in_.error("E0301", "expected a number, found a string", node.span);
  return poison();
}

Numeric Expressions::name(ast::Name const& node) {
  Symbol const symbol = in_.scope.symbol(node);
  if (symbol < first_builtin) return constant(static_cast<Constant>(symbol), in_);
  Value const* const found = in_.scope.find(symbol);
  if (found && !found->empty()) {
    if (in_.scope.deprecation(symbol)) use_deprecated(node);
    if (auto const* n = std::get_if<Numeric>(&found->any)) return *n;
    return to_numeric(*found, node.span);
  }
  undeclared(node);
  return poison();
}

void Expressions::undeclared(ast::Name const& node) {
  in_.error("E0201",
            fmt::format("undeclared identifier '{}'{}", node.text, in_.suggestion(node.text)),
            node.span);
}

void Expressions::use_deprecated(ast::Name const& node) {
  Symbol const symbol = in_.scope.symbol(node);
  auto* const how = in_.scope.deprecation(symbol);
  if (!how) return;
  in_.warning(how->message, node.span);
  if (how->once) in_.scope.forget_deprecation(symbol);
}

Numeric Expressions::operator()(ast::Vector const& node) {
  Numeric n;
  n.size = 0;
  bool bad = false;
  auto add = [&](Numeric const& part, Span span) {
    if (part.poisoned()) {
      bad = true;
    } else if (part.size > 1) {
      in_.error("E0302", "a component of a vector must be a float", span);
      bad = true;
    } else if (n.size == 5) {
      if (!bad) in_.error("E0323", "a vector has at most five components", node.span);
      bad = true;
    } else {
      n.c[n.size++] = part.c[0];
    }
  };
  bool simple = true;
  for (auto const& item : node.components)
    simple = simple && ast::get_if<ast::Expr>(item) != nullptr && !ast::get_if<ast::Call>(item);
  if (simple) {
    for (auto const& item : node.components)
      add(numeric(*ast::get_if<ast::Expr>(item)), ast::span_of(item));
  } else {
    auto& reader = in_.reader;
    reader.enter_region(node.components, node.span);
    while (!reader.at_end()) {
      Span const span = reader.next_span();
      if (reader.next() == Next::Numeric) {
        add(to_numeric(reader.read_value(), span), span);
      } else {
        reader.unexpected("a component of a vector");
        bad = true;
      }
    }
    reader.leave_region();
  }
  if (!bad && n.size < 2) {
    in_.error("E0323", "a vector has at least two components", node.span);
    bad = true;
  }
  return bad ? poison() : n;
}

Numeric with_sign(ast::UnaryOp op, Numeric n) {
  for (std::size_t i = 0; i < n.size; ++i) {
    if (op == ast::UnaryOp::Minus) n.c[i] = -n.c[i];
    if (op == ast::UnaryOp::Not) n.c[i] = std::abs(n.c[i]) > 1e-10 ? 0 : 1;
  }
  return n;
}

Numeric Expressions::operator()(ast::Unary const& node) {
  if (!Pasted::calls_macro(node, in_)) return with_sign(node.op, numeric(node.operand));
  Pasted pasted(in_);
  pasted.add(node);
  return to_numeric(pasted.value(), node.span);
}

Numeric Expressions::operator()(ast::Binary const& node) {
  if (!Pasted::calls_macro(node, in_)) return plain(node);
  Pasted pasted(in_);
  pasted.add(node);
  return to_numeric(pasted.value(), node.span);
}

/// Of operators and operands of which no macro writes any.
Numeric Expressions::plain(ast::Binary const& node) {
  if (node.op >= ast::BinaryOp::Less && is_string(node.left)) {
    std::string const left = string(node.left, "a text to be compared");
    return comparison(node.op, left, value(node.right), ast::span_of(node.right));
  }
  Numeric const left = operand(node.left);
  Numeric const right = operand(node.right);
  return binary(node.op, left, right, node.span);
}

Numeric Expressions::operand(ast::Expr const& expr) {
  auto const* const inner = ast::get_if<ast::Binary>(expr);
  return inner != nullptr ? plain(*inner) : numeric(expr);
}

Numeric Expressions::comparison(ast::BinaryOp op, std::string const& left, Value const& right,
                                Span span) {
  auto const order =
      static_cast<double>(left.compare(text_of(right, "a text to be compared", span)));
  return binary(op, scalar_of(order), scalar_of(0), span);
}

Numeric Expressions::operator()(ast::Conditional const& node) {
  std::optional<bool> const chosen = condition(node.condition);
  Numeric const yes = numeric(node.yes);
  Numeric const no = numeric(node.no);
  if (!chosen || yes.poisoned() || no.poisoned()) return poison();
  return *chosen ? yes : no;
}

Numeric Expressions::operator()(ast::Member const& node) {
  Numeric const n = numeric(node.operand);
  if (n.poisoned()) return n;
  std::string_view const member = node.member.text;
  auto const part = part_of(member);
  if (!part) {
    in_.error("E0324", fmt::format("there is no member '.{}'", member), node.member.span);
    return poison();
  }
  if (*part < n.size) return scalar_of(take_part(n, *part));
  // POV-Ray's operands grow to what their context wants; a float has all components alike.
  if (n.size == 1) return n;
  in_.error("E0324", fmt::format("a value of {} components has no '.{}'", n.size, member),
            node.member.span);
  return poison();
}

Numeric Expressions::operator()(ast::Index const& node) {
  Value const* const found = set_element(node);
  return found ? to_numeric(*found, node.span) : poison();
}

Numeric Expressions::operator()(ast::Paren const& node) {
  bool const outside = in_.reader.set_in_parentheses(true);
  ast::Expr const* const only = sole(node.items);
  Numeric const n = only != nullptr
                        ? numeric(*only)
                        : to_numeric(in_.reader.value_of(node.items, node.span), node.span);
  in_.reader.set_in_parentheses(outside);
  return n;
}

Numeric Expressions::operator()(ast::Array const& node) {
  in_.error("E0301", "expected a number, found an array", node.span);
  return poison();
}

Numeric Expressions::operator()(ast::Function const& node) {
  in_.error("E0301", "expected a number, found a function", node.span);
  return poison();
}

Numeric Expressions::operator()(ast::Block const& node) {
  in_.error("E0301", fmt::format("expected a number, found '{} {{'", node.head.text), node.span);
  return poison();
}

} // namespace abbe::lang
