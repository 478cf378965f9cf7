// SPDX-License-Identifier: MIT
#include "grammar/keywords.hpp"

#include "grammar/keywords.def"

#include <array>
#include <string>
#include <unordered_map>

namespace abbe::grammar {
namespace {

using Table = std::unordered_map<std::string_view, WordKind>;

Table make_table() {
  Table table;
#define X(word) table.emplace(#word, WordKind::Operand);
  ABBE_OPERANDS
#undef X
#define X(word) table.emplace(#word, WordKind::Function);
  ABBE_FUNCTIONS
#undef X
#define X(word) table.emplace(#word, WordKind::Word);
  ABBE_WORDS
#undef X
#define X(word) table.emplace(#word, WordKind::Directive);
  ABBE_DIRECTIVES
#undef X
  return table;
}

} // namespace

WordKind word_kind(std::string_view word) {
  static Table const table = make_table();
  auto const found = table.find(word);
  return found == table.end() ? WordKind::Name : found->second;
}

std::span<std::string_view const> directive_words() {
  static constexpr std::array words = {
#define X(word) std::string_view(#word),
      ABBE_DIRECTIVES
#undef X
          std::string_view("version"),
      std::string_view("error"),
      std::string_view("statistics"),
      std::string_view("read"),
      std::string_view("write"),
      std::string_view("range")};
  return words;
}

} // namespace abbe::grammar
