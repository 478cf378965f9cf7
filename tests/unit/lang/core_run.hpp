// SPDX-License-Identifier: MIT
#pragma once

#include "lang/evaluate.hpp"

#include <gtest/gtest.h>

#include <string>

namespace abbe::lang {

/// What a text says with #debug, and its diagnostics behind it.
inline std::string said(std::string text, EvaluateOptions options = {}) {
  std::string out;
  options.stdlib_dir = ABBE_STDLIB_DIR;
  options.on_message = [&](std::string_view message) { out += message; };
  auto const evaluated = evaluate_text("test.scn", std::move(text), options);
  for (auto const& diagnostic : evaluated.diagnostics) out += format(diagnostic) + "\n";
  return out;
}

/// An expression's value, as str(e, 0, 12) gives it.
inline std::string value_of(std::string const& expression) {
  return said("#debug str(" + expression + ", 0, 12)");
}
/// A vector's three components with six digits.
inline std::string vector_of(std::string const& expression) {
  return said("#debug vstr(3, " + expression + ", \",\", 0, 6)");
}
/// The codes of the errors of a text, in order.
inline std::string codes_of(std::string text, EvaluateOptions options = {}) {
  std::string codes;
  options.stdlib_dir = ABBE_STDLIB_DIR;
  auto const evaluated = evaluate_text("test.scn", std::move(text), options);
  for (auto const& diagnostic : evaluated.diagnostics)
    if (diagnostic.severity == Severity::Error)
      codes += (codes.empty() ? "" : " ") + diagnostic.code;
  return codes;
}

} // namespace abbe::lang
