// SPDX-License-Identifier: MIT
#include "lang/pattern.hpp"

#include "lang/interpreter.hpp"
#include "lang/scene_patterns.hpp"
#include "texture/patterns/ripples.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <unordered_map>
#include <utility>

namespace abbe::lang {

namespace {

using texture::PatternInstance;

texture::PatternKind const* find_pattern(std::string_view word) {
  static auto const by_word = [] {
    std::unordered_map<std::string_view, texture::PatternKind const*> map;
    for (auto const& kind : texture::pattern_kinds()) map.emplace(kind.keyword, &kind);
    return map;
  }();
  auto const found = by_word.find(word);
  return found == by_word.end() ? nullptr : found->second;
}

/// `warp { ... }`: the next step of the way into the pattern.
bool read_warp(Reader& in, PatternInstance& instance) {
  if (!in.open("warp")) return false;
  for (texture::WarpKind const& kind : texture::warp_kinds())
    if (in.accept(kind.keyword)) {
      if (auto warp = kind.read(in)) instance.mappings.push_back({Mat3(1), Vec3(0), warp});
      in.close();
      return true;
    }
  reject(in, "a warp");
  while (!in.at_end()) in.skip();
  in.close();
  return true;
}

} // namespace

void append(PatternInstance& instance, geometry::Transform const& transform) {
  if (instance.mappings.empty() || instance.mappings.back().warp) {
    instance.mappings.push_back({transform.inverse_linear, transform.inverse_offset});
    return;
  }
  texture::Mapping& last = instance.mappings.back();
  last.offset = last.linear * transform.inverse_offset + last.offset;
  last.linear = last.linear * transform.inverse_linear;
}

void transform_pattern(std::shared_ptr<PatternInstance const>& pattern,
                       geometry::Transform const& transform) {
  if (!pattern || pattern->uv) return; // surface coordinates are not moved
  PatternInstance instance = *pattern;
  append(instance, transform);
  pattern = std::make_shared<PatternInstance const>(std::move(instance));
}

void PatternDraft::transform(geometry::Transform const& transform) {
  if (instance)
    append(*instance, transform);
  else
    moved = moved.then(transform);
}

bool PatternDraft::read_uv_mapping(Reader& in) {
  if (!in.accept("uv_mapping")) return false;
  uv = in.boolean_or(true);
  if (instance) instance->uv = uv;
  return true;
}

namespace {

ScenePatternKind const* find_scene_pattern(std::string_view word) {
  auto const kinds = scene_pattern_kinds();
  auto const found = std::ranges::find(kinds, word, &ScenePatternKind::keyword);
  return found == kinds.end() ? nullptr : &*found;
}

/// The pattern that is next with what belongs to it; nullopt: none is; null: it was wrong.
std::optional<std::shared_ptr<texture::Pattern const>> accept_pattern(Reader& in, bool& encloses) {
  if (starts_function(in)) return read_function_pattern(in, encloses);
  std::string_view const word = in.next_word();
  if (ScenePatternKind const* const kind = find_scene_pattern(word);
      kind && (in.next() == Next::Block) == kind->block)
    return kind->read(in, encloses);
  texture::PatternKind const* const kind = find_pattern(word);
  // `slope { }` opens a block of its own where it has more than a direction.
  bool const block = word == "slope" && in.next() == Next::Block;
  if (!kind || (!block && !in.accept(kind->keyword))) return std::nullopt;
  int const sources = scene_state(in.interpreter()).number_of_waves;
  if (sources != 10 && kind->keyword == "ripples") return texture::make_ripples(sources);
  if (sources != 10 && kind->keyword == "waves") return texture::make_waves(sources);
  return kind->read(in);
}

} // namespace

bool starts_pattern(Reader& in) {
  return find_pattern(in.next_word()) != nullptr;
}

bool ask_for_patterns(Reader& in) {
  for (auto const& kind : texture::pattern_kinds()) in.accept(kind.keyword);
  return false;
}

bool read_pattern(Reader& in, PatternDraft& draft) {
  auto pattern = accept_pattern(in, draft.encloses);
  if (!pattern) return false;
  if (!draft.instance) {
    draft.instance = std::make_unique<PatternInstance>();
    draft.instance->uv = draft.uv;
    if (!draft.moved.identity()) append(*draft.instance, draft.moved);
    draft.instance->modifiers.noise_generator =
        scene_state(in.interpreter()).default_noise_generator;
  }
  // What stands for one that is wrong.
  if (!*pattern) pattern = find_pattern("bozo")->read(in);
  draft.instance->pattern = std::move(*pattern);
  return true;
}

bool read_pattern_with_value(Reader& in, PatternDraft& draft) {
  Span const at = in.next_span();
  std::string const word(in.next_word());
  if (!read_pattern(in, draft)) return false;
  if (draft.instance->pattern->has_value()) return true;
  in.report(Severity::Error, "E0252",
            fmt::format("'{}' tilts normals and has no value: it stands in a normal", word), at);
  draft.instance->pattern = find_pattern("bozo")->read(in);
  return true;
}

void PatternDraft::close(Reader& in) {
  if (!std::exchange(encloses, false)) return;
  while (!in.at_end()) reject(in, "an item of the pattern's list");
  in.close();
}

bool read_pattern_modifier(Reader& in, PatternDraft& draft) {
  if (auto changed = draft.instance->pattern->read_item(in)) {
    draft.instance->pattern = std::move(changed);
    return true;
  }
  return read_warp(in, *draft.instance) || texture::read_modifier(in, draft.instance->modifiers);
}

void report_descending(Reader& in, double value, double before, Span span) {
  in.report(Severity::Warning, "E0356",
            fmt::format("map values should ascend, {} follows {}", value, before), span);
}

double read_entry_value(Reader& in) {
  return in.has_value() ? in.number("map value") : std::numeric_limits<double>::quiet_NaN();
}

void report_no_value(Reader& in, Span span) {
  in.report(Severity::Error, "E0301",
            "a map entry begins with its value: only those of 'average' may leave it out", span);
}

} // namespace abbe::lang
