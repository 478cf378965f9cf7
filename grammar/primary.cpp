// SPDX-License-Identifier: MIT
#include "grammar/primary.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace abbe::grammar {
namespace {

constexpr std::array<std::string_view, 13> components = {
    "x", "y", "z", "u", "v", "t", "red", "green", "blue", "filter", "transmit", "gray", "grey"};

} // namespace

void take_member(Iterator& first, Iterator last, State& state, ast::Expr& operand) {
  Iterator at = skip_blanks(first, last);
  if (last - at > 1 && is_digit(at[1])) return;
  Iterator const dot = at;
  at = skip_blanks(at + 1, last);
  std::string_view const word = scan_word(at, last);
  if (std::find(components.begin(), components.end(), word) == components.end()) {
    Token const found = next_token(at, last);
    throw SyntaxError{
        "E0115", word.empty() ? dot : found.begin, found.end,
        fmt::format("expected a component (x y z t u v red green blue filter transmit "
                    "gray) after '.', found {}",
                    describe(found))};
  }
  first = at + word.size();
  Span const whole{state.source, ast::span_of(operand).begin, state.span(at, first).end};
  ast::Name member{state.span(at, first), std::string(word), true};
  operand = ast::Member{whole, std::move(operand), std::move(member)};
}

} // namespace abbe::grammar
