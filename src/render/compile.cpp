// SPDX-License-Identifier: MIT
#include "render/compile_objects.hpp"
#include "render/media_compiler.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace abbe::render {
namespace {

double cos_degrees(double degrees) {
  return std::cos(degrees * std::numbers::pi / 180);
}

CompiledLight compile_light(scene::Light const& light, Vec3 const& eye, ColourCompiler& colours) {
  CompiledLight out;
  out.kind = light.kind;
  out.position = light.position - eye;
  out.value = colours.light(light.colour);
  out.shadowless = light.shadowless;
  out.fade_distance = light.fade_distance;
  out.fade_power = light.fade_power;
  Vec3 const toward = light.point_at - light.position;
  double const length = glm::length(toward);
  if (length > 0) out.direction = toward / length;
  out.cos_radius = cos_degrees(light.radius_deg);
  out.cos_falloff = cos_degrees(light.falloff_deg);
  out.tightness = light.tightness;
  return out;
}

void compile_sky(scene::Scene const& scene, PigmentCompiler& pigments, ColourCompiler& colours,
                 Stage& stage) {
  Channels background = colours.light(scene.background);
  if (!is_black(background)) stage.background = std::move(background);
  if (!scene.sky_sphere) return;
  for (auto const& pigment : scene.sky_sphere->pigments)
    stage.sky_pigments.push_back(pigments.add(pigment));
  stage.sky_emission = colours.light(scene.sky_sphere->emission);
  stage.to_sky_linear = scene.sky_sphere->placement.inverse_linear;
  stage.to_sky_offset = scene.sky_sphere->placement.inverse_offset;
}

} // namespace

Stage compile(scene::Scene const& scene, plan::Plan const& plan) {
  Stage stage;
  stage.bands = plan.bands;
  ColourCompiler colours(plan.bands, WorkingSpace(scene.settings));
  stage.channels = colours.channels();
  if (stage.bands) {
    auto const weights = stage.bands->rgb_weights();
    stage.rgb_weights.assign(weights.begin(), weights.end());
  } else {
    stage.rgb_weights = {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  }
  stage.camera = scene.camera;
  stage.adc_bailout = scene.settings.adc_bailout;
  stage.max_trace_level = scene.settings.max_trace_level;
  stage.opacity_version = scene.settings.version;

  PigmentCompiler pigments(colours, stage.pigments);
  MediaCompiler media(scene.settings, plan, colours, stage);
  compile_objects(scene, colours, pigments, media, stage);
  for (auto const& light : scene.lights)
    stage.lights.push_back(compile_light(light, scene.camera.location, colours));
  compile_sky(scene, pigments, colours, stage);
  return stage;
}

} // namespace abbe::render
