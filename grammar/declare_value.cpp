// SPDX-License-Identifier: MIT
#include "grammar/declare_value.hpp"

#include "base/diagnostic.hpp"

#include <fmt/format.h>

namespace abbe::grammar {

bool at_texture(Iterator at, Iterator last) {
  std::string_view const word = scan_word(at, last);
  if (word != "texture") return false;
  at = skip_blanks(at + word.size(), last);
  return at != last && *at == '{';
}

bool UnknownDirective::scan(Iterator& at, Iterator last, State&, ast::Word&) const {
  if (*at != '#') return false;
  std::string_view const word = directive_at(at, last);
  for (auto const* const ends : {"else", "elseif", "end", "case", "range"})
    if (word == ends) return false;
  if (word.empty()) throw_expected("a directive after '#'", skip_blanks(at + 1, last), last);
  throw SyntaxError{
      "E0113", at, word.data() + word.size(),
      fmt::format("unknown directive '#{}'{}", word, did_you_mean(word, directive_words()))};
}

} // namespace abbe::grammar
