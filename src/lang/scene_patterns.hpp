// SPDX-License-Identifier: MIT
#pragma once

#include "lang/reader.hpp"
#include "texture/pattern.hpp"

/// Patterns that are made of things of the language. Those of the leaf library are in
/// texture/patterns.
namespace abbe::lang {

struct ScenePatternKind {
  std::string_view keyword;
  /// Takes the word with what belongs to it. @param[out] encloses the items of its list stand in a
  /// block that it opened. @return null, reported, when it is wrong
  std::shared_ptr<texture::Pattern const> (*read)(Reader&, bool& encloses);
  bool block = true; ///< the word is the head of a block
};
/// One line each in scene_patterns.cpp.
std::span<ScenePatternKind const> scene_pattern_kinds();

std::shared_ptr<texture::Pattern const> read_function_pattern(Reader&, bool& encloses);
std::shared_ptr<texture::Pattern const> read_object_pattern(Reader&, bool& encloses);
std::shared_ptr<texture::Pattern const> read_pigment_pattern(Reader&, bool& encloses);
/// The grey value of a pigment.
std::shared_ptr<texture::Pattern const> make_pigment_pattern(scene::Pigment);
std::shared_ptr<texture::Pattern const> read_density_file(Reader&, bool& encloses);
/// Is `function { }` next?
bool starts_function(Reader&);

} // namespace abbe::lang
