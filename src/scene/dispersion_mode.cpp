// SPDX-License-Identifier: MIT
#include "scene/dispersion_mode.hpp"

#include <fmt/format.h>

namespace abbe::scene {
namespace {

std::string text(optics::Comb const& comb) {
  using Follow = optics::Comb::Follow;
  std::string out = comb.follow == Follow::Hero ? fmt::format("hero {}", comb.teeth)
                    : comb.follow == Follow::Importance
                        ? fmt::format("clusters {} degrade", comb.teeth)
                        : "stochastic";
  if (comb.follow == Follow::Doubled) out += " fanout 2";
  if (comb.follow == Follow::Every && comb.teeth > 0) out += fmt::format(" rays {}", comb.teeth);
  return out
         + fmt::format(" jitter {} {}", optics::jitter_words[static_cast<std::size_t>(comb.jitter)],
                       comb.width);
}

} // namespace

std::string text(DispersionMode const& mode) {
  switch (mode.kind) {
  case DispersionMode::Kind::Inherit:
    return "inherit";
  case DispersionMode::Kind::None:
    return "none";
  case DispersionMode::Kind::Deterministic:
    return "deterministic";
  case DispersionMode::Kind::Adaptive:
    return fmt::format("adaptive tolerance {}", mode.tolerance_px);
  case DispersionMode::Kind::Stochastic:
    break;
  }
  return text(mode.comb);
}

} // namespace abbe::scene
