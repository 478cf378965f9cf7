// SPDX-License-Identifier: MIT
#include "cli/identity.hpp"

#include "base/word_hash.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <sstream>

namespace abbe::cli {
namespace {

/// A text, with its length.
void add(WordHash& hash, std::string_view text) {
  hash.add(text.size());
  hash.add(text.data(), text.size());
}

/// Can the same texts make another scene at another time?
bool asks_elsewhere(std::string_view text) {
  constexpr std::string_view words[] = {"now", "datetime", "fopen", "glass_catalog"};
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
  if (source.bytes().changed()) add(hash, "changed");
  return elsewhere;
}

std::string program() {
  std::ifstream file("/proc/self/exe", std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  return std::move(bytes).str();
}

} // namespace

std::uint64_t picture_identity(lang::Evaluated const& evaluated,
                               render::RenderOptions const& options, std::string const& words) {
  WordHash hash;
  bool elsewhere = false;
  for (SourceFile const* text : evaluated.texts) {
    bool const asks = add(hash, *text);
    elsewhere = elsewhere || asks;
  }
  if (elsewhere) add(hash, lang::dump_scene(evaluated.scene));
  render::Region const region = options.pixels();
  auto const& aa = options.anti_aliasing;
  add(hash, fmt::format("{} {} {} {} {} {} {} {} {} {:a} {:a} {} {} {} {} {}", options.width,
                        options.height, region.x0, region.y0, region.x1, region.y1,
                        options.tile_size, aa.method, aa.depth, aa.threshold, aa.jitter,
                        options.seed, options.spectral_output, options.check_finite,
                        options.max_trace_level.value_or(0), options.passes));
  add(hash, words);
  add(hash, program());
  return hash.value();
}

} // namespace abbe::cli
