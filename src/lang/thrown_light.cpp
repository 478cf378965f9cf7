// SPDX-License-Identifier: MIT
#include "lang/blocks.hpp"
#include "lang/not_rendered.hpp"

#include <fmt/format.h>

namespace abbe::lang {

namespace {

using scene::Choice;

Choice read_choice(Reader& in) {
  return in.boolean_or(true) ? Choice::On : Choice::Off;
}

/// Items that tell POV-Ray how many photons to send and how to look for them: there are none here.
bool read_photon_count(Reader& in, bool& told) {
  struct Item {
    std::string_view word;
    int numbers, optional;
  };
  static constexpr Item items[] = {
      {"autostop", 1, 0}, {"count", 1, 0},  {"expand_thresholds", 2, 0},
      {"gather", 2, 0},   {"jitter", 1, 0}, {"radius", 0, 4},
      {"spacing", 1, 0}};
  Span const at = in.next_span();
  for (Item const& item : items) {
    if (!in.accept(item.word)) continue;
    for (int i = 0; i < item.numbers; ++i) in.number(item.word);
    for (int i = 0; i < item.optional && in.has_value(); ++i) in.number(item.word);
    if (!std::exchange(told, true))
      in.report(Severity::Warning, "E0904",
                fmt::format("'{}' has no effect: thrown light is found exactly, without photons; "
                            "what may be missing of it is set by caustics {{ error }}",
                            item.word),
                at);
    return true;
  }
  return false;
}

/// What both blocks have.
bool read_limit(Reader& in, scene::ThrownLight& thrown) {
  if (in.accept("max_trace_level"))
    thrown.max_trace_level = in.integer("max_trace_level", 1, 256);
  else if (in.accept("adc_bailout"))
    thrown.adc_bailout = in.number("adc_bailout");
  else
    return false;
  return true;
}

void read_photons(Reader& in, scene::ThrownLight& thrown) {
  thrown.photons = true;
  bool told = false;
  while (!in.at_end()) {
    Span const at = in.next_span();
    if (in.accept("save_file")) {
      in.path("save_file");
      in.report(Severity::Error, "E0901", "'save_file' in photons is not supported: there are none",
                at);
    } else if (in.accept("load_file")) {
      in.path("load_file");
      in.report(Severity::Warning, "E0904",
                "'load_file' has no effect: thrown light is found exactly, without photons", at);
    } else if (in.accept("media")) {
      in.number("media");
      in.optional_number("media factor");
      note_not_rendered(in, "photons of media", at);
    } else if (!read_limit(in, thrown) && !read_photon_count(in, told)) {
      reject(in, "an item of photons");
    }
  }
}

void read_caustics(Reader& in, scene::Settings& settings) {
  settings.thrown.caustics = true;
  while (!in.at_end()) {
    Span const at = in.next_span();
    if (in.accept("off")) {
      settings.effects.overrides.push_back({scene::Switch::Caustics, false, at});
    } else if (in.accept("on")) {
      std::erase_if(settings.effects.overrides, [](scene::EffectOverride const& known) {
        return known.effect == scene::Switch::Caustics;
      });
    } else if (in.accept("evaluate")) {
      if (in.accept("exact"))
        settings.thrown.exact = true;
      else if (in.accept("interpolated"))
        settings.thrown.exact = false;
      else
        reject(in, "'exact' or 'interpolated'");
    } else if (in.accept("error")) {
      Span const value = in.next_span();
      double const error = in.number("error");
      if (error > 0 && error < 1)
        settings.thrown.error = error;
      else
        in.report(
            Severity::Error, "E0353",
            fmt::format("error is a share of the thrown light, above 0 and below 1, not {}", error),
            value);
    } else if (!read_limit(in, settings.thrown)) {
      reject(in, "an item of caustics");
    }
  }
}

} // namespace

bool read_global_thrown(Reader& in, scene::Settings& settings) {
  if (in.open("photons"))
    read_photons(in, settings.thrown);
  else if (in.open("caustics"))
    read_caustics(in, settings);
  else
    return false;
  in.close();
  return true;
}

bool read_object_thrown(Reader& in, scene::Throws& throws) {
  if (in.open("photons")) {
    while (!in.at_end())
      if (in.accept("target")) {
        throws.target = true;
        in.optional_number("target"); // a factor of POV-Ray's spacing
      } else if (in.accept("refraction")) {
        throws.refraction = read_choice(in);
      } else if (in.accept("reflection")) {
        throws.reflection = read_choice(in);
      } else if (in.accept("collect")) {
        throws.collect = in.boolean_or(true);
      } else if (in.accept("pass_through")) {
        throws.pass_through = in.boolean_or(true);
      } else {
        reject(in, "an item of an object's photons");
      }
  } else if (in.open("caustics")) {
    while (!in.at_end())
      if (in.accept("cast"))
        throws.cast = read_choice(in);
      else if (in.accept("receive"))
        throws.collect = in.boolean_or(true);
      else
        reject(in, "'cast' or 'receive'");
  } else {
    return false;
  }
  in.close();
  return true;
}

bool read_light_photons(Reader& in, scene::LampThrows& throws) {
  if (!in.open("photons")) return false;
  while (!in.at_end()) {
    Span const at = in.next_span();
    if (in.accept("refraction")) {
      throws.refraction = read_choice(in);
    } else if (in.accept("reflection")) {
      throws.reflection = read_choice(in);
    } else if (in.accept("area_light")) {
      if (in.boolean_or(true)) note_not_rendered(in, "photons of the places of an area_light", at);
    } else {
      reject(in, "an item of a light's photons");
    }
  }
  in.close();
  return true;
}

} // namespace abbe::lang
