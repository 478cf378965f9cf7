// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>
#include <string>
#include <string_view>

/// Messages to standard error.
namespace abbe::cli {

/// The text as a terminal may see it: names and strings of a scene can hold anything. Control
/// characters but newline and tab, and bytes that are no UTF-8, are shown as \x1b.
std::string printable(std::string_view text);

/// Prints it. What standard error does not take (it is closed, or its disk is full) is lost: no
/// message is a reason to have no picture.
void say_text(std::string_view text);

template <class... Values>
void say(fmt::format_string<Values...> format, Values&&... values) {
  say_text(fmt::format(format, std::forward<Values>(values)...));
}

/// A line of a terminal that is written again and again; its control characters are meant.
void say_progress(std::string_view line);

} // namespace abbe::cli
