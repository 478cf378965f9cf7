// SPDX-License-Identifier: MIT
#include "cli/identity.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <sstream>

namespace abbe::cli {
namespace {

/// FNV-1a over words of 8 bytes, with the length.
class Hash {
public:
  void add(std::string_view text) {
    word(text.size());
    for (std::size_t at = 0; at < text.size(); at += 8) {
      std::uint64_t value = 0;
      std::memcpy(&value, text.data() + at, std::min<std::size_t>(8, text.size() - at));
      word(value);
    }
  }
  std::uint64_t value() const { return value_; }

private:
  void word(std::uint64_t bits) {
    value_ = (value_ ^ bits) * 0x100000001b3;
    value_ ^= value_ >> 29;
  }
  std::uint64_t value_ = 0xcbf29ce484222325;
};

/// Can the same texts make another scene at another time?
bool asks_elsewhere(std::string_view text) {
  constexpr std::string_view words[] = {"now", "datetime", "fopen", "glass_catalog"};
  return std::any_of(std::begin(words), std::end(words), [&](std::string_view word) {
    return text.find(word) != std::string_view::npos;
  });
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
  Hash hash;
  bool elsewhere = false;
  for (SourceFile const* text : evaluated.texts) {
    hash.add(text->text());
    elsewhere = elsewhere || asks_elsewhere(text->text());
  }
  if (elsewhere) hash.add(lang::dump_scene(evaluated.scene));
  auto const region = options.region.value_or(render::Region{0, 0, options.width, options.height});
  auto const& aa = options.anti_aliasing;
  hash.add(fmt::format("{} {} {} {} {} {} {} {} {} {:a} {:a} {} {} {} {}", options.width,
                       options.height, region.x0, region.y0, region.x1, region.y1,
                       options.tile_size, aa.method, aa.depth, aa.threshold, aa.jitter,
                       options.seed, options.spectral_output, options.check_finite,
                       options.max_trace_level.value_or(0)));
  hash.add(words);
  hash.add(program());
  return hash.value();
}

} // namespace abbe::cli
