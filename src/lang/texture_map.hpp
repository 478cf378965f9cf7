// SPDX-License-Identifier: MIT
#pragma once

#include "lang/pattern.hpp"

/// Textures that a pattern chooses: `checker texture {} texture {}`, `bozo texture_map {}`.
namespace abbe::lang {

/// A patterned texture while its block is read.
class TextureMapDraft {
public:
  /// @param from what is copied; or null
  explicit TextureMapDraft(std::shared_ptr<scene::TextureMap const> const& from);
  bool begun() const { return draft_.instance != nullptr; }
  /// Takes a pattern with its list, a map, a modifier or a transform, when one is next.
  bool read(Reader&);
  /// @param span of the texture
  std::shared_ptr<scene::TextureMap const> finish(Reader&, Span span);

private:
  void read_list(Reader&);
  void read_tiles(Reader&);
  void read_material(Reader&);
  PatternDraft draft_;
  std::vector<scene::TextureMap::Entry> entries_;
};

} // namespace abbe::lang
