// SPDX-License-Identifier: MIT
#include "grammar/lexer.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>

namespace abbe::grammar {
namespace {

constexpr double powers_of_ten[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                    1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                    1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

double read_number(Iterator begin, Iterator end) {
  double value = 0;
  auto const result = std::from_chars(begin, end, value);
  if (result.ec == std::errc::result_out_of_range) {
    // from_chars does not tell overflow from underflow, which is fine (0 or a subnormal).
    value = std::strtod(std::string(begin, end).c_str(), nullptr);
    if (std::isinf(value))
      throw SyntaxError{"E0106", begin, end, "this number is too large (the limit is 1.8e308)"};
  }
  return value;
}

int hex_digit(char c) {
  if (is_digit(c)) return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

void append_utf8(std::string& out, unsigned code) {
  if (code < 0x80) {
    out += static_cast<char>(code);
  } else if (code < 0x800) {
    out += static_cast<char>(0xc0 | (code >> 6));
    out += static_cast<char>(0x80 | (code & 0x3f));
  } else {
    out += static_cast<char>(0xe0 | (code >> 12));
    out += static_cast<char>(0x80 | ((code >> 6) & 0x3f));
    out += static_cast<char>(0x80 | (code & 0x3f));
  }
}

/// Reads the escape whose backslash is before `at`; false when it is none we know.
bool read_escape(Iterator& at, Iterator last, std::string& out) {
  static constexpr char names[] = "abfnrtv0\\'\"";
  static constexpr char values[] = "\a\b\f\n\r\t\v\0\\'\"";
  if (*at == 'u') {
    unsigned code = 0;
    for (int i = 1; i <= 4; ++i) {
      int const digit = last - at > i ? hex_digit(at[i]) : -1;
      if (digit < 0) return false;
      code = code * 16 + static_cast<unsigned>(digit);
    }
    append_utf8(out, code);
    at += 5;
    return true;
  }
  auto const* found = static_cast<char const*>(std::memchr(names, *at, sizeof names - 1));
  if (found == nullptr) return false;
  out += values[found - names];
  ++at;
  return true;
}

} // namespace

Iterator skip_comment(Iterator first, Iterator last) {
  if (first[1] == '/') {
    return std::find_if(first, last, is_line_end);
  }
  int depth = 1;
  for (Iterator at = first + 2; last - at >= 2;) {
    if (at[0] == '*' && at[1] == '/') {
      at += 2;
      if (--depth == 0) return at;
    } else if (at[0] == '/' && at[1] == '*') {
      at += 2;
      ++depth;
    } else {
      ++at;
    }
  }
  throw SyntaxError{"E0102", first, first + 2,
                    depth == 1 ? "this comment is not closed by '*/'"
                               : fmt::format("this comment is not closed: {} more '*/' are missing "
                                             "(comments nest)",
                                             depth)};
}

bool scan_number(Iterator& first, Iterator last, double& value) {
  Iterator at = first;
  std::uint64_t digits = 0;
  while (at != last && is_digit(*at)) digits = digits * 10 + static_cast<unsigned>(*at++ - '0');
  std::ptrdiff_t count = at - first;
  std::ptrdiff_t decimals = 0;
  if (at != last && *at == '.') {
    Iterator const dot = at++;
    while (at != last && is_digit(*at)) digits = digits * 10 + static_cast<unsigned>(*at++ - '0');
    decimals = at - dot - 1;
    if (count == 0 && decimals == 0) return false;
    if (at != last && *at == '.' && decimals == 0)
      throw SyntaxError{"E0105", first, at + 1, "a number has one decimal point at most"};
    count += decimals;
  } else if (count == 0) {
    return false;
  }
  bool exponent = false;
  if (at != last && (*at == 'e' || *at == 'E')) {
    Iterator power = at + 1;
    if (power != last && (*power == '+' || *power == '-')) ++power;
    if (power != last && is_digit(*power)) {
      exponent = true;
      while (power != last && is_digit(*power)) ++power;
      at = power;
    }
  }
  // Up to 15 digits and a power of ten up to 10^22 are exact doubles: one rounded division (Clinger
  // 1990).
  if (count <= 15 && !exponent)
    value = decimals == 0 ? static_cast<double>(digits)
                          : static_cast<double>(digits) / powers_of_ten[decimals];
  else
    value = read_number(first, at);
  first = at;
  return true;
}

bool scan_string(Iterator& first, Iterator last, ScannedString& out) {
  if (first == last || *first != '"') return false;
  Iterator at = first + 1;
  while (at != last && *at != '"') {
    if (*at == '\0')
      throw SyntaxError{"E0101", at, at + 1, "the byte 0x00 does not belong in a string"};
    if (*at != '\\' || last - at < 2) {
      out.text += *at;
      out.raw += *at++;
      continue;
    }
    Iterator const backslash = at++;
    if (!read_escape(at, last, out.text)) {
      if (out.bad_escape == nullptr) out.bad_escape = backslash;
      out.text += *at++;
    }
    if (backslash[1] == '"')
      out.raw += '"';
    else
      out.raw.append(backslash, at);
  }
  if (at == last)
    throw SyntaxError{"E0103", first, std::find_if(first, last, is_line_end),
                      "this string is not closed"};
  first = at + 1;
  return true;
}

std::string_view directive_at(Iterator first, Iterator last) {
  if (first == last || *first != '#') return {};
  return scan_word(skip_blanks(first + 1, last), last);
}

namespace {

TokenKind token_kind(std::string_view word) {
  switch (word_kind(word)) {
  case WordKind::Name:
    return TokenKind::Name;
  case WordKind::Operand:
    return TokenKind::Operand;
  case WordKind::Function:
    return TokenKind::Function;
  case WordKind::Word:
  case WordKind::Directive:
    return TokenKind::Word;
  }
  return TokenKind::Unknown;
}

Token scan_token(Iterator at, Iterator last) {
  Token token{TokenKind::Unknown, at, at + 1};
  ScannedString string;
  double number = 0;
  Iterator end = at;
  if (auto const word = scan_word(at, last); !word.empty()) {
    token.kind = token_kind(word);
    token.end = at + word.size();
  } else if (auto const name = directive_at(at, last); !name.empty()) {
    token.kind = TokenKind::Directive;
    token.end = name.data() + name.size();
  } else if (scan_string(end, last, string)) {
    token.kind = TokenKind::String;
    token.end = end;
  } else if (scan_number(end, last, number)) {
    token.kind = TokenKind::Number;
    token.end = end;
  } else if (*at == '\0') {
    token.end = std::find_if(at, last, [](char c) { return c != '\0'; });
  } else if (std::strchr("{}()[]<>=!+-*/,;:?&|.#", *at) != nullptr) {
    bool const wide = last - at > 1 && at[1] == '=' && std::strchr("<>!", *at) != nullptr;
    token.kind = TokenKind::Punctuation;
    token.end = at + (wide ? 2 : 1);
  }
  return token;
}

} // namespace

Token next_token(Iterator first, Iterator last) {
  Iterator at = first;
  try {
    at = skip_blanks(first, last);
    if (at == last) return {TokenKind::End, last, last};
    return scan_token(at, last);
  } catch (SyntaxError const& error) {
    bool const comment = error.code == "E0102";
    return {TokenKind::Unknown, error.begin, comment ? last : error.end};
  }
}

std::string describe(Token const& token) {
  if (token.kind == TokenKind::End) return "the end of the file";
  std::string_view text = token.text();
  constexpr std::size_t longest = 40;
  std::string const dots = text.size() > longest ? "..." : "";
  text = text.substr(0, longest);
  if (token.kind == TokenKind::String) return fmt::format("the string {}{}", text, dots);
  if (token.kind == TokenKind::Unknown) {
    if (text[0] == '\0' || (text.size() == 1 && (text[0] <= 32 || text[0] >= 127)))
      return fmt::format("the byte 0x{:02x}", static_cast<unsigned char>(text[0]));
    if (text.size() == 1) return fmt::format("'{}'", text);
    return fmt::format("'{}{}', which cannot be read", text, dots);
  }
  if (token.kind == TokenKind::Directive) {
    Iterator const name = skip_blanks(token.begin + 1, token.end);
    return fmt::format("'#{}'", std::string_view(name, static_cast<std::size_t>(token.end - name)));
  }
  return fmt::format("'{}{}'", text, dots);
}

} // namespace abbe::grammar
