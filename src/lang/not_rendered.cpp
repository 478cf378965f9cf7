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
constexpr Item photon_items[] = {
    {"adc_bailout"}, {"autostop"},        {"count"},       {"expand_thresholds", 2}, {"gather", 2},
    {"jitter"},      {"max_trace_level"}, {"media", 1, 1}, {"radius", 0, 4},         {"spacing"}};
constexpr Item object_photon_items[] = {{"collect", boolean},
                                        {"pass_through", boolean},
                                        {"reflection", boolean},
                                        {"refraction", boolean},
                                        {"target", 0, 1}};
constexpr Item light_photon_items[] = {
    {"area_light", boolean}, {"reflection", boolean}, {"refraction", boolean}};
constexpr Item subsurface_items[] = {{"radiosity", boolean}, {"samples", 2}};

void read_photon_items(Reader& in) {
  while (!in.at_end()) {
    Span const at = in.next_span();
    if (in.accept("save_file")) {
      in.path("save_file");
      in.report(Severity::Error, "E0901", "'save_file' in photons is not supported yet", at);
    } else if (in.accept("load_file")) {
      in.path("load_file");
    } else if (!read_item(in, photon_items)) {
      reject(in, "an item of photons");
    }
  }
}

} // namespace

bool read_global_light(Reader& in) {
  Span const at = in.next_span();
  std::string_view word;
  if (in.open("radiosity")) {
    word = "radiosity";
    read_items(in, radiosity_items, "an item of radiosity");
  } else if (in.open("photons")) {
    word = "photons";
    read_photon_items(in);
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

bool read_object_light(Reader& in) {
  if (!in.open("photons")) return read_importance(in);
  read_items(in, object_photon_items, "an item of an object's photons");
  in.close();
  return true;
}

bool read_light_photons(Reader& in) {
  if (!in.open("photons")) return false;
  read_items(in, light_photon_items, "an item of a light's photons");
  in.close();
  return true;
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
