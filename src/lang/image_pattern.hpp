// SPDX-License-Identifier: MIT
#pragma once

#include "lang/reader.hpp"
#include "texture/pattern.hpp"

/// Patterns that are made of pictures in files.
namespace abbe::lang {

std::shared_ptr<texture::Pattern const> read_image_map(Reader&, bool& encloses);
std::shared_ptr<texture::Pattern const> read_image_pattern(Reader&, bool& encloses);
std::shared_ptr<texture::Pattern const> read_bump_map(Reader&, bool& encloses);
/// `material_map { ... }`: its textures stand in the block that it opens.
std::shared_ptr<texture::Pattern const> read_material_map(Reader&, bool& encloses);

} // namespace abbe::lang
