// SPDX-License-Identifier: MIT
#include "plan/survey.hpp"

#include "geometry/shape.hpp"
#include "plan/contact.hpp"
#include "plan/dispersion.hpp"
#include "plan/reach.hpp"

#include <algorithm>
#include <set>

namespace abbe::plan {
namespace {

using scene::Switch;

bool lets_light_pass(scene::Pigment const& pigment) {
  if (pigment.pattern && pigment.pattern->pattern->has_colours())
    return pigment.pattern->pattern->lets_light_pass();
  if (pigment.pattern)
    return std::any_of(pigment.entries.begin(), pigment.entries.end(),
                       [](auto const& entry) { return lets_light_pass(*entry.pigment); });
  return pigment.colour.filter != 0 || pigment.colour.transmit != 0;
}

/// Is it true of a texture, or of one of those that it is made of?
template <class Is>
bool any_texture(scene::Layers const& layers, Is const& is) {
  return std::any_of(layers.begin(), layers.end(), [&](scene::Texture const& texture) {
    if (!texture.map) return is(texture);
    return std::any_of(texture.map->entries.begin(), texture.map->entries.end(),
                       [&](auto const& entry) { return any_texture(entry.layers, is); });
  });
}

/// May the camera stand in the object?
bool may_hold(scene::Object const& object, Vec3 const& camera) {
  if (object.inverse || !object.clipped_by.empty()) return true;
  if (object.shape) {
    geometry::Transform const to_shape = object.placement;
    if (!object.shape->solid()
        || object.shape->inside(to_shape.inverse_linear * camera + to_shape.inverse_offset))
      return true;
  }
  return std::any_of(object.children.begin(), object.children.end(),
                     [&](scene::Object const& child) { return may_hold(child, camera); });
}

/// No ray meets it, nor begins in it: camera, reflected and shadow rays all pass it by.
bool unseen(scene::Object const& object, Vec3 const& camera) {
  if (object.shape)
    return object.no_image.value_or(false) && object.no_reflection.value_or(false)
           && object.no_shadow.value_or(false) && !may_hold(object, camera);
  return !object.inverse && !object.instance && object.clipped_by.empty()
         && std::all_of(object.children.begin(), object.children.end(),
                        [&](scene::Object const& child) { return unseen(child, camera); });
}

/// Can a ray get into the object, or ask for its index?
bool reachable(scene::Object const& object, Vec3 const& camera) {
  auto const opens = [](scene::Layers const& layers) {
    return any_texture(layers, [](scene::Texture const& texture) {
      return lets_light_pass(texture.pigment)
             || (texture.finish->reflection && texture.finish->reflection->fresnel);
    });
  };
  if (may_hold(object, camera)) return true;
  if (object.interior && object.interior->glass) return true; // reflects by Fresnel unasked
  if (object.texture && opens(*object.texture)) return true;
  if (object.interior_texture && opens(*object.interior_texture)) return true;
  if (std::any_of(object.face_textures.begin(), object.face_textures.end(), opens)) return true;
  return std::any_of(object.children.begin(), object.children.end(),
                     [&](scene::Object const& child) { return reachable(child, camera); });
}

class Surveyor {
public:
  Surveyor(scene::Scene const& scene, Choices const& choices) : scene_(scene), choices_(choices) {}

  Survey run() {
    auto const& spectral = scene_.settings.spectral;
    if (spectral.requested) find(Effect::SpectralTransport, "a spectral block", spectral.span);
    if (choices_.forces_bands())
      find(Effect::SpectralTransport, choices_.why_bands(), choices_.why_bands_span());
    for (auto const& light : scene_.lights) {
      colour(light.colour, light.span);
      if (light.area) find(Effect::AreaLights, "area_light", light.span);
      if (light.group != 0) find(Effect::LightGroups, "a light in a light_group", light.span);
    }
    for (auto const& fog : scene_.fogs) {
      find(Effect::Air, "fog", fog.span);
      colour(fog.colour, fog.span);
    }
    for (auto const& rainbow : scene_.rainbows) {
      find(Effect::Air, "a rainbow", rainbow.span);
      for (auto const& entry : rainbow.entries) colour(entry.colour, rainbow.span);
    }
    colour(scene_.background, {});
    colour(scene_.settings.ambient_light, {});
    if (scene_.sky_sphere)
      for (auto const& pigment : scene_.sky_sphere->pigments) this->pigment(pigment, false);
    Reach const reach(scene_);
    std::vector<std::size_t> never;
    for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
      scene::Object const& object = scene_.objects[i];
      if (unseen(object, scene_.camera.location))
        never.push_back(i);
      else if (calls_for_more(object) && reach.apart(object))
        out_.out_of_reach.push_back(i);
      else
        whole_object(object);
    }
    if (!has(Effect::Reflection) && !has(Effect::Refraction)) {
      out_.out_of_reach.insert(out_.out_of_reach.end(), never.begin(), never.end());
      std::sort(out_.out_of_reach.begin(), out_.out_of_reach.end());
      return std::move(out_);
    }
    // Rays go anywhere.
    for (std::size_t const i : out_.out_of_reach) whole_object(scene_.objects[i]);
    out_.out_of_reach = std::move(never);
    find_caustics();
    if (has(Effect::Refraction))
      if (auto const contact = find_contact(scene_))
        find(Effect::ContactOfMedia, contact->reason, contact->span);
    return std::move(out_);
  }

private:
  bool has(Effect effect) const { return out_.findings[static_cast<std::size_t>(effect)].on; }

  /// Does the object have what would cost elsewhere too: an inside, a mirror, clear places?
  static bool calls_for_more(scene::Object const& object) {
    auto const more = [](scene::Layers const& layers) {
      return any_texture(layers, [](scene::Texture const& texture) {
        return texture.finish->reflection || lets_light_pass(texture.pigment);
      });
    };
    return object.interior || (object.texture && more(*object.texture))
           || std::any_of(object.children.begin(), object.children.end(), calls_for_more);
  }

  /// A lamp whose light can be followed, what throws it, and what shows it.
  void find_caustics() {
    if (!caster_ || !receives_) return;
    for (scene::Light const& light : scene_.lights)
      if ((!light.area || scene_.settings.thrown.photons) && !light.shadowless
          && !light.projected_through)
        return find(Effect::Caustics, caster_->reason + " in the light of a lamp", caster_->span);
  }

  void note_caster(std::string reason, Span span) {
    if (!caster_) caster_ = Finding{true, std::move(reason), span, {}, {}};
  }

  void whole_object(scene::Object const& object) {
    // Asked once an object of the scene: inside and outside belong to the whole.
    has_way_in_ = object_has_interior(object) && reachable(object, scene_.camera.location);
    this->object(object);
  }

  void find(Effect effect, std::string reason, Span span) {
    if (auto const by = switch_of(effect); by && choices_.off(*by)) return;
    Finding& finding = out_.findings[static_cast<std::size_t>(effect)];
    if (!finding.on) finding = {true, std::move(reason), span, {}, {}};
  }

  void needs_bands(std::string reason, Span span) {
    find(Effect::SpectralTransport, reason, span);
    if (!out_.needs_bands.on) out_.needs_bands = {true, std::move(reason), span, {}, {}};
  }

  void colour(scene::Colour const& colour, Span span) {
    if (colour.spectrum) needs_bands("a spectrum", span);
  }

  void pigment(scene::Pigment const& pigment, bool of_surface) {
    if (pigment.pattern) {
      find(Effect::Patterns, "a patterned pigment", pigment.span);
      if (of_surface && pigment.pattern->pattern->lets_light_pass())
        find(Effect::FilteringShadows, "a pigment that lets light pass", pigment.span);
      for (auto const& entry : pigment.entries)
        if (seen_.insert(entry.pigment.get()).second) this->pigment(*entry.pigment, of_surface);
      return;
    }
    colour(pigment.colour, pigment.span);
    if (of_surface && (pigment.colour.filter != 0 || pigment.colour.transmit != 0))
      find(Effect::FilteringShadows, "a pigment that lets light pass", pigment.span);
  }

  void texture(scene::Texture const& texture) {
    if (texture.map) {
      find(Effect::Patterns, "a patterned texture", texture.span);
      for (auto const& entry : texture.map->entries) layers(entry.layers);
      return;
    }
    pigment(texture.pigment, true);
    if (texture.normal) find(Effect::Patterns, "a normal", texture.normal->span);
    scene::Finish const& finish = *texture.finish;
    receives_ = receives_ || finish.diffuse != 0 || finish.phong != 0 || finish.specular != 0;
    colour(finish.ambient, texture.span);
    colour(finish.emission, texture.span);
    if (!finish.reflection || choices_.off(Switch::Reflection)) return;
    find(Effect::Reflection, "finish { reflection }", texture.span);
    colour(finish.reflection->minimum, texture.span);
    colour(finish.reflection->maximum, texture.span);
    if (finish.reflection->metal) needs_bands("a metal by n and k", texture.span);
  }

  void layers(scene::Layers const& layers) {
    for (auto const& texture : layers) this->texture(texture);
    if (layers.size() > 1) find(Effect::LayeredTextures, "a layered texture", layers.front().span);
  }

  void interior(scene::Interior const& interior) {
    if (!seen_.insert(&interior).second) return;
    Span const span = interior.span;
    if (interior.fade_distance != 0) find(Effect::DistanceFade, "fade_distance", span);
    auto const glass = dispersive_glass(interior);
    if (glass && glass->absorbs() && !choices_.off(Switch::Absorption)) {
      find(Effect::Absorption, "internal absorption of " + glass->full_name(), span);
      find(Effect::SpectralTransport, "internal absorption of " + glass->full_name(), span);
    }
    if (choices_.off(Switch::Refraction)) return;
    if (glass || plain_index(interior) != 1)
      find(Effect::Refraction, glass ? "glass " + glass->full_name() : "ior", span);
    if (!glass) return;
    if (interior.glass) find(Effect::Reflection, "Fresnel reflection of glass", span);
    auto const mode = effective_mode(interior, scene_.settings, choices_.dispersion());
    auto const& range = scene_.settings.spectral;
    if (mode.kind == scene::DispersionMode::Kind::None
        || !glass->is_dispersive(range.low_nm, range.high_nm))
      return;
    std::string const reason = glass->full_name() + " disperses";
    using Kind = scene::DispersionMode::Kind;
    std::string const with_mode = reason + ", dispersion { " + scene::text(mode) + " }";
    find(Effect::Dispersion, mode.kind == Kind::Adaptive ? with_mode : reason, span);
    find(Effect::SpectralTransport, reason, span);
    if (mode.kind == Kind::Stochastic) find(Effect::StochasticDispersion, with_mode, span);
  }

  static bool object_has_interior(scene::Object const& object) {
    return object.interior
           || std::any_of(object.children.begin(), object.children.end(), object_has_interior);
  }

  /// Does it throw light, and why?
  void note_casters(scene::Object const& object) {
    using scene::Choice;
    if (object.kind != scene::Object::Kind::Shape || object.throws.cast == Choice::Off) return;
    auto const metal = [](scene::Texture const& texture) {
      return texture.finish->reflection && texture.finish->reflection->metal;
    };
    bool const photons = scene_.settings.thrown.photons, caustics = scene_.settings.thrown.caustics;
    if (caustics && object.interior && object.interior->glass && has_way_in_
        && !choices_.off(Switch::Refraction))
      note_caster("glass " + object.interior->glass->full_name(), object.interior->span);
    else if (caustics && object.texture && any_texture(*object.texture, metal)
             && !choices_.off(Switch::Reflection))
      note_caster("a mirror of metal", object.span);
    else if (caustics && object.throws.cast == Choice::On)
      note_caster("caustics { cast on }", object.span);
    else if (photons && object.throws.target)
      note_caster("photons { target }", object.span);
  }

  void object(scene::Object const& object) {
    using Kind = scene::Object::Kind;
    note_casters(object);
    if (object.kind == Kind::Intersection || object.kind == Kind::Difference
        || object.kind == Kind::Merge || !object.clipped_by.empty())
      find(Effect::Csg, "a boolean operation", object.span);
    if (object.texture) layers(*object.texture);
    if (object.interior_texture) layers(*object.interior_texture);
    for (auto const& face : object.face_textures) layers(face);
    if (object.interior && has_way_in_) interior(*object.interior);
    for (auto const& child : object.children) this->object(child);
    if (object.instance && seen_.insert(object.instance.get()).second)
      this->object(*object.instance);
  }

  scene::Scene const& scene_;
  Choices const& choices_;
  Survey out_;
  bool has_way_in_ = false;
  std::optional<Finding> caster_; ///< the first that throws light
  bool receives_ = false;         ///< some surface shows light of lamps
  std::set<void const*> seen_;
};

} // namespace

std::optional<Switch> switch_of(Effect effect) {
  switch (effect) {
  case Effect::SpectralTransport:
    return Switch::Spectral;
  case Effect::Reflection:
    return Switch::Reflection;
  case Effect::Refraction:
    return Switch::Refraction;
  case Effect::Dispersion:
  case Effect::StochasticDispersion:
    return Switch::Dispersion;
  case Effect::Absorption:
    return Switch::Absorption;
  case Effect::DistanceFade:
    return Switch::DistanceFade;
  case Effect::FilteringShadows:
    return Switch::FilteringShadows;
  case Effect::Caustics:
    return Switch::Caustics;
  default:
    return std::nullopt;
  }
}

Choices::Choices(scene::EffectSettings const& settings, Overrides const& overrides)
    : dispersion_(overrides.dispersion) {
  bool const asked = overrides.spectral || overrides.bands.has_value();
  auto const set = [&](scene::EffectOverride const& given) {
    if (given.effect == Switch::Spectral && asked) return;
    if (given.effect == Switch::Dispersion && overrides.dispersion) return;
    if (given.effect == Switch::Spectral) forces_bands_ = given.on;
    if (given.on) {
      why_bands_ = "effects { spectral on }";
      why_bands_span_ = given.span;
    }
    off_[static_cast<std::size_t>(given.effect)] = !given.on;
  };
  for (auto const& given : settings.overrides) set(given);
  for (auto const& given : overrides.effects) set(given);
  if (asked) {
    forces_bands_ = true;
    why_bands_ = overrides.spectral ? "--spectral" : "--bands";
    why_bands_span_ = {};
  }
  // What needs bands goes with them.
  for (auto const with : {Switch::Dispersion, Switch::Absorption})
    if (off(Switch::Spectral)) off_[static_cast<std::size_t>(with)] = true;
  if (!off(Switch::Dispersion)) return;
  dispersion_ = scene::DispersionMode{};
  dispersion_->kind = scene::DispersionMode::Kind::None;
}

bool Choices::any() const {
  return forces_bands_ || dispersion_
         || std::any_of(std::begin(off_), std::end(off_), [](bool off) { return off; });
}

Survey survey(scene::Scene const& scene, Choices const& choices) {
  return Surveyor(scene, choices).run();
}

} // namespace abbe::plan
