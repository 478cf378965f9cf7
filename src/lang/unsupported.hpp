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
/// When the next word is an unsupported one that changes what the rest of its block means (a
/// pattern, a projection): reports it and skips the whole rest.
bool skip_rest_if_unsupported(Reader&);
void skip_rest(Reader&);

} // namespace abbe::lang
