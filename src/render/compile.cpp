// SPDX-License-Identifier: MIT
#include "render/air_compiler.hpp"
#include "render/compile_objects.hpp"
#include "render/media_compiler.hpp"
#include "render/normal_compiler.hpp"
#include "scene/object_tree.hpp"
#include "simd/math.hpp"
#include "transport/caustics/caustics.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace abbe::render {
namespace {

/// @param air is something in it?
std::unique_ptr<transport::Lamp const> compile_lamp(scene::Light const& light, Vec3 const& eye,
                                                    bool air, ColourCompiler& colours) {
  transport::Lamp::Common common;
  common.value = colours.light(light.colour);
  common.shadowless = light.shadowless;
  common.throws = light.throws;
  common.fade_distance = light.fade_distance;
  common.fade_power = light.fade_power;
  if (light.area) common.area = std::make_shared<transport::Area const>(*light.area);
  if (light.projected_through) {
    auto gate = scene::world_of(*light.projected_through, geometry::Transform::translation(-eye));
    common.gate = std::make_shared<geometry::World const>(
        gate ? std::move(*gate) : geometry::World({}, {})); // nothing comes through nothing
  }
  common.weakened_by_air = air && light.media_attenuation && light.media_interaction;
  return transport::make_lamp(light, light.position - eye, std::move(common));
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

/// Which lamps light the surfaces of which groups: those of the group itself, and those of no group
/// where the outermost one that it stands in says so. This is POV-Ray's way.
std::vector<std::vector<bool>> lit_groups(scene::Scene const& scene) {
  std::vector<std::vector<bool>> out;
  if (scene.light_groups.empty()) return out;
  for (std::size_t of = 0; of <= scene.light_groups.size(); ++of) {
    out.emplace_back();
    bool global = true;
    for (std::size_t group = of; group != 0; group = scene.light_groups[group - 1].outer)
      global = scene.light_groups[group - 1].global_lights;
    for (scene::Light const& light : scene.lights)
      out.back().push_back(light.group == 0 ? global : light.group == of);
  }
  return out;
}

/// Throughput below which a path is dropped when the scene does not say: a pixel loses some ten
/// such paths at most in all but contrived scenes, so less than 1e-4 of white.
constexpr double default_bailout = 1e-5;
/// Where a sample has taken so many rays for each of its channels, little of the rest matters:
/// POV-Ray's own limits stop at some hundred.
constexpr int default_rays = 1024;
/// Ends what never fades: mirrors face to face, light that is trapped in glass.
constexpr int default_level = 256;

void set_limits(scene::Settings const& settings, Stage& stage) {
  bool const given = settings.adc_bailout || settings.max_trace_level;
  stage.adc_bailout = settings.adc_bailout.value_or(given ? 1.0 / 255 : default_bailout);
  stage.max_trace_level = settings.max_trace_level.value_or(given ? 5 : default_level);
  stage.most_rays = given ? 0 : static_cast<std::uint32_t>(default_rays * stage.channels);
}

std::shared_ptr<transport::caustics::Caustics const> find_caustics(scene::Scene const& scene,
                                                                   Stage const& stage) {
  transport::caustics::Settings settings;
  for (auto const& light : scene.lights)
    settings.lamps.push_back((!light.area || scene.settings.thrown.photons) && !light.shadowless
                             && !light.projected_through);
  settings.error = scene.settings.thrown.error;
  settings.exact = scene.settings.thrown.exact;
  settings.limits = {scene.settings.thrown.max_trace_level, scene.settings.thrown.adc_bailout};
  return std::make_shared<transport::caustics::Caustics const>(stage, settings);
}

double largest(std::span<double const> channels) {
  return channels.empty() ? 0 : *std::max_element(channels.begin(), channels.end());
}

/// What a layer can send of its own at most, for a pigment of 1.
double own_light(CompiledFinish const& finish, double lamps) {
  double const scattered = std::max(finish.diffuse, finish.diffuse_back);
  return largest(finish.ambient) + largest(finish.emission)
         + lamps * (scattered + finish.phong + finish.specular);
}

/// What a surface or the sky can send at most, when surfaces do not pass on more than arrives:
/// light from behind is then weighted by what the surface in front leaves.
double brightest(Stage const& stage) {
  double lamps = 0;
  for (auto const& lamp : stage.lamps) lamps += largest(lamp->value()) * lamp->brightest_fade();
  double surface = 0, pigment = 1;
  for (auto const& finish : stage.textures.finishes)
    surface = std::max(surface, own_light(finish, lamps));
  auto const channels = static_cast<std::size_t>(stage.channels);
  for (std::size_t at = 0; at < stage.textures.colours.size(); at += channels)
    pigment = std::max(pigment, largest({stage.textures.colours.data() + at, channels}));
  double const sky = stage.sky_pigments.empty() ? 0 : largest(stage.sky_emission);
  double bound = std::max({pigment * surface, pigment * sky, largest(stage.background)});
  for (auto const& effect : stage.air) bound += effect->brightest();
  // `reflection { exponent }` adds a power of what it sees, which may be another such mirror. Where
  // that grows it is bounded by the levels that a path has; perhaps by nothing.
  for (int level = 0; level < stage.max_trace_level; ++level) {
    double next = bound;
    for (auto const& finish : stage.textures.finishes) {
      auto const& reflection = finish.reflection;
      if (!reflection || reflection->exponent == 1) continue;
      double const most = std::max({largest(reflection->minimum), largest(reflection->maximum),
                                    reflection->metal_n.empty() ? 0.0 : 1.0});
      next = std::max(next, pigment * own_light(finish, lamps)
                                + most * simd::pow(bound, reflection->exponent));
    }
    if (!(next > bound)) break;
    bound = next;
  }
  return bound;
}

} // namespace

namespace {

Stage compile(scene::Scene const& scene, std::deque<scene::Object>* taken, plan::Plan const& plan) {
  Stage stage;
  stage.spectral = plan.spectral;
  ColourCompiler colours(plan.spectral, plan::WorkingSpace(scene.settings));
  stage.channels = colours.channels();
  if (stage.spectral) {
    for (int c = 0; c < stage.channels; ++c) {
      stage.rgb_weights.push_back(stage.spectral->rgb_weight(c));
      stage.lambdas_nm.push_back(stage.spectral->lambda_nm(c));
    }
  } else {
    stage.rgb_weights = {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  }
  stage.camera = transport::make_camera(scene.camera);
  stage.lens = transport::Lens::of(scene.camera);
  stage.camera_normal = NormalCompiler(stage.textures).add(scene.camera.normal, Mat3(1));
  stage.eye = scene.camera.location;
  set_limits(scene.settings, stage);
  stage.textures.channels = stage.channels;
  stage.textures.opacity_version = scene.settings.version;

  stage.air = compile_air(scene, colours);
  stage.lit_groups = lit_groups(scene);
  PigmentCompiler pigments(colours, stage);
  MediaCompiler media(scene.settings, plan, colours, stage);
  compile_objects(scene, taken, plan, colours, pigments, media, stage);
  for (auto const& light : scene.lights)
    stage.lamps.push_back(compile_lamp(light, scene.camera.location, !stage.air.empty(), colours));
  compile_sky(scene, pigments, colours, stage);
  if (plan.has(plan::Effect::Caustics)) stage.caustics = find_caustics(scene, stage);
  stage.brightest = brightest(stage);
  return stage;
}

} // namespace

Stage compile(scene::Scene const& scene, plan::Plan const& plan) {
  return compile(scene, nullptr, plan);
}

Stage compile(scene::Scene&& scene, plan::Plan const& plan) {
  return compile(scene, &scene.objects, plan);
}

} // namespace abbe::render
