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

} // namespace abbe::grammar
