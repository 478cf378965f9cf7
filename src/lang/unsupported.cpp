// SPDX-License-Identifier: MIT
#include "lang/unsupported.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace abbe::lang {

namespace {

struct Entry {
  std::string_view word, where, what;
};
constexpr Entry entries[] = {
#define ABBE_UNSUPPORTED(word, where, what) {word, where, what},
#include "lang/unsupported.def"
#undef ABBE_UNSUPPORTED
};
static_assert(std::ranges::is_sorted(entries, {}, &Entry::word));

Entry const* find(std::string_view word) {
  auto const found = std::ranges::lower_bound(entries, word, {}, &Entry::word);
  return found != std::end(entries) && found->word == word ? found : nullptr;
}

} // namespace

std::vector<std::string_view> unsupported_words() {
  std::vector<std::string_view> words;
  for (Entry const& entry : entries) words.push_back(entry.word);
  return words;
}

bool is_unsupported_shape(std::string_view word) {
  Entry const* const entry = find(word);
  return entry && entry->what.starts_with("shape");
}

void report_unsupported(Reader& in, std::string_view word, Span at) {
  in.report(Severity::Error, "E0901", fmt::format("'{}' is not supported yet", word), at);
}

bool skip_unsupported(Reader& in) {
  Entry const* const entry = find(in.next_word());
  if (!entry) return false;
  report_unsupported(in, entry->word, in.next_span());
  in.skip();
  return true;
}

void skip_rest(Reader& in) {
  while (!in.at_end()) in.skip();
}

bool skip_rest_if_unsupported(Reader& in) {
  if (!skip_unsupported(in)) return false;
  skip_rest(in);
  return true;
}

void reject(Reader& in, std::string_view where) {
  if (!skip_unsupported(in)) in.unexpected(where);
}

} // namespace abbe::lang
