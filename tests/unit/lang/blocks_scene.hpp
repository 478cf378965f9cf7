// SPDX-License-Identifier: MIT
#pragma once

#include "lang/evaluate.hpp"

#include <gtest/gtest.h>

#include <string>

namespace abbe::lang {

inline Evaluated evaluate(std::string text) {
  EvaluateOptions options;
  options.stdlib_dir = ABBE_STDLIB_DIR;
  options.include_dirs = {ABBE_SOURCE_DIR "/tests/data/optics"};
  return evaluate_text("test.scn", std::move(text), options);
}

inline std::string messages(Evaluated const& evaluated) {
  std::string all;
  for (Diagnostic const& d : evaluated.diagnostics) all += format(d);
  return all;
}

/// The scene of a text that must be right, without even a warning.
inline scene::Scene scene_of(std::string text) {
  Evaluated evaluated = evaluate(std::move(text));
  EXPECT_EQ(messages(evaluated), "");
  return std::move(evaluated.scene);
}

/// "E0250 E0901": the codes of all messages, in order.
inline std::string codes(std::string text) {
  std::string all;
  for (Diagnostic const& d : evaluate(std::move(text)).diagnostics)
    all += (all.empty() ? "" : " ") + d.code;
  return all;
}

inline void expect_near(Vec3 const& a, Vec3 const& b, double tolerance) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
}

} // namespace abbe::lang
