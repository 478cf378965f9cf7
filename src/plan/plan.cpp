// SPDX-License-Identifier: MIT
#include "plan/plan.hpp"

#include "plan/contact.hpp"
#include "plan/dispersion.hpp"

#include <fmt/format.h>
#include <set>

namespace abbe::plan {
namespace {

/// Walks the scene and notes the first place that calls for each effect.
class Survey {
public:
  Survey(scene::Scene const& scene, Overrides const& overrides, Plan& plan)
      : scene_(scene), overrides_(overrides), plan_(plan) {}

  void run() {
    auto const& spectral = scene_.settings.spectral;
    if (spectral.requested) find(Effect::SpectralTransport, "a spectral block", spectral.span);
    if (overrides_.spectral) find(Effect::SpectralTransport, "--spectral", {});
    if (overrides_.bands) find(Effect::SpectralTransport, "--bands", {});
    for (auto const& light : scene_.lights) colour(light.colour, light.span);
    colour(scene_.background, {});
    colour(scene_.settings.ambient_light, {});
    if (scene_.sky_sphere)
      for (auto const& pigment : scene_.sky_sphere->pigments) this->pigment(pigment, false);
    for (auto const& object : scene_.objects) this->object(object);
    if (plan_.has(Effect::Refraction))
      if (auto const contact = find_contact(scene_))
        find(Effect::ContactOfMedia, contact->reason, contact->span);
  }

private:
  void find(Effect effect, std::string reason, Span span) {
    Finding& finding = plan_.findings[static_cast<std::size_t>(effect)];
    if (!finding.on) finding = {true, std::move(reason), span};
  }

  void colour(scene::Colour const& colour, Span span) {
    if (colour.spectrum) find(Effect::SpectralTransport, "a spectrum", span);
  }

  void pigment(scene::Pigment const& pigment, bool of_surface) {
    if (pigment.pattern) {
      find(Effect::Patterns, "a patterned pigment", pigment.span);
      for (auto const& entry : pigment.entries)
        if (seen_.insert(entry.pigment.get()).second) this->pigment(*entry.pigment, of_surface);
      return;
    }
    colour(pigment.colour, pigment.span);
    if (of_surface && (pigment.colour.filter != 0 || pigment.colour.transmit != 0))
      find(Effect::FilteringShadows, "a pigment that lets light pass", pigment.span);
  }

  void texture(scene::Texture const& texture) {
    pigment(texture.pigment, true);
    scene::Finish const& finish = texture.finish;
    colour(finish.ambient, texture.span);
    colour(finish.emission, texture.span);
    if (!finish.reflection) return;
    find(Effect::Reflection, "finish { reflection }", texture.span);
    colour(finish.reflection->minimum, texture.span);
    colour(finish.reflection->maximum, texture.span);
    if (finish.reflection->metal)
      find(Effect::SpectralTransport, "a metal by n and k", texture.span);
  }

  void layers(scene::Layers const& layers) {
    for (auto const& texture : layers) this->texture(texture);
    if (layers.size() > 1) find(Effect::LayeredTextures, "a layered texture", layers.front().span);
  }

  void interior(scene::Interior const& interior) {
    if (!seen_.insert(&interior).second) return;
    Span const span = interior.span;
    if (interior.fade_power != 0 && interior.fade_distance != 0)
      find(Effect::DistanceFade, "fade_distance and fade_power", span);
    auto const glass = dispersive_glass(interior);
    if (glass || plain_index(interior) != 1)
      find(Effect::Refraction, glass ? "glass " + glass->full_name() : "ior", span);
    if (!glass) return;
    if (interior.glass) find(Effect::Reflection, "Fresnel reflection of glass", span);
    if (glass->absorbs()) {
      find(Effect::Absorption, "internal absorption of " + glass->full_name(), span);
      find(Effect::SpectralTransport, "internal absorption of " + glass->full_name(), span);
    }
    auto const mode = effective_mode(interior, scene_.settings, overrides_.dispersion);
    auto const& range = scene_.settings.spectral;
    if (mode.kind == scene::DispersionMode::Kind::None
        || !glass->is_dispersive(range.low_nm, range.high_nm))
      return;
    std::string const reason = glass->full_name() + " disperses";
    find(Effect::Dispersion, reason, span);
    find(Effect::SpectralTransport, reason, span);
    if (mode.kind == scene::DispersionMode::Kind::Stochastic)
      find(Effect::StochasticDispersion, reason + ", dispersion { stochastic }", span);
  }

  void object(scene::Object const& object) {
    using Kind = scene::Object::Kind;
    if (object.kind == Kind::Intersection || object.kind == Kind::Difference
        || object.kind == Kind::Merge || !object.clipped_by.empty())
      find(Effect::Csg, "a boolean operation", object.span);
    if (object.texture) layers(*object.texture);
    if (object.interior_texture) layers(*object.interior_texture);
    for (auto const& face : object.face_textures) layers(face);
    if (object.interior) interior(*object.interior);
    for (auto const& child : object.children) this->object(child);
  }

  scene::Scene const& scene_;
  Overrides const& overrides_;
  Plan& plan_;
  std::set<void const*> seen_;
};

Result<optics::Bands> make_bands(scene::SpectralSettings const& settings,
                                 std::optional<int> override_count) {
  int const count = override_count.value_or(settings.bands);
  switch (settings.spacing) {
  case scene::SpectralSettings::Spacing::Uniform:
    return optics::Bands::uniform(count, settings.low_nm, settings.high_nm);
  case scene::SpectralSettings::Spacing::Hall:
    return optics::Bands::hall(count, settings.low_nm, settings.high_nm);
  case scene::SpectralSettings::Spacing::Boundaries:
    if (override_count)
      return Error{"E0416",
                   "--bands cannot be given for a scene that sets the boundaries of its bands"};
    return optics::Bands::from_edges(settings.boundaries_nm);
  }
  return Error{"E0416", "unknown spacing"};
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
  }
  return "";
}

Result<Plan> make_plan(scene::Scene const& scene, Overrides const& overrides) {
  Plan plan;
  plan.dispersion_override = overrides.dispersion;
  Survey(scene, overrides, plan).run();
  if (plan.has(Effect::SpectralTransport)) {
    auto bands = make_bands(scene.settings.spectral, overrides.bands);
    if (!bands) return bands.error();
    plan.bands = std::move(*bands);
  }
  return plan;
}

std::string describe(Plan const& plan) {
  std::string out = plan.bands
                        ? fmt::format("transport: {} bands, {:g} to {:g} nm\n", plan.bands->count(),
                                      plan.bands->lo_nm(), plan.bands->hi_nm())
                        : "transport: r g b\n";
  for (int i = 0; i < effect_count; ++i) {
    Finding const& finding = plan.findings[static_cast<std::size_t>(i)];
    out += fmt::format("{:22} {}", effect_name(static_cast<Effect>(i)), finding.on ? "on " : "off");
    if (finding.on) out += "  " + finding.reason;
    if (finding.span.valid()) {
      auto const place = finding.span.source->place(finding.span.begin);
      out += fmt::format("  ({}:{}:{})", finding.span.source->name(), place.line, place.column);
    }
    out += '\n';
  }
  return out;
}

} // namespace abbe::plan
