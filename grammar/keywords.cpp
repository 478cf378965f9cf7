// SPDX-License-Identifier: MIT
#include "grammar/keywords.hpp"

#include "grammar/keywords.def"

#include "base/diagnostic.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace abbe::grammar {
namespace {

/// Open addressing: every word of a text is looked up.
class Table {
public:
  Table() : slots_(size) {
#define X(word) add(#word, WordKind::Operand);
    ABBE_OPERANDS
#undef X
#define X(word) add(#word, WordKind::Function);
    ABBE_FUNCTIONS
#undef X
#define X(word) add(#word, WordKind::Word);
    ABBE_WORDS
#undef X
#define X(word) add(#word, WordKind::Directive);
    ABBE_DIRECTIVES
#undef X
  }

  WordKind find(std::string_view word) const {
    Slot const& slot = slots_[place(word)];
    return slot.word.empty() ? WordKind::Name : slot.kind;
  }

private:
  static constexpr std::size_t size = 2048; ///< more than twice as many as words
  struct Slot {
    std::string_view word;
    WordKind kind = WordKind::Name;
  };

  /// Where the word is or would be.
  std::size_t place(std::string_view word) const {
    std::uint32_t hash = 2166136261u; // FNV-1a
    for (char const c : word) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
    std::size_t at = (hash ^ hash >> 15) % size;
    while (!slots_[at].word.empty() && slots_[at].word != word) at = (at + 1) % size;
    return at;
  }
  /// The first of several meanings counts.
  void add(std::string_view word, WordKind kind) {
    Slot& slot = slots_[place(word)];
    if (slot.word.empty()) slot = {word, kind};
  }

  std::vector<Slot> slots_;
};

} // namespace

WordKind word_kind(std::string_view word) {
  static Table const table;
  return table.find(word);
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

bool opens_body(std::string_view directive) {
  return directive == "if" || directive == "ifdef" || directive == "ifndef" || directive == "while"
         || directive == "for" || directive == "switch" || directive == "macro";
}

bool divides_body(std::string_view directive) {
  return directive == "else" || directive == "elseif" || directive == "case"
         || directive == "range";
}

bool is_no_directive(std::string_view word) {
  auto const words = directive_words();
  if (std::find(words.begin(), words.end(), word) != words.end()) return false;
  return word_kind(word) != WordKind::Name || did_you_mean(word, words).empty();
}

} // namespace abbe::grammar
