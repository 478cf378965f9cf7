// SPDX-License-Identifier: MIT
#pragma once

#include "image/texels.hpp"
#include "lang/reader.hpp"
#include "texture/pattern.hpp"

#include <optional>

/// Patterns that are made of pictures in files.
namespace abbe::lang {

std::shared_ptr<texture::Pattern const> read_image_map(Reader&, bool& encloses);
std::shared_ptr<texture::Pattern const> read_image_pattern(Reader&, bool& encloses);
std::shared_ptr<texture::Pattern const> read_bump_map(Reader&, bool& encloses);
/// A picture as blocks name it: a file, with the word of its kind or without, or `function w, h
/// { ... }`. @return nullopt, reported, when it cannot be had
std::optional<image::Texels> read_texels_source(Reader&);
/// `material_map { ... }`: its textures stand in the block that it opens.
std::shared_ptr<texture::Pattern const> read_material_map(Reader&, bool& encloses);

} // namespace abbe::lang
