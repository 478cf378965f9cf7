// SPDX-License-Identifier: MIT
#include "lang/texture_map.hpp"

#include "lang/image_pattern.hpp"
#include "texture/patterns/checker.hpp"

#include <utility>

namespace abbe::lang {

namespace {

using Entry = scene::TextureMap::Entry;

/// The next item of a list: a texture or the name of one.
std::optional<scene::Layers> accept_texture(Reader& in) {
  if (in.open("texture")) {
    scene::SharedLayers const layers = read_texture(in);
    in.close();
    return *layers;
  }
  if (auto named = in.accept_value<scene::Layers>()) return *named;
  return std::nullopt;
}

} // namespace

TextureMapDraft::TextureMapDraft(std::shared_ptr<scene::TextureMap const> const& from) {
  if (!from) return;
  draft_.load(from->pattern);
  entries_ = from->entries;
}

void TextureMapDraft::read_list(Reader& in) {
  auto const size = static_cast<std::size_t>(draft_.instance->pattern->list_size());
  while (entries_.size() < size && !in.at_end()) {
    auto const number = static_cast<double>(entries_.size());
    if (auto layers = accept_texture(in))
      entries_.push_back({number, std::move(*layers)});
    else if (auto changed = draft_.instance->pattern->read_item(in))
      draft_.instance->pattern = std::move(changed);
    else
      break;
  }
  while (entries_.size() < size)
    entries_.push_back({static_cast<double>(entries_.size()),
                        scene::Layers(1, default_texture(in, in.block_span()))});
}

/// `tiles { texture {} tile2 texture {} }`: the older word for checker.
void TextureMapDraft::read_tiles(Reader& in) {
  draft_.instance = std::make_unique<texture::PatternInstance>();
  draft_.instance->pattern = texture::read_checker(in);
  scene::Layers tile[2];
  int at = 0;
  while (!in.at_end()) {
    if (in.accept("tile2"))
      at = 1;
    else if (auto layers = accept_texture(in))
      tile[at].insert(tile[at].end(), layers->begin(), layers->end());
    else
      reject(in, "a texture or 'tile2'");
  }
  std::swap(tile[0], tile[1]); // the first stands where checker's second does
  for (scene::Layers& layers : tile) {
    if (layers.empty()) layers.push_back(default_texture(in, in.block_span()));
    entries_.push_back({static_cast<double>(entries_.size()), std::move(layers)});
  }
}

/// `material_map { image texture {} ... }`: the colours' numbers choose among the textures.
void TextureMapDraft::read_material(Reader& in) {
  auto pattern = read_material_map(in, draft_.encloses);
  while (!in.at_end()) {
    if (auto layers = accept_texture(in))
      entries_.push_back({static_cast<double>(entries_.size()), std::move(*layers)});
    else if (auto changed = pattern ? pattern->read_item(in) : nullptr)
      pattern = std::move(changed);
    else
      reject(in, "a texture or an item of the image");
  }
  draft_.close(in);
  draft_.instance->pattern = pattern ? std::move(pattern) : texture::read_checker(in);
}

bool TextureMapDraft::read(Reader& in) {
  if (!begun()) {
    if (in.open("tiles")) {
      read_tiles(in);
      in.close();
      return true;
    }
    if (in.next() == Next::Block && in.next_word() == "material_map") {
      draft_.instance = std::make_unique<texture::PatternInstance>();
      read_material(in);
      return true;
    }
    if (!read_pattern_with_value(in, draft_)) return false;
    if (draft_.is_list()) read_list(in);
    draft_.close(in);
    return true;
  }
  geometry::Transform transform;
  if (read_transform(in, transform)) {
    draft_.transform(transform);
  } else if (in.open("texture_map")) {
    entries_ = read_texture_map(in);
    in.close();
  } else {
    return read_pattern_modifier(in, draft_);
  }
  return true;
}

std::shared_ptr<scene::TextureMap const> TextureMapDraft::finish(Reader& in, Span span) {
  if (entries_.empty())
    in.report(Severity::Error, "E0250",
              "a texture with a pattern needs a texture_map, or the textures of a list", span);
  auto map = std::make_shared<scene::TextureMap>();
  map->pattern = draft_.store();
  settle_values(map->pattern->pattern->averages(), entries_, in,
                [](Entry const& entry) { return entry.layers.front().span; });
  map->entries = std::move(entries_);
  if (map->entries.empty()) map->entries.push_back({0, scene::Layers(1)});
  return map;
}

std::vector<Entry> read_texture_map(Reader& in) {
  std::vector<Entry> entries;
  if (auto named = in.accept_value<TextureMapValue>()) entries = named->entries;
  read_entries(in, "a texture_map", entries, [](Reader& items, std::vector<Entry>& into) {
    double const value = read_entry_value(items);
    into.push_back({value, *read_texture(items)});
  });
  return entries;
}

} // namespace abbe::lang
