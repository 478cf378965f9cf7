// SPDX-License-Identifier: MIT
#include "lang/attach.hpp"
#include "lang/unsupported.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace abbe::lang {

namespace {

using scene::Pigment;
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

std::shared_ptr<Pigment const> plain(scene::Colour colour) {
  auto pigment = std::make_shared<Pigment>();
  pigment->colour = std::move(colour);
  return pigment;
}

/// What a pigment is while its block is read.
struct Draft {
  Pigment& pigment;
  std::unique_ptr<PatternInstance> instance; ///< the pattern, open for changes
  geometry::Transform moved; ///< transforms of a plain colour: a pattern given to it later has them
  bool begun = false;        ///< has an item been read?
  bool chosen = false;       ///< has a colour or a pattern been read?
  bool wrong = false;        ///< has an item been reported?

  explicit Draft(Pigment& target) : pigment(target) { load(); }
  void load() {
    instance.reset();
    if (pigment.pattern) instance = std::make_unique<PatternInstance>(*pigment.pattern);
  }
  void choose(Reader& in, Span at) {
    if (std::exchange(chosen, true) && !wrong)
      in.report(Severity::Error, "E0251",
                "a second colour or pattern: a pigment has one, before its modifiers", at);
  }
  void set(scene::Colour const& colour) {
    pigment.colour = colour;
    pigment.entries.clear();
    pigment.default_entries = false;
    instance.reset();
  }
  void store() {
    pigment.pattern = instance ? std::make_shared<PatternInstance const>(*instance) : nullptr;
  }
};

/// Adds a transform to the way from the surrounding space into the pattern's. Affine steps that
/// follow one another are one.
void append(PatternInstance& instance, geometry::Transform const& transform) {
  if (instance.mappings.empty()) {
    instance.mappings.push_back({transform.inverse_linear, transform.inverse_offset});
    return;
  }
  texture::Mapping& last = instance.mappings.back();
  last.offset = last.linear * transform.inverse_offset + last.offset;
  last.linear = last.linear * transform.inverse_linear;
}

void set_default_entries(Pigment& pigment, texture::Pattern const& pattern, std::size_t from) {
  auto const defaults = pattern.default_map();
  for (std::size_t i = from; i < defaults.size(); ++i)
    pigment.entries.push_back({defaults[i].value, plain({defaults[i].rgb, 0, 0, nullptr})});
}

/// The items of checker, brick and their like: colours or pigments.
void read_list(Reader& in, Draft& draft) {
  auto const size = static_cast<std::size_t>(draft.instance->pattern->list_size());
  std::vector<Pigment::Entry> items;
  while (items.size() < size && !in.at_end()) {
    auto const number = static_cast<double>(items.size());
    if (in.open("pigment")) {
      auto item = std::make_shared<Pigment>(default_texture(in, in.block_span()).pigment);
      read_pigment(in, *item);
      in.close();
      items.push_back({number, std::move(item)});
    } else if (auto named = in.accept_value<Pigment>()) {
      items.push_back({number, std::move(named)});
    } else if (auto colour = accept_colour(in)) {
      items.push_back({number, plain(*colour)});
    } else if (auto changed = draft.instance->pattern->read_item(in)) {
      draft.instance->pattern = std::move(changed);
    } else {
      break;
    }
  }
  draft.pigment.default_entries = items.empty();
  draft.pigment.entries = std::move(items);
  set_default_entries(draft.pigment, *draft.instance->pattern, draft.pigment.entries.size());
}

bool read_pattern(Reader& in, Draft& draft) {
  texture::PatternKind const* const kind = find_pattern(in.next_word());
  Span const at = in.next_span();
  if (!kind || !in.accept(kind->keyword)) return false;
  draft.choose(in, at);
  if (!draft.instance) {
    draft.instance = std::make_unique<PatternInstance>();
    if (!draft.moved.identity()) append(*draft.instance, draft.moved);
    draft.instance->modifiers.noise_generator =
        scene_state(in.interpreter()).default_noise_generator;
  }
  bool const was_list = draft.instance->pattern && draft.instance->pattern->list_size() > 0;
  draft.instance->pattern = kind->read(in);
  if (draft.instance->pattern->list_size() > 0) {
    read_list(in, draft);
  } else if (was_list || draft.pigment.default_entries) {
    draft.pigment.entries.clear();
    draft.pigment.default_entries = false;
  }
  return true;
}

/// What acts on patterns and stands behind a plain colour, as POV-Ray lets it.
bool pass_modifier(Reader& in) {
  std::string const word(in.next_word());
  Span const at = in.next_span();
  texture::PatternModifiers ignored;
  if (word == "warp")
    in.skip();
  else if (!texture::read_modifier(in, ignored))
    return false;
  in.report(Severity::Warning, "E0257", fmt::format("'{}' has no effect on a plain colour", word),
            at);
  return true;
}

bool read_modifier(Reader& in, Draft& draft) {
  if (!draft.instance) return pass_modifier(in);
  if (auto changed = draft.instance->pattern->read_item(in)) {
    draft.instance->pattern = std::move(changed);
    return true;
  }
  return texture::read_modifier(in, draft.instance->modifiers);
}

bool read_map(Reader& in, Draft& draft) {
  Span const at = in.next_span();
  bool const colours = in.open("color_map") || in.open("colour_map");
  if (!colours && !in.open("pigment_map")) return false;
  auto entries = colours ? read_color_map(in) : read_pigment_map(in);
  in.close();
  if (draft.instance && draft.instance->pattern->list_size() > 0)
    in.report(Severity::Error, "E0252", "this pattern takes a list of colours, not a map", at);
  else
    draft.pigment.entries = std::move(entries);
  draft.pigment.default_entries = false;
  return true;
}

/// A colour that begins with a word of its own: the most frequent item by far.
bool read_plain_colour(Reader& in, Draft& draft) {
  if (in.next() != Next::Word || !starts_colour(in)) return false;
  Span const at = in.next_span();
  auto const colour = accept_colour(in);
  if (!colour) return false;
  draft.choose(in, at);
  draft.set(*colour);
  return true;
}

bool read_other(Reader& in, Draft& draft) {
  Span const at = in.next_span();
  geometry::Transform transform;
  if (read_transform(in, transform)) {
    if (draft.instance)
      append(*draft.instance, transform);
    else
      draft.moved = draft.moved.then(transform);
  } else if (in.accept("quick_color") || in.accept("quick_colour")) {
    read_colour(in, "quick_color"); // only for POV-Ray's lowest qualities
  } else if (auto named = in.accept_copied<Pigment>(!draft.begun, "pigment")) {
    draft.pigment = *named;
    draft.moved = {};
    draft.load();
  } else if (auto colour = accept_colour(in)) {
    draft.choose(in, at);
    draft.set(*colour);
  } else {
    return false;
  }
  return true;
}

/// `function { }` and `object { }` stand for patterns that are not supported yet.
bool reject_other_pattern(Reader& in) {
  Span const at = in.next_span();
  Value const* const value = in.identifier();
  bool const function = value && std::holds_alternative<std::shared_ptr<FunctionValue>>(value->any);
  bool const object = in.next() == Next::Block && in.next_word() == "object";
  if (!function && !object) return false;
  report_unsupported(in, function ? "function" : "object", at);
  skip_rest(in);
  return true;
}

} // namespace

void read_pigment(Reader& in, Pigment& pigment) {
  read_pigment_of_texture(in, pigment, {});
}

void read_pigment_of_texture(Reader& in, Pigment& pigment, geometry::Transform const& moved) {
  pigment.span = in.block_span();
  Span const span = pigment.span;
  Draft draft(pigment);
  draft.moved = moved;
  bool rejected = false;
  for (; !in.at_end(); draft.begun = true) {
    if (read_plain_colour(in, draft) || read_pattern(in, draft) || read_modifier(in, draft)
        || read_map(in, draft) || read_other(in, draft))
      continue;
    if (skip_rest_if_unsupported(in) || reject_other_pattern(in)) {
      rejected = true;
      break;
    }
    // Asking for them makes them what "did you mean" offers.
    for (auto const& kind : texture::pattern_kinds()) in.accept(kind.keyword);
    reject(in, "a pigment item");
    draft.wrong = true;
  }
  pigment.span = span;
  draft.store();
  if (draft.instance && pigment.entries.empty()) {
    set_default_entries(pigment, *draft.instance->pattern, 0);
    pigment.default_entries = true;
  }
  if (!draft.instance && !pigment.entries.empty()) {
    if (!rejected)
      in.report(Severity::Error, "E0250", "this pigment has a map but no pattern", span);
    pigment.entries.clear();
  }
}

void transform_pigment(Pigment& pigment, geometry::Transform const& transform) {
  if (!pigment.pattern) return;
  PatternInstance instance = *pigment.pattern;
  append(instance, transform);
  pigment.pattern = std::make_shared<PatternInstance const>(std::move(instance));
}

} // namespace abbe::lang
