// SPDX-License-Identifier: MIT
#include "lang/blocks.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace abbe::lang {

namespace {

using scene::EffectOverride;
using scene::Switch;

/// `auto` takes back what was said before; the last word about an effect counts.
void read_state(Reader& in, Switch effect, Span at, scene::EffectSettings& effects) {
  Span const state = in.next_span();
  std::erase_if(effects.overrides,
                [&](EffectOverride const& known) { return known.effect == effect; });
  if (in.accept("auto")) return;
  bool const on = in.boolean_or(true);
  if (on && effect != Switch::Spectral) {
    in.report(Severity::Error, "E0252",
              fmt::format("'{}' cannot be forced on: it is carried out where the scene calls for "
                          "it; expected 'off' or 'auto'",
                          scene::switch_words[static_cast<std::size_t>(effect)]),
              state);
    return;
  }
  effects.overrides.push_back({effect, on, at});
}

} // namespace

void read_effects(Reader& in, scene::EffectSettings& effects) {
  while (!in.at_end()) {
    Span const at = in.next_span();
    if (in.accept("strict")) {
      effects.strict = true;
      effects.strict_span = at;
      continue;
    }
    bool known = false;
    for (std::size_t i = 0; i < scene::switch_words.size() && !known; ++i) {
      known = in.accept(scene::switch_words[i]);
      if (known) read_state(in, static_cast<Switch>(i), at, effects);
    }
    if (!known) reject(in, "an effect");
  }
}

} // namespace abbe::lang
