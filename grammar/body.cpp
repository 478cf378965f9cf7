// SPDX-License-Identifier: MIT
#include "grammar/body.hpp"

namespace abbe::grammar {
bool ends_body(Iterator at, Iterator last) {
  std::string_view const word = directive_at(skip_blanks(at, last), last);
  return word == "end" || divides_body(word);
}

Iterator find_end_of_body(Iterator at, Iterator last) {
  int inner = 0;
  for (;;) {
    Token const token = next_token(at, last);
    if (token.kind == TokenKind::End) return nullptr;
    at = token.end;
    if (token.kind != TokenKind::Directive) continue;
    std::string_view const word = directive_at(token.begin, last);
    if (inner == 0 && (word == "end" || divides_body(word))) return token.begin;
    if (opens_body(word)) ++inner;
    if (word == "end") --inner;
  }
}

Iterator find_end_of_question(Iterator at, Iterator end) {
  int open = 0;
  do {
    Token const token = next_token(at, end);
    if (token.kind == TokenKind::End) return end;
    at = token.end;
    open += (token.text() == "(") - (token.text() == ")");
  } while (open > 0);
  return open == 0 && *(at - 1) == ')' ? at : end;
}

bool may_be_text(SyntaxError const& error) {
  return error.code != "E0102" && error.code != "E0103" && !error.code.starts_with("E07");
}

} // namespace abbe::grammar
