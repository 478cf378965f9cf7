// SPDX-License-Identifier: MIT
#include "grammar/operators.hpp"

#include <fmt/format.h>

namespace abbe::grammar {

void throw_expected(std::string const& what, Iterator at, Iterator last) {
  Token const found = next_token(at, last);
  if (found.kind == TokenKind::Unknown)
    skip_blanks(at, last); // an open comment has its own message
  throw SyntaxError{"E0110", found.begin, found.end,
                    fmt::format("expected {}, found {}", what, describe(found))};
}

void throw_unclosed(char const* closer, char const* what, Iterator opener, Iterator opener_end,
                    Iterator at, Iterator last) {
  Token const found = next_token(at, last);
  if (found.kind == TokenKind::Unknown && found.text().size() == 1)
    throw SyntaxError{"E0101", found.begin, found.end, describe(found) + " has no meaning here"};
  if (found.kind == TokenKind::Unknown)
    skip_blanks(at, last); // an open comment has its own message
  throw SyntaxError{
      "E0111",
      found.begin,
      found.end,
      fmt::format("expected '{}' to close the {}, found {}", closer, what, describe(found)),
      opener,
      opener_end,
      fmt::format("the {} is opened here", what)};
}

void throw_too_deep(Iterator at) {
  throw SyntaxError{"E0701", at, at + 1,
                    fmt::format("nested too deeply (the limit is {} levels)", max_nesting)};
}

void throw_too_high(Iterator begin, Iterator end) {
  throw SyntaxError{"E0702", begin, std::min(end, begin + 40),
                    fmt::format("this expression has more than {} operators in a row", max_height)};
}

namespace {

/// See ast::Unary::calls.
bool calls(ast::Expr const& expr) {
  if (auto const* const binary = ast::get_if<ast::Binary>(expr)) return binary->calls;
  if (auto const* const unary = ast::get_if<ast::Unary>(expr)) return unary->calls;
  auto const* const call = ast::get_if<ast::Call>(expr);
  return call != nullptr && !call->callee.reserved;
}

} // namespace

ast::Expr make_binary(State const& state, ast::BinaryOp op, ast::Expr left, ast::Expr right) {
  Span const whole{state.source, ast::span_of(left).begin, ast::span_of(right).end};
  bool const with_calls = calls(left) || calls(right);
  return ast::Expr(ast::Binary{whole, op, with_calls, std::move(left), std::move(right)});
}

ast::Expr make_unary(Span span, ast::UnaryOp op, ast::Expr operand) {
  if (op != ast::UnaryOp::Not) {
    if (auto const* number = ast::get_if<ast::Number>(operand)) {
      double const value = op == ast::UnaryOp::Minus ? -number->value : number->value;
      return ast::Expr(ast::Number{span, value});
    }
  }
  bool const with_calls = calls(operand);
  return ast::Expr(ast::Unary{span, op, with_calls, std::move(operand)});
}

} // namespace abbe::grammar
