// SPDX-License-Identifier: MIT
#include "lang/not_rendered.hpp"

#include "lang/blocks.hpp"

#include <fmt/format.h>

#include <span>

namespace abbe::lang {

void note_not_rendered(Reader& in, std::string_view word, Span at) {
  in.report(Severity::Warning, "E0903",
            fmt::format("'{}' is not rendered yet: the picture is made without it", word), at);
}

namespace {

/// A word and the values that must or may stand behind it.
struct Item {
  std::string_view word;
  int numbers = 1;  ///< that must
  int optional = 0; ///< further ones that may
};
/// An Item that is on or off.
constexpr int boolean = -1;

bool read_item(Reader& in, std::span<Item const> items) {
  for (Item const& item : items) {
    if (!in.accept(item.word)) continue;
    if (item.numbers == boolean) in.boolean_or(true);
    for (int i = 0; i < item.numbers; ++i) in.number(item.word);
    for (int i = 0; i < item.optional && in.has_value(); ++i) in.number(item.word);
    return true;
  }
  return false;
}

void read_items(Reader& in, std::span<Item const> items, std::string_view what) {
  while (!in.at_end())
    if (!read_item(in, items)) reject(in, what);
}

constexpr Item radiosity_items[] = {{"adc_bailout"},        {"always_sample", boolean},
                                    {"brightness"},         {"count", 1, 1},
                                    {"error_bound"},        {"gray_threshold"},
                                    {"low_error_factor"},   {"max_sample"},
                                    {"maximum_reuse"},      {"media", boolean},
                                    {"minimum_reuse"},      {"nearest_count", 1, 1},
                                    {"normal", boolean},    {"pretrace_end"},
                                    {"pretrace_start"},     {"recursion_limit"},
                                    {"subsurface", boolean}};
constexpr Item subsurface_items[] = {{"radiosity", boolean}, {"samples", 2}};

} // namespace

bool read_global_light(Reader& in, scene::Settings& settings) {
  if (read_global_thrown(in, settings)) return true;
  Span const at = in.next_span();
  std::string_view word;
  if (in.open("radiosity")) {
    word = "radiosity";
    read_items(in, radiosity_items, "an item of radiosity");
  } else if (in.open("subsurface")) {
    word = "subsurface";
    read_items(in, subsurface_items, "'samples' or 'radiosity'");
  } else {
    return false;
  }
  in.close();
  note_not_rendered(in, word, at);
  return true;
}

bool read_importance(Reader& in) {
  if (!in.open("radiosity")) return false;
  while (!in.at_end())
    if (in.accept("importance"))
      in.number("importance");
    else
      reject(in, "'importance'");
  in.close();
  return true;
}

bool read_object_light(Reader& in, scene::Object& object) {
  return read_object_thrown(in, object.throws) || read_importance(in);
}

bool read_subsurface(Reader& in) {
  if (!in.open("subsurface")) return false;
  while (!in.at_end())
    if (in.accept("translucency"))
      read_rgb(in, "translucency");
    else if (in.accept("anisotropy"))
      read_rgb(in, "anisotropy");
    else
      reject(in, "'translucency' or 'anisotropy'");
  in.close();
  return true;
}

} // namespace abbe::lang
