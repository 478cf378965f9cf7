// SPDX-License-Identifier: MIT
#include "lang/builtins.hpp"
#include "lang/interpreter.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <fmt/format.h>

namespace abbe::lang {
namespace {

using Arguments = std::span<Argument const>;
double f(Arguments a, std::size_t i) {
  return a[i].number.c[0];
}

/// A character of a text in UTF-8: its number, and how many bytes it takes. A byte that is no part
/// of one stands for itself; where the text ends it is 0.
struct Character {
  int code;
  std::size_t bytes;
};

Character character_at(std::string_view text, std::size_t at) {
  auto const byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<int>(static_cast<unsigned char>(text[i])) : 0;
  };
  int const first = byte(at);
  std::size_t const bytes = first < 0xc0 ? 1 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
  if (bytes == 1) return {first, 1};
  int code = first & (0xff >> (bytes + 1));
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(at + i) & 0xc0) != 0x80) return {first, 1};
    code = (code << 6) | (byte(at + i) & 0x3f);
  }
  return {code, bytes};
}

/// Where character `count`, from 0, begins.
std::size_t place_of(std::string_view text, double count) {
  std::size_t at = 0;
  for (; count > 0 && at < text.size(); --count) at += character_at(text, at).bytes;
  return at;
}

double length(std::string_view text) {
  double count = 0;
  for (std::size_t at = 0; at < text.size(); at += character_at(text, at).bytes) ++count;
  return count;
}

/// More than any text of a scene, less than what a loop of concat() reaches in no time.
constexpr std::size_t max_string = std::size_t{1} << 24;
constexpr double max_columns = 1000;
constexpr double max_digits = 300;

/// printf's `%[width].[precision]f` with POV-Ray's meaning of negative numbers.
std::string formatted(CallContext& context, double value, double width, double precision) {
  if (!(std::abs(width) <= max_columns && precision <= max_digits)) {
    context.fail(fmt::format("at most {} columns and {} digits, not {} and {}", max_columns,
                             max_digits, width, precision));
    return {};
  }
  int const digits = precision < 0 ? 6 : static_cast<int>(precision);
  int const columns = static_cast<int>(std::abs(width));
  return width < 0 ? fmt::format("{:0{}.{}f}", value, columns, digits)
                   : fmt::format("{:{}.{}f}", value, columns, digits);
}

std::string str(CallContext& context, Arguments a) {
  return formatted(context, f(a, 0), f(a, 1), f(a, 2));
}

std::string vstr(CallContext& context, Arguments a) {
  if (std::isnan(f(a, 0))) {
    context.fail("the number of components is not a number");
    return {};
  }
  auto const count = static_cast<std::size_t>(std::clamp(f(a, 0), 2.0, 5.0));
  Numeric const& value = a[1].number;
  std::string text;
  for (std::size_t i = 0; i < count; ++i) {
    if (i) text += a[2].text;
    text += formatted(context, i < value.size ? value.c[i] : 0, f(a, 3), f(a, 4));
  }
  return text;
}

std::string concat(CallContext& context, Arguments a) {
  std::string text;
  for (auto const& part : a) {
    if (part.text.size() > max_string - text.size()) {
      context.fail(fmt::format("a string of more than {} characters", max_string));
      return {};
    }
    text += part.text;
  }
  return text;
}

std::string chr(CallContext& context, Arguments a) {
  double const code = std::trunc(f(a, 0));
  if (!(code >= 0 && code < 65536)) {
    context.fail(fmt::format("there is no character {}", code));
    return {};
  }
  auto const c = static_cast<unsigned>(code);
  if (c < 0x80) return std::string(1, static_cast<char>(c));
  if (c < 0x800) return {static_cast<char>(0xc0 | (c >> 6)), static_cast<char>(0x80 | (c & 0x3f))};
  return {static_cast<char>(0xe0 | (c >> 12)), static_cast<char>(0x80 | ((c >> 6) & 0x3f)),
          static_cast<char>(0x80 | (c & 0x3f))};
}

std::string substr(CallContext& context, Arguments a) {
  std::string const& text = a[0].text;
  double const first = std::trunc(f(a, 1));
  double const count = std::trunc(f(a, 2));
  double const size = length(text);
  if (!(first >= 1 && count >= 0 && first + count - 1 <= size)) {
    context.fail(fmt::format("{} characters from number {} on are not in a string of {}", count,
                             first, size));
    return {};
  }
  std::size_t const from = place_of(text, first - 1);
  return text.substr(from, place_of(std::string_view(text).substr(from), count));
}

template <char low, char high, int shift>
std::string shifted(CallContext&, Arguments a) {
  std::string text = a[0].text;
  for (char& c : text)
    if (c >= low && c <= high) c = static_cast<char>(c + shift);
  return text;
}

std::string datetime(CallContext& context, Arguments a) {
  double const seconds = std::floor((f(a, 0) + 10957) * 86400 + 0.5);
  std::string const format = a.size() > 1 ? a[1].text : "%Y-%m-%d %H:%M:%SZ";
  std::tm parts{};
  bool const in_range = std::abs(seconds) < 1e13;
  auto const time = in_range ? static_cast<std::time_t>(seconds) : 0;
  if (!in_range || !gmtime_r(&time, &parts)) {
    context.fail("the date is out of range");
    return {};
  }
  if (format.empty()) return {};
  char text[512];
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
  std::size_t const size = std::strftime(text, sizeof text, format.c_str(), &parts);
#pragma GCC diagnostic pop
  if (size == 0) context.fail("the format gives too long a text");
  return {text, size};
}

Numeric strlen_of(CallContext&, Arguments a) {
  return scalar_of(length(a[0].text));
}

/// POV-Ray's: the difference of the first two characters that differ; the end of a text counts as
/// 0.
Numeric strcmp_of(CallContext&, Arguments a) {
  std::string_view const left = a[0].text;
  std::string_view const right = a[1].text;
  std::size_t at = 0;
  while (at < left.size() && at < right.size()) {
    Character const character = character_at(left, at);
    if (character.code != character_at(right, at).code) break;
    at += character.bytes;
  }
  return scalar_of(character_at(left, at).code - character_at(right, at).code);
}

/// 0 of an empty text, as POV-Ray's.
Numeric asc(CallContext&, Arguments a) {
  return scalar_of(character_at(a[0].text, 0).code);
}

Numeric val(CallContext&, Arguments a) {
  return scalar_of(std::strtod(a[0].text.c_str(), nullptr));
}

constexpr Builtin text_function(std::string_view name, std::string_view signature,
                                std::string (*text)(CallContext&, Arguments)) {
  return {name, signature, true, nullptr, text, nullptr};
}

constexpr Builtin table[] = {
    text_function("str", "fff", str),
    text_function("vstr", "fnsff", vstr),
    text_function("concat", "s*", concat),
    text_function("chr", "f", chr),
    text_function("substr", "sff", substr),
    text_function("strlwr", "s", shifted<'A', 'Z', 32>),
    text_function("strupr", "s", shifted<'a', 'z', -32>),
    text_function("datetime", "f?s", datetime),
    {"strlen", "s", false, strlen_of},
    {"strcmp", "ss", false, strcmp_of},
    {"asc", "s", false, asc},
    {"val", "s", false, val},
};

} // namespace

std::span<Builtin const> string_builtins() {
  return table;
}

} // namespace abbe::lang
