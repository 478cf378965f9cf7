// SPDX-License-Identifier: MIT
#include "lang/attach.hpp"
#include "lang/pattern.hpp"
#include "lang/unsupported.hpp"

#include <fmt/format.h>

#include <utility>

namespace abbe::lang {

namespace {

using scene::Pigment;
using texture::PatternInstance;

std::shared_ptr<Pigment const> plain(scene::Colour colour) {
  auto pigment = std::make_shared<Pigment>();
  pigment->colour = std::move(colour);
  return pigment;
}

/// What a pigment is while its block is read.
struct Draft : PatternDraft {
  Pigment& pigment;
  PigmentWords const& words;
  bool begun = false;  ///< has an item been read?
  bool chosen = false; ///< has a colour or a pattern been read?
  bool wrong = false;  ///< has an item been reported?

  Draft(Pigment& target, PigmentWords const& own) : pigment(target), words(own) {
    load(pigment.pattern);
  }
  void choose(Reader& in, Span at) {
    if (std::exchange(chosen, true) && !wrong)
      in.report(Severity::Error, "E0251",
                fmt::format("a second colour or pattern: a {} has one, before its modifiers",
                            words.block),
                at);
  }
  void set(scene::Colour const& colour) {
    pigment.colour = colour;
    pigment.entries.clear();
    pigment.default_entries = false;
    instance.reset();
  }
};

void set_default_entries(Pigment& pigment, texture::Pattern const& pattern, std::size_t from) {
  auto const defaults = pattern.default_map();
  for (std::size_t i = from; i < defaults.size(); ++i)
    pigment.entries.push_back({defaults[i].value, plain({defaults[i].rgb, 0, 0, nullptr})});
}

} // namespace

std::shared_ptr<Pigment const> read_pigment_item(Reader& in, PigmentWords const& words) {
  auto item = std::make_shared<Pigment>(default_texture(in, in.block_span()).pigment);
  read_pigment_of_texture(in, *item, {}, words);
  return item;
}

namespace {

/// The items of checker, brick and their like: colours or pigments.
void read_list(Reader& in, Draft& draft) {
  auto const size = static_cast<std::size_t>(draft.instance->pattern->list_size());
  std::vector<Pigment::Entry> items;
  while (items.size() < size && !in.at_end()) {
    auto const number = static_cast<double>(items.size());
    if (in.open(draft.words.block)) {
      items.push_back({number, read_pigment_item(in, draft.words)});
      in.close();
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

bool read_pattern_of(Reader& in, Draft& draft) {
  Span const at = in.next_span();
  bool const was_list = draft.is_list();
  if (!read_pattern_with_value(in, draft)) return false;
  draft.choose(in, at);
  if (draft.is_list()) {
    read_list(in, draft);
  } else if (was_list || draft.pigment.default_entries) {
    draft.pigment.entries.clear();
    draft.pigment.default_entries = false;
  }
  draft.close(in);
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
  return read_pattern_modifier(in, draft);
}

bool read_map(Reader& in, Draft& draft) {
  Span const at = in.next_span();
  bool const colours = in.open("color_map") || in.open("colour_map");
  if (!colours && !in.open(draft.words.map)) return false;
  auto entries = colours ? read_color_map(in) : read_pigment_map(in, draft.words);
  in.close();
  if (draft.is_list())
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
    draft.transform(transform);
  } else if (in.accept("quick_color") || in.accept("quick_colour")) {
    draft.pigment.quick_colour = std::make_shared<scene::Colour>(read_colour(in, "quick_color"));
  } else if (auto named = in.accept_copied<Pigment>(!draft.begun, draft.words.block)) {
    draft.pigment = *named;
    draft.moved = {};
    draft.load(named->pattern);
  } else if (auto colour = accept_colour(in)) {
    draft.choose(in, at);
    draft.set(*colour);
  } else {
    return false;
  }
  return true;
}

} // namespace

void read_pigment(Reader& in, Pigment& pigment) {
  read_pigment_of_texture(in, pigment, {});
}

void read_pigment_of_texture(Reader& in, Pigment& pigment, geometry::Transform const& moved,
                             PigmentWords const& words) {
  pigment.span = in.block_span();
  Span const span = pigment.span;
  Draft draft(pigment, words);
  draft.moved = moved;
  bool rejected = false;
  for (; !in.at_end(); draft.begun = true) {
    if (read_plain_colour(in, draft) || draft.read_uv_mapping(in) || read_pattern_of(in, draft)
        || read_modifier(in, draft) || read_map(in, draft) || read_other(in, draft))
      continue;
    if (skip_rest_if_unsupported(in)) {
      rejected = true;
      break;
    }
    ask_for_patterns(in);
    reject(in, fmt::format("a {} item", words.block));
    draft.wrong = true;
  }
  pigment.span = span;
  pigment.pattern = draft.store();
  if (draft.instance && draft.instance->pattern->has_colours()) pigment.entries.clear();
  if (draft.instance)
    settle_values(draft.instance->pattern->averages(), pigment.entries, in,
                  [](auto const& entry) { return entry.pigment->span; });
  if (draft.instance && pigment.entries.empty() && !draft.instance->pattern->has_colours()) {
    set_default_entries(pigment, *draft.instance->pattern, 0);
    pigment.default_entries = true;
  }
  if (!draft.instance && !pigment.entries.empty()) {
    if (!rejected)
      in.report(Severity::Error, "E0250",
                fmt::format("this {} has a map but no pattern", words.block), span);
    pigment.entries.clear();
  }
}

void transform_pigment(Pigment& pigment, geometry::Transform const& transform) {
  transform_pattern(pigment.pattern, transform);
}

} // namespace abbe::lang
