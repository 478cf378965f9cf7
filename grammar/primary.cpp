// SPDX-License-Identifier: MIT
#include "grammar/primary.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace abbe::grammar {
namespace {

constexpr std::array<std::string_view, 13> components = {
    "x", "y", "z", "u", "v", "t", "red", "green", "blue", "filter", "transmit", "gray", "grey"};

} // namespace

bool scan_member(Iterator& first, Iterator last, State& state, ast::Name& member) {
  Iterator at = skip_blanks(first, last);
  if (at == last || *at != '.' || (last - at > 1 && is_digit(at[1]))) return false;
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
  member.text.assign(word);
  member.reserved = true;
  first = at + word.size();
  member.span = state.span(at, first);
  return true;
}

} // namespace abbe::grammar
