// SPDX-License-Identifier: MIT
#include "lang/file_shapes.hpp"

#include <algorithm>
#include <iterator>

namespace abbe::lang {

std::span<FileShape const> file_shapes() {
  static constexpr FileShape shapes[] = {
      {"height_field", read_height_field},
      {"text", read_text_object},
  };
  return shapes;
}

FileShape const* find_file_shape(std::string_view keyword) {
  auto const shapes = file_shapes();
  auto const found = std::ranges::find(shapes, keyword, &FileShape::keyword);
  return found == shapes.end() ? nullptr : &*found;
}

} // namespace abbe::lang
