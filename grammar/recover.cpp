// SPDX-License-Identifier: MIT
#include "grammar/recover.hpp"

#include <algorithm>

namespace abbe::grammar {
namespace {

/// Column of `at` counted in blanks from the line's start, or -1 when something else stands before
/// it.
std::ptrdiff_t indentation(Iterator at, Iterator begin) {
  Iterator start = at;
  while (start != begin && (start[-1] == ' ' || start[-1] == '\t')) --start;
  return start == begin || start[-1] == '\n' || start[-1] == '\r' ? at - start : -1;
}

/// Past the closing one of the parentheses that open at `at`.
Iterator skip_parentheses(Iterator at, Iterator last) {
  int depth = 0;
  for (;;) {
    Token const token = next_token(at, last);
    if (token.kind == TokenKind::End) return last;
    at = token.end;
    if (token.text() == "(") ++depth;
    if (token.text() == ")" && --depth <= 0) return at;
  }
}

} // namespace

bool Pending::take(Iterator& at, Iterator last) {
  if (*at == '}' && braces > 0) {
    --braces;
    ++at;
    return true;
  }
  std::string_view const word = directive_at(at, last);
  if (ends == 0 || (word != "end" && !divides_body(word))) return false;
  at = word.data() + word.size();
  if (word == "end") {
    --ends;
  } else if (word != "else") {
    Token const next = next_token(at, last);
    if (next.text() == "(") at = skip_parentheses(next.begin, last);
  }
  return true;
}

Iterator resume(Iterator at, Iterator last, State const& state, Pending& pending) {
  int braces = state.braces;
  int ends = state.directives;
  bool skip = state.brackets + state.directives == 0; // then the token itself is what is wrong
  for (;; skip = false) {
    Token const token = next_token(at, last);
    if (token.kind == TokenKind::End) return last;
    bool const word = token.kind == TokenKind::Directive || token.kind == TokenKind::Word
                      || token.kind == TokenKind::Name;
    std::string_view const name =
        token.kind == TokenKind::Directive ? directive_at(token.begin, last) : std::string_view{};
    bool const closer = name == "end" || divides_body(name);
    std::ptrdiff_t const column = word && !skip ? indentation(token.begin, state.begin) : -1;
    if (column == 0 || (column > 0 && braces <= 0) || (closer && ends > 0 && braces <= 0)) {
      pending.braces += std::max(0, braces);
      pending.ends += ends;
      return token.begin;
    }
    at = token.end;
    if (token.text() == "{") ++braces;
    if (token.text() == "}") --braces;
    if (opens_body(name)) ++ends;
    if (name == "end") ends = std::max(0, ends - 1);
  }
}

} // namespace abbe::grammar
