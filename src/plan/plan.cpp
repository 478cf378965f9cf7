// SPDX-License-Identifier: MIT
#include "plan/plan.hpp"

#include "plan/representation.hpp"
#include "plan/survey.hpp"

#include <fmt/format.h>
#include <utility>

namespace abbe::plan {
namespace {

Result<optics::Bands> make_bands(scene::SpectralSettings const& settings,
                                 Overrides const& overrides) {
  int const count = overrides.bands.value_or(settings.bands);
  switch (overrides.spacing.value_or(settings.spacing)) {
  case scene::SpectralSettings::Spacing::Uniform:
    return optics::Bands::uniform(count, settings.low_nm, settings.high_nm);
  case scene::SpectralSettings::Spacing::Hall:
    return optics::Bands::hall(count, settings.low_nm, settings.high_nm);
  case scene::SpectralSettings::Spacing::Boundaries:
    if (overrides.bands)
      return Error{"E0416",
                   "--bands cannot be given for a scene that sets the boundaries of its bands"};
    return optics::Bands::from_edges(settings.boundaries_nm);
  }
  return Error{"E0416", "unknown spacing"};
}

/// "  (file:line:column)", or nothing.
std::string place(Span const& span) {
  if (!span.valid()) return "";
  auto const at = span.source->place(span.begin);
  return fmt::format("  ({}:{}:{})", span.source->name(), at.line, at.column);
}

/// What makes an effect different from what the scene asks for.
std::pair<std::string, Span> who_overrides(Effect effect, scene::EffectSettings const& settings,
                                           Overrides const& overrides, Choices const& choices) {
  using scene::Switch;
  if (effect == Effect::SpectralTransport && choices.forces_bands())
    return {choices.why_bands(), choices.why_bands_span()};
  auto const disperses = effect == Effect::Dispersion || effect == Effect::StochasticDispersion;
  if (disperses && overrides.dispersion) return {"--dispersion", {}};
  // By its own switch, else by that of an effect that it depends on.
  std::vector<Switch> by;
  if (auto const own = switch_of(effect)) by.push_back(*own);
  for (Switch const each :
       {Switch::Refraction, Switch::Spectral, Switch::Dispersion, Switch::Absorption})
    by.push_back(each);
  for (Switch const each : by)
    for (auto const* list : {&overrides.effects, &settings.overrides})
      for (auto const& given : *list)
        if (given.effect == each)
          return {fmt::format("effects {{ {} {} }}",
                              scene::switch_words[static_cast<std::size_t>(each)],
                              given.on ? "on" : "off"),
                  given.span};
  return {"--dispersion", {}}; // without dispersion nothing calls for bands
}

} // namespace

std::string_view effect_name(Effect effect) {
  switch (effect) {
  case Effect::SpectralTransport:
    return "spectral transport";
  case Effect::Reflection:
    return "reflection";
  case Effect::Refraction:
    return "refraction";
  case Effect::ContactOfMedia:
    return "contact of media";
  case Effect::Dispersion:
    return "dispersion";
  case Effect::StochasticDispersion:
    return "stochastic dispersion";
  case Effect::Absorption:
    return "absorption";
  case Effect::DistanceFade:
    return "distance fade";
  case Effect::FilteringShadows:
    return "filtering shadows";
  case Effect::LayeredTextures:
    return "layered textures";
  case Effect::Patterns:
    return "patterns";
  case Effect::Csg:
    return "csg";
  case Effect::AreaLights:
    return "area lights";
  case Effect::LightGroups:
    return "light groups";
  case Effect::Air:
    return "fog and rainbows";
  case Effect::Caustics:
    return "caustics";
  }
  return "";
}

Result<Plan> make_plan(scene::Scene const& scene, Overrides const& overrides) {
  scene::EffectSettings const& settings = scene.settings.effects;
  Choices const choices(settings, overrides);
  Survey asked = survey(scene, {});
  Survey made = choices.any() ? survey(scene, choices) : asked;
  if (choices.off(scene::Switch::Spectral) && made.needs_bands.on)
    return Error{"E0430", fmt::format("spectral transport cannot be off: the scene has {}{}",
                                      made.needs_bands.reason, place(made.needs_bands.span))};
  Plan plan;
  plan.out_of_reach = std::move(made.out_of_reach);
  plan.dispersion_override = choices.dispersion();
  for (int i = 0; i < effect_count; ++i) {
    Finding& finding = plan.findings[static_cast<std::size_t>(i)];
    Finding& as_asked = asked.findings[static_cast<std::size_t>(i)];
    finding = std::move(made.findings[static_cast<std::size_t>(i)]);
    if (finding.on == as_asked.on) continue;
    auto const effect = static_cast<Effect>(i);
    auto const [by, span] = who_overrides(effect, settings, overrides, choices);
    if (settings.strict && !overrides.lenient)
      return Error{"E0431", fmt::format("effects strict: {} turns {} {}, {}", by,
                                        effect_name(effect), finding.on ? "on" : "off",
                                        as_asked.on ? "which the scene asks for: " + as_asked.reason
                                                          + place(as_asked.span)
                                                    : "which the scene does not ask for")};
    if (!finding.on) {
      finding = std::move(as_asked);
      finding.on = false;
    }
    finding.overridden = by;
    finding.overridden_at = span;
  }
  for (std::size_t i = 0; i < scene::switch_words.size(); ++i)
    plan.off[i] = choices.off(static_cast<scene::Switch>(i));
  if (plan.has(Effect::SpectralTransport)) {
    auto bands = make_bands(scene.settings.spectral, overrides);
    if (!bands) return bands.error();
    auto channels = make_channels(
        scene, overrides.representation.value_or(scene.settings.spectral.representation), *bands,
        plan.has(Effect::Dispersion), plan.has(Effect::StochasticDispersion));
    if (!channels) return channels.error();
    if (overrides.spectral && channels->is_basis())
      return Error{"E0432", "--spectral writes bands, and a basis has none"};
    plan.spectral = std::move(*channels);
  }
  return plan;
}

std::string describe(Plan const& plan) {
  std::string out = describe_transport(plan);
  for (int i = 0; i < effect_count; ++i) out += describe(plan, static_cast<Effect>(i)) + '\n';
  return out;
}

std::string describe_transport(Plan const& plan) {
  if (!plan.spectral) return "transport: r g b\n";
  optics::Bands const& range = plan.spectral->bands;
  return fmt::format("transport: {}, {:g} to {:g} nm\n", describe_channels(plan), range.lo_nm(),
                     range.hi_nm());
}

std::string describe_channels(Plan const& plan) {
  return plan.spectral ? describe(*plan.spectral) : "r g b";
}

std::string describe(Plan const& plan, Effect effect) {
  Finding const& finding = plan.findings[static_cast<std::size_t>(effect)];
  std::string out = fmt::format("{:22} {}", effect_name(effect), finding.on ? "on " : "off");
  if (finding.on) out += "  " + finding.reason + place(finding.span);
  if (finding.overridden.empty()) return out;
  out += fmt::format("  by {}{}", finding.overridden, place(finding.overridden_at));
  if (!finding.on) out += "; asked for by " + finding.reason + place(finding.span);
  return out;
}

} // namespace abbe::plan
