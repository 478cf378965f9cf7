// SPDX-License-Identifier: MIT
#pragma once

#include "texture/pattern.hpp"
#include "word_parameters.hpp"

#include <gtest/gtest.h>

namespace abbe::texture {

/// A pattern as a pigment would read it: keyword, then items and modifiers in any order.
inline PatternInstance read_pattern(WordParameters& in) {
  PatternInstance instance;
  for (PatternKind const& kind : pattern_kinds()) {
    if (!in.accept(kind.keyword)) continue;
    instance.pattern = kind.read(in);
    while (!in.at_end()) {
      if (auto changed = instance.pattern->read_item(in))
        instance.pattern = changed;
      else if (!read_modifier(in, instance.modifiers)) {
        ADD_FAILURE() << "unread words";
        break;
      }
    }
    return instance;
  }
  ADD_FAILURE() << "no such pattern";
  return instance;
}

inline PatternInstance read_pattern(std::string const& text) {
  WordParameters in(text);
  PatternInstance instance = read_pattern(in);
  EXPECT_TRUE(in.reports.empty());
  return instance;
}

} // namespace abbe::texture
