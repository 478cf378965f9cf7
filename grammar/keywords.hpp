// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace abbe::grammar {

/// What a word is to the grammar. See keywords.def.
enum class WordKind : std::uint8_t { Name, Operand, Function, Word, Directive };

/// Name for everything that is not reserved.
WordKind word_kind(std::string_view word);

/// The words that may follow '#', for "did you mean".
std::span<std::string_view const> directive_words();
/// Does a body follow that `#end` ends (`#if`, `#macro` ...)?
bool opens_body(std::string_view directive);
/// Does the directive part a body from the next (`#else`, `#case` ...)?
bool divides_body(std::string_view directive);
/// Is the word, which follows '#' and may be empty, neither a directive nor like one misspelt?
bool is_no_directive(std::string_view word);

} // namespace abbe::grammar
