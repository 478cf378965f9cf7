// SPDX-License-Identifier: MIT
#include "plan/quality.hpp"

#include "plan/materials.hpp"

#include <algorithm>

namespace abbe::plan {
namespace {

void make_plain(scene::Pigment& pigment, scene::Colour const& colour) {
  pigment.colour = colour;
  pigment.pattern.reset();
  pigment.entries.clear();
}

void make_opaque(scene::Pigment& pigment) {
  pigment.colour.filter = pigment.colour.transmit = 0;
}

/// What passes the surface is not followed: it shows what it gives back itself.
void hide_what_is_behind(scene::Pigment& pigment) {
  auto& colour = pigment.colour;
  colour.rgb *= std::clamp(1 - colour.filter - colour.transmit, 0.0, 1.0);
  colour.filter = colour.transmit = 0;
}

/// How much of the background an alpha channel leaves transparent, 0 to 1.
double transparency(scene::Scene const& scene) {
  if (!scene.has_background || scene.settings.version < 3.7) return 1;
  return scene.background.transmit;
}

} // namespace

void lower_quality(scene::Scene& scene, int quality) {
  if (quality >= 9) return;
  scene.fogs.clear();
  scene.rainbows.clear();
  scene.settings.thrown.photons = false;
  if (quality >= 8) return;
  MaterialChange change;
  change.layer = [quality](scene::Texture& layer, bool bottom) {
    if (quality < 6) {
      change_pigment(layer.pigment, [](scene::Pigment& pigment) {
        if (pigment.quick_colour) make_plain(pigment, *pigment.quick_colour);
      });
      if (bottom) change_pigment(layer.pigment, quality < 2 ? make_opaque : hide_what_is_behind);
    }
    layer.normal.reset();
    auto const& finish = static_cast<Shared<scene::Finish> const&>(layer.finish);
    if (finish->reflection) layer.finish.own().reflection.reset();
    if (quality >= 2) return;
    layer.finish.own().ambient = scene::Colour{Vec3(1), 0, 0, nullptr};
    layer.finish.own().emission = {};
  };
  change.apply(scene);
  if (quality < 4)
    for (auto& light : scene.lights) light.shadowless = true;
  if (quality < 2) {
    scene.lights.clear();
    scene.settings.ambient_light = scene::Colour{Vec3(1), 0, 0, nullptr};
  }
}

scene::Scene background_only(scene::Scene scene) {
  MaterialChange change;
  change.layer = [](scene::Texture& layer, bool) {
    auto& finish = layer.finish.own();
    finish.ambient = finish.emission = {};
    finish.reflection.reset();
  };
  change.apply(scene);
  scene.lights.clear();
  if (scene.sky_sphere) scene.sky_sphere->emission = {};
  for (auto& fog : scene.fogs) fog.colour.rgb = Vec3(0);
  for (auto& rainbow : scene.rainbows)
    for (auto& entry : rainbow.entries) entry.colour.rgb = Vec3(0);
  scene.background = scene::Colour{Vec3(transparency(scene)), 0, 0, nullptr};
  return scene;
}

void leave_out_background(scene::Scene& scene) {
  scene.background.rgb *= 1 - transparency(scene);
}

} // namespace abbe::plan
