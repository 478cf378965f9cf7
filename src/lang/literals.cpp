// SPDX-License-Identifier: MIT
// The literals of data files: what #read understands and #write puts.
#include "grammar/lexer.hpp"
#include "lang/files.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>

namespace abbe::lang {
namespace {

/// Blanks, comments, commas and, as in POV-Ray, NULs.
void skip_gaps(FileValue& file) {
  char const* const last = file.text.data() + file.text.size();
  char const* at = file.text.data() + file.position;
  try {
    while ((at = grammar::skip_blanks(at, last)) != last && (*at == ',' || *at == '\0')) ++at;
  } catch (grammar::SyntaxError const&) { // a comment that is not closed: no literal is left
    at = last;
  }
  file.position = static_cast<std::size_t>(at - file.text.data());
}

Error wrong(FileValue const& file) {
  SourceFile const source(file.path.generic_string(), std::string(file.text));
  int const line = source.place(static_cast<std::uint32_t>(file.position)).line;
  return {"E0506", fmt::format("line {} of '{}': expected a float, a vector or a string", line,
                               source.name())};
}

std::optional<double> read_float(FileValue& file) {
  skip_gaps(file);
  double sign = 1;
  while (file.position < file.text.size()
         && (file.text[file.position] == '-' || file.text[file.position] == '+')) {
    if (file.text[file.position++] == '-') sign = -sign;
    skip_gaps(file);
  }
  double value = 0;
  char const* const begin = file.text.data() + file.position;
  auto const read = std::from_chars(begin, file.text.data() + file.text.size(), value);
  if (read.ec != std::errc{} || read.ptr == begin) return std::nullopt;
  file.position += static_cast<std::size_t>(read.ptr - begin);
  return sign * value;
}

Result<Value> read_vector(FileValue& file) {
  Numeric n;
  n.size = 0;
  ++file.position;
  for (;;) {
    skip_gaps(file);
    if (file.position < file.text.size() && file.text[file.position] == '>') break;
    auto const component = read_float(file);
    if (!component || n.size == 5) return wrong(file);
    n.c[n.size++] = *component;
  }
  ++file.position;
  if (n.size < 2) return wrong(file);
  n.colour = n.size == 5;
  Value value;
  value.any = n;
  return value;
}

Result<Value> read_text(FileValue& file) {
  std::string text;
  for (++file.position; file.position < file.text.size(); ++file.position) {
    char c = file.text[file.position];
    if (c == '"') {
      ++file.position;
      Value value;
      value.any = std::move(text);
      return value;
    }
    if (c == '\\' && file.position + 1 < file.text.size()) {
      constexpr std::string_view codes = "abfnrtv0\\'\"";
      constexpr std::string_view means("\a\b\f\n\r\t\v\0\\'\"", 11);
      auto const code = codes.find(file.text[++file.position]);
      if (code == std::string_view::npos) return wrong(file);
      c = means[code];
    }
    text += c;
  }
  return wrong(file);
}

struct Range {
  double low;
  double high;
  int bytes;
  bool big_endian;
};

Range range_of(BinaryForm form) {
  switch (form) {
  case BinaryForm::None:
  case BinaryForm::Uint8:
    return {0, 255, 1, false};
  case BinaryForm::Sint8:
    return {-128, 127, 1, false};
  case BinaryForm::Uint16le:
    return {0, 65535, 2, false};
  case BinaryForm::Uint16be:
    return {0, 65535, 2, true};
  case BinaryForm::Sint16le:
    return {-32768, 32767, 2, false};
  case BinaryForm::Sint16be:
    return {-32768, 32767, 2, true};
  case BinaryForm::Sint32le:
    return {-2147483648.0, 2147483647.0, 4, false};
  case BinaryForm::Sint32be:
    return {-2147483648.0, 2147483647.0, 4, true};
  }
  return {};
}

} // namespace

bool at_end_of_literals(FileValue& file) {
  skip_gaps(file);
  return file.position >= file.text.size();
}

Result<Value> read_literal(FileValue& file) {
  if (at_end_of_literals(file)) return Value{};
  char const first = file.text[file.position];
  if (first == '<') return read_vector(file);
  if (first == '"') return read_text(file);
  auto const number = read_float(file);
  if (!number) return wrong(file);
  Value value;
  Numeric n;
  n.c[0] = *number;
  value.any = n;
  return value;
}

std::optional<BinaryForm> binary_form(std::string_view word) {
  constexpr std::string_view words[] = {"",         "uint8",    "sint8",    "uint16le", "uint16be",
                                        "sint16le", "sint16be", "sint32le", "sint32be"};
  auto const found = std::find(std::begin(words) + 1, std::end(words), word);
  if (found == std::end(words)) return std::nullopt;
  return static_cast<BinaryForm>(found - std::begin(words));
}

std::string write_text(Numeric const& n) {
  if (n.size == 1) return fmt::format("{:g}", n.c[0]);
  std::string text = "<";
  for (std::size_t i = 0; i < n.size; ++i) text += fmt::format("{}{:g}", i ? "," : "", n.c[i]);
  return text + "> ";
}

std::string write_binary(double value, BinaryForm form) {
  Range const range = range_of(form);
  double const rounded = std::isnan(value) ? 0 : std::floor(value + 0.5);
  auto const bits = static_cast<std::uint32_t>(
      static_cast<std::int64_t>(std::clamp(rounded, range.low, range.high)));
  std::string bytes;
  for (int i = 0; i < range.bytes; ++i) {
    int const shift = 8 * (range.big_endian ? range.bytes - 1 - i : i);
    bytes += static_cast<char>((bits >> shift) & 0xff);
  }
  return bytes;
}

} // namespace abbe::lang
