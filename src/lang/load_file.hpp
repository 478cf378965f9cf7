// SPDX-License-Identifier: MIT
#pragma once

#include "lang/blocks.hpp"

#include <initializer_list>

namespace abbe::lang {

/// load_file(), and where there is no file of that name, of the names with an extension behind it,
/// the first that is there: `ttf "cyrvetic"`.
/// @param extensions ".ttf"; tried as they are and in capitals
Result<std::string> load_file(Interpreter&, std::string_view path_as_written,
                              std::initializer_list<std::string_view> extensions);
/// The file of a picture. @param kind "png", or empty: of any kind
Result<std::string> load_picture(Interpreter&, std::string_view path_as_written,
                                 std::string_view kind);

} // namespace abbe::lang
