// SPDX-License-Identifier: MIT
#include "grammar/terminals.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace abbe::grammar {
namespace {

/// Words that cannot be meant without their '#'.
constexpr std::array<std::string_view, 14> hash_words = {
    "case",  "declare", "else",    "elseif", "end",   "for",    "if",
    "ifdef", "ifndef",  "include", "local",  "macro", "switch", "while"};

constexpr std::array<std::string_view, 17> colour_words = {
    "alpha", "blue", "color", "colour", "filter", "gray",  "green",  "grey",    "red",
    "rgb",   "rgbf", "rgbft", "rgbt",   "srgb",   "srgbf", "srgbft", "transmit"};

/// Words after which a string is a file name.
constexpr std::array<std::string_view, 15> path_words = {"bmp", "df3",  "exr", "gif",  "hdr",
                                                         "iff", "jpeg", "pgm", "png",  "pot",
                                                         "ppm", "sys",  "tga", "tiff", "ttf"};

bool one_of(std::string_view word, auto const& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool follows(char mark, Iterator at, Iterator last) {
  at = skip_blanks(at, last);
  return at != last && *at == mark;
}

} // namespace

bool LiteralVector::scan_components(Iterator& at, Iterator last, State& state,
                                    ast::LiteralVector& out) {
  Iterator const begin = at++;
  out.size = 0;
  for (;;) {
    at = skip_blanks(at, last);
    if (at == last) return false;
    bool const negative = *at == '-';
    if (negative || *at == '+') at = skip_blanks(at + 1, last);
    double value = 0;
    if (at == last || out.size == 5 || !scan_number(at, last, value)) return false;
    out.values[out.size++] = negative ? -value : value;
    at = skip_blanks(at, last);
    if (at == last) return false;
    if (*at == '>') break;
    if (*at == ',')
      ++at;
    else if (!is_digit(*at) && *at != '.') // no comma: a sign would be an operator
      return false;
  }
  ++at;
  out.span = state.span(begin, at);
  return out.size >= 2;
}

bool StringLiteral::scan_checked(Iterator& at, Iterator last, State& state, ast::String& out,
                                 bool path) {
  Iterator const begin = at;
  ScannedString scanned;
  if (!scan_string(at, last, scanned)) return false;
  if (scanned.bad_escape != nullptr && !path)
    throw SyntaxError{"E0104", scanned.bad_escape, scanned.bad_escape + 2,
                      fmt::format("unknown escape '{}' in a string; write \\\\ for a backslash",
                                  std::string_view(scanned.bad_escape, 2))};
  out.text = std::move(scanned.text);
  out.raw = std::move(scanned.raw);
  out.span = state.span(begin, at);
  return true;
}

bool NameOf::scan(Iterator& at, Iterator last, State& state, ast::Name& out) const {
  std::string_view const word = scan_word(at, last);
  if (word.empty()) return false;
  WordKind const kind = word_kind(word);
  if ((kinds_ & bit(kind)) == 0) return false;
  Iterator const end = at + word.size();
  if (brace_ == Brace::Follows && !follows('{', end, last)) return false;
  if (kind == WordKind::Function && brace_ == Brace::Any && !follows('(', end, last)) return false;
  out.text.assign(word);
  out.reserved = kind != WordKind::Name;
  out.span = state.span(at, end);
  at = end;
  return true;
}

bool NewName::scan(Iterator& at, Iterator last, State& state, ast::Name& out) const {
  std::string_view const word = scan_word(at, last);
  if (word.empty()) return false;
  if (word_kind(word) != WordKind::Name)
    throw SyntaxError{
        "E0114", at, at + word.size(),
        fmt::format("'{}' is a reserved word and cannot be used as {}", word, label_)};
  out.text.assign(word);
  out.span = state.span(at, at + word.size());
  at += word.size();
  return true;
}

bool WordLiteral::scan(Iterator& at, Iterator last, State& state, ast::Word& out) const {
  std::string_view const word = scan_word(at, last);
  if (word.empty()) return false;
  if (colour_only_ && !one_of(word, colour_words)) return false;
  WordKind const kind = word_kind(word);
  if (kind == WordKind::Name || kind == WordKind::Operand) return false;
  Iterator const end = at + word.size();
  if (kind == WordKind::Function && follows('(', end, last)) return false;
  if (kind == WordKind::Directive && one_of(word, hash_words))
    throw SyntaxError{"E0116", at, end,
                      fmt::format("'{0}' needs a '#' in front here: '#{0}'", word)};
  if (one_of(word, path_words)) state.path_word_end = end;
  out.text.assign(word);
  out.span = state.span(at, end);
  at = end;
  return true;
}

} // namespace abbe::grammar
