// SPDX-License-Identifier: MIT
#include "render/air_compiler.hpp"

#include "transport/air/fog.hpp"
#include "transport/air/rainbow.hpp"

#include <algorithm>
#include <numbers>

namespace abbe::render {
namespace {

constexpr double degree = std::numbers::pi / 180;

transport::AirColour compile(scene::Colour const& colour, bool filters, ColourCompiler& colours) {
  transport::AirColour out{colours.light(colour), {}, colour.filter, colour.transmit};
  if (filters) out.tint = colours.reflectance(colour);
  return out;
}

transport::FogLayer compile(scene::Fog const& fog, int noise_generator, ColourCompiler& colours) {
  transport::FogLayer out;
  out.colour = compile(fog.colour, fog.colour.filter != 0, colours);
  out.distance = fog.distance;
  out.ground = fog.ground;
  out.up = fog.up;
  out.offset = fog.offset;
  out.alt = fog.alt;
  out.turbulence = fog.turbulence; // without an amount: that of the origin, everywhere
  out.turbulence_depth = fog.turbulence_depth;
  out.noise_generator = noise_generator;
  return out;
}

transport::Bow compile(scene::Rainbow const& rainbow, ColourCompiler& colours) {
  transport::Bow out;
  out.axis = glm::normalize(rainbow.direction);
  out.right = glm::normalize(glm::cross(rainbow.up, out.axis));
  out.up = glm::cross(out.axis, out.right);
  out.inner_rad = (rainbow.angle_deg - rainbow.width_deg / 2) * degree;
  out.width_rad = rainbow.width_deg * degree;
  out.distance = rainbow.distance;
  out.jitter = rainbow.jitter;
  if (rainbow.arc_deg) {
    out.arc_rad = *rainbow.arc_deg / 2 * degree;
    out.falloff_rad = rainbow.falloff_deg.value_or(*rainbow.arc_deg) / 2 * degree;
  }
  bool const filters = std::ranges::any_of(
      rainbow.entries, [](auto const& entry) { return entry.colour.filter != 0; });
  for (auto const& entry : rainbow.entries)
    out.entries.push_back({entry.value, compile(entry.colour, filters, colours)});
  return out;
}

} // namespace

transport::Air compile_air(scene::Scene const& scene, ColourCompiler& colours) {
  transport::Air air;
  if (!scene.fogs.empty()) {
    std::vector<transport::FogLayer> layers;
    for (auto const& fog : scene.fogs)
      layers.push_back(compile(fog, scene.settings.noise_generator, colours));
    air.push_back(std::make_unique<transport::Fog>(std::move(layers), scene.camera.location));
  }
  if (!scene.rainbows.empty()) {
    std::vector<transport::Bow> bows;
    for (auto const& rainbow : scene.rainbows) bows.push_back(compile(rainbow, colours));
    air.push_back(std::make_unique<transport::Rainbow>(std::move(bows)));
  }
  return air;
}

} // namespace abbe::render
