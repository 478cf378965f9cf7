// SPDX-License-Identifier: MIT
#include "cli/identity.hpp"

#include "base/word_hash.hpp"

#include <algorithm>
#include <cstring>
#include <string_view>

namespace abbe::cli {
namespace {

/// Can the same texts make another scene at another time?
bool asks_elsewhere(std::string_view text) {
  constexpr std::string_view words[] = {"now", "datetime", "fopen", "file_exists", "glass_catalog"};
  return std::any_of(std::begin(words), std::end(words), [&](std::string_view word) {
    return memmem(text.data(), text.size(), word.data(), word.size()) != nullptr;
  });
}

/// A source, a piece at a time, which are given up behind: they were when they were parsed.
/// @return asks_elsewhere
bool add(WordHash& hash, SourceFile const& source) {
  constexpr std::size_t piece = std::size_t{1} << 20, longest_word = 16;
  std::string_view const text = source.text();
  bool elsewhere = false;
  hash.add(text.size());
  for (std::size_t begin = 0; begin < text.size(); begin += piece) {
    std::string_view const bytes = text.substr(begin, piece);
    hash.add(bytes.data(), bytes.size());
    elsewhere = elsewhere || asks_elsewhere(text.substr(begin, piece + longest_word));
    source.bytes().give_up(begin, begin + bytes.size());
  }
  // Not what the scene was made of: no later run shall take its tiles.
  if (source.bytes().changed()) hash.add_text("changed");
  return elsewhere;
}

} // namespace

std::uint64_t scene_identity(lang::Evaluated const& evaluated, std::string const& words) {
  WordHash hash;
  bool elsewhere = false;
  for (SourceFile const* text : evaluated.texts) {
    bool const asks = add(hash, *text);
    elsewhere = elsewhere || asks;
  }
  if (elsewhere) hash.add_text(lang::dump_scene(evaluated.scene));
  hash.add_text(words);
  return hash.value();
}

} // namespace abbe::cli
