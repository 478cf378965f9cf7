// SPDX-License-Identifier: MIT
#pragma once

#include "lang/reader.hpp"

#include <span>
#include <string_view>

/// Objects that are made of files: what geometry and a reader of files are both needed for.
namespace abbe::lang {

struct FileShape {
  std::string_view keyword;
  /// Reads the object's own content (not the modifiers that all objects have).
  scene::Object (*read)(Reader&);
};

/// All of them, by keyword.
std::span<FileShape const> file_shapes();
/// Null where there is none of this name.
FileShape const* find_file_shape(std::string_view keyword);

// One file each.
scene::Object read_height_field(Reader&);
scene::Object read_text_object(Reader&);

} // namespace abbe::lang
