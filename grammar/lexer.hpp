// SPDX-License-Identifier: MIT
#pragma once

#include "grammar/keywords.hpp"

#include <cstdint>
#include <string>
#include <string_view>

/// Characters to tokens: plain functions on pointers, no Spirit. The X3 terminals (terminals.hpp),
/// the token dump and error recovery all read through these, so that there is one idea of what a
/// token is.
namespace abbe::grammar {

using Iterator = char const*;

/// Why parsing stopped, by pointers into the text; parse() makes a Diagnostic of it.
struct SyntaxError {
  std::string code; ///< "E0110"
  Iterator begin = nullptr;
  Iterator end = nullptr;
  std::string message;
  Iterator note_begin = nullptr; ///< null when there is no note
  Iterator note_end = nullptr;
  std::string note = {};
};

inline bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
inline bool is_name_start(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
inline bool is_name_char(char c) {
  return is_name_start(c) || is_digit(c);
}
/// Blank, line breaks, TAB and Ctrl-Z. Not NUL: a file that holds one is damaged.
inline bool is_blank(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r') || c == '\x1a';
}
/// LF, CR LF and CR end a line.
inline bool is_line_end(char c) {
  return c == '\n' || c == '\r';
}

/// Past a comment (`first` stands on its '/'). Block comments nest. @throws SyntaxError E0102
/// unclosed
Iterator skip_comment(Iterator first, Iterator last);

/// Past blanks and comments.
inline Iterator skip_blanks(Iterator first, Iterator last) {
  while (first != last) {
    if (is_blank(*first))
      ++first;
    else if (*first == '/' && last - first > 1 && (first[1] == '/' || first[1] == '*'))
      first = skip_comment(first, last);
    else
      break;
  }
  return first;
}

/// The word that starts at `first`, empty when none does.
inline std::string_view scan_word(Iterator first, Iterator last) {
  if (first == last || !is_name_start(*first)) return {};
  Iterator end = first + 1;
  while (end != last && is_name_char(*end)) ++end;
  return {first, static_cast<std::size_t>(end - first)};
}

/// An unsigned number at `first`; moves past it. The nearest double (ties to even), as the standard
/// asks of from_chars. @throws SyntaxError E0105 two dots, E0106 above the range of double
bool scan_number(Iterator& first, Iterator last, double& value);

/// A string literal at `first`, which stands on the quote; moves past it.
/// `text` has escapes resolved (\uXXXX becomes UTF-8), `raw` is what stands between the quotes with
/// \" made ". An unknown escape is no error in `raw`, and in a path backslashes are common: so it
/// is noted in `bad_escape` and the parser decides.
/// Line breaks may stand inside, as in POV-Ray. @throws SyntaxError E0103 unclosed, E0101 a NUL
struct ScannedString {
  std::string text;
  std::string raw;
  Iterator bad_escape = nullptr;
};
bool scan_string(Iterator& first, Iterator last, ScannedString& out);

/// One token as the dump and the messages see it.
enum class TokenKind : std::uint8_t {
  End,
  Number,
  String,
  Name,
  Operand,
  Function,
  Word,
  Directive,
  Punctuation,
  Unknown
};
struct Token {
  TokenKind kind = TokenKind::End;
  Iterator begin = nullptr;
  Iterator end = nullptr;
  std::string_view text() const { return {begin, static_cast<std::size_t>(end - begin)}; }
};
/// The token at or after `first`; never throws: what cannot be read is Unknown, to its end or one
/// byte. A Directive is '#' with its word.
Token next_token(Iterator first, Iterator last);

/// "'sphere'", "the string \"abc\"", "the end of the file", for messages.
std::string describe(Token const& token);

/// The word after '#', empty when `first` is not on a directive.
std::string_view directive_at(Iterator first, Iterator last);

} // namespace abbe::grammar
