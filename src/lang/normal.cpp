// SPDX-License-Identifier: MIT
#include "lang/pattern.hpp"
#include "lang/unsupported.hpp"

#include <utility>

namespace abbe::lang {

namespace {

using scene::Normal;

/// What a normal is while its block is read.
struct Draft : PatternDraft {
  Normal& normal;
  bool begun = false;  ///< has an item been read?
  bool chosen = false; ///< has a pattern been read?
  bool wrong = false;  ///< has an item been reported?

  explicit Draft(Normal& target) : normal(target) { load(normal.pattern); }
};

/// What the entries of maps and lists begin with.
std::shared_ptr<Normal> default_normal(Reader& in) {
  auto const normal = default_texture(in, in.block_span()).normal;
  return normal ? std::make_shared<Normal>(*normal) : std::make_shared<Normal>();
}

std::shared_ptr<Normal const> read_item(Reader& in) {
  auto item = default_normal(in);
  read_normal(in, *item, {});
  return item;
}

/// The items of checker, brick and their like, if there are any: else the pattern's edges tilt.
void read_list(Reader& in, Draft& draft) {
  auto const size = static_cast<std::size_t>(draft.instance->pattern->list_size());
  std::vector<Normal::Entry> items;
  while (items.size() < size && !in.at_end()) {
    auto const number = static_cast<double>(items.size());
    if (in.open("normal")) {
      items.push_back({number, read_item(in)});
      in.close();
    } else if (auto named = in.accept_value<Normal>()) {
      items.push_back({number, std::move(named)});
    } else if (auto changed = draft.instance->pattern->read_item(in)) {
      draft.instance->pattern = std::move(changed);
    } else {
      break;
    }
  }
  while (!items.empty() && items.size() < size)
    items.push_back({static_cast<double>(items.size()), default_normal(in)});
  draft.normal.entries = std::move(items);
}

bool read_pattern_of(Reader& in, Draft& draft) {
  Span const at = in.next_span();
  bool const was_list = draft.is_list();
  if (!read_pattern(in, draft)) return false;
  if (std::exchange(draft.chosen, true) && !draft.wrong)
    in.report(Severity::Error, "E0251", "a second pattern: a normal has one", at);
  if (was_list) draft.normal.entries.clear();
  if (draft.is_list()) read_list(in, draft);
  draft.close(in);
  if (auto const amount = in.optional_number("bump_size")) draft.normal.amount = *amount;
  return true;
}

bool read_map(Reader& in, Draft& draft) {
  Span const at = in.next_span();
  if (in.open("slope_map")) {
    draft.normal.slopes = read_slope_map(in);
    draft.normal.entries.clear();
  } else if (in.open("normal_map")) {
    draft.normal.entries = read_normal_map(in);
    draft.normal.slopes.clear();
  } else {
    return false;
  }
  in.close();
  if (draft.is_list())
    in.report(Severity::Error, "E0252", "this pattern takes a list of normals, not a map", at);
  return true;
}

bool read_other(Reader& in, Draft& draft) {
  geometry::Transform transform;
  if (read_transform(in, transform))
    draft.transform(transform);
  else if (in.accept("bump_size"))
    draft.normal.amount = in.number("bump_size");
  else if (in.accept("accuracy"))
    draft.normal.accuracy = in.number("accuracy");
  else if (in.accept("no_bump_scale"))
    draft.normal.no_bump_scale = in.boolean_or(true);
  else if (auto named = in.accept_copied<Normal>(!draft.begun, "normal")) {
    draft.normal = *named;
    draft.load(named->pattern);
  } else {
    return false;
  }
  return true;
}

} // namespace

void read_normal(Reader& in, Normal& normal, geometry::Transform const& moved) {
  Span const span = in.block_span();
  Draft draft(normal);
  draft.moved = moved;
  for (; !in.at_end(); draft.begun = true) {
    if (draft.read_uv_mapping(in) || read_pattern_of(in, draft)
        || (draft.instance && read_pattern_modifier(in, draft)) || read_map(in, draft)
        || read_other(in, draft))
      continue;
    if (skip_rest_if_unsupported(in)) break;
    ask_for_patterns(in);
    reject(in, "an item of a normal");
    draft.wrong = true;
  }
  normal.span = span;
  normal.pattern = draft.store();
  if (draft.instance)
    settle_values(draft.instance->pattern->averages(), normal.entries, in,
                  [](auto const& entry) { return entry.normal->span; });
  if (normal.pattern || (normal.slopes.empty() && normal.entries.empty())) return;
  in.report(Severity::Error, "E0250", "this normal has a map but no pattern", span);
  normal.slopes.clear();
  normal.entries.clear();
}

std::vector<Normal::Entry> read_normal_map(Reader& in) {
  std::vector<Normal::Entry> entries;
  if (auto named = in.accept_value<NormalMapValue>()) entries = named->entries;
  read_entries(in, "a normal_map", entries, [](Reader& items, std::vector<Normal::Entry>& into) {
    double const value = read_entry_value(items);
    into.push_back({value, read_item(items)});
  });
  return entries;
}

std::vector<Normal::Slope> read_slope_map(Reader& in) {
  std::vector<Normal::Slope> entries;
  if (auto named = in.accept_value<SlopeMapValue>()) entries = named->entries;
  read_entries(in, "a slope_map", entries, [](Reader& items, std::vector<Normal::Slope>& into) {
    double const value = items.number("map value");
    Vec2 const slope = items.vec2("height and slope");
    into.push_back({value, slope.x, slope.y});
  });
  make_ascending(entries, in, [&](auto const&) { return in.block_span(); });
  return entries;
}

void transform_normal(std::shared_ptr<Normal const>& normal, geometry::Transform const& transform) {
  if (!normal || !normal->pattern) return;
  auto moved = std::make_shared<Normal>(*normal);
  transform_pattern(moved->pattern, transform);
  normal = std::move(moved);
}

} // namespace abbe::lang
