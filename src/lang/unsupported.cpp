// SPDX-License-Identifier: MIT
#include "lang/blocks.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace abbe::lang {

namespace {

constexpr std::string_view unsupported_words[] = {
#define ABBE_UNSUPPORTED(word, where, what) word,
#include "lang/unsupported.def"
#undef ABBE_UNSUPPORTED
};
static_assert(std::ranges::is_sorted(unsupported_words));

} // namespace

bool skip_unsupported(Reader& in) {
  std::string_view const word = in.next_word();
  if (!std::ranges::binary_search(unsupported_words, word)) return false;
  in.report(Severity::Error, "E0901", fmt::format("'{}' is not supported yet", word),
            in.next_span());
  in.skip();
  return true;
}

void reject(Reader& in, std::string_view where) {
  if (!skip_unsupported(in)) in.unexpected(where);
}

} // namespace abbe::lang
