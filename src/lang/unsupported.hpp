// SPDX-License-Identifier: MIT
#pragma once

#include "lang/blocks.hpp"

#include <string_view>
#include <vector>

namespace abbe::lang {

/// The words of unsupported.def, ordered.
std::vector<std::string_view> unsupported_words();
bool is_unsupported_shape(std::string_view word);
void report_unsupported(Reader&, std::string_view word, Span);

} // namespace abbe::lang
