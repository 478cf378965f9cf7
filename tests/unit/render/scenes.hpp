// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/shapes/registry.hpp"
#include "optics/glass_builder.hpp"
#include "render/render.hpp"
#include "scene/scene.hpp"

#include <array>
#include <string>
#include <vector>

/// Small scenes built by hand, so that the renderer's tests need no language.
namespace abbe::render::testing {

/// SCHOTT N-SF11 and N-BK7, Sellmeier coefficients of the catalogue.
inline optics::GlassPtr sellmeier(std::string name, std::vector<double> b, std::vector<double> c) {
  auto glass = optics::GlassBuilder(std::move(name)).sellmeier(b, c).range_um(0.37, 2.5).build();
  ABBE_ASSERT(glass);
  return *glass;
}
inline optics::GlassPtr n_sf11() {
  return sellmeier("N-SF11", {1.73759695, 0.313747346, 1.89878101},
                   {0.013188707, 0.0623068142, 155.23629});
}
inline optics::GlassPtr n_bk7() {
  return sellmeier("N-BK7", {1.03961212, 0.231792344, 1.01046945},
                   {0.00600069867, 0.0200179144, 103.560653});
}

inline scene::Layers plain(Vec3 const& rgb, double transmit = 0) {
  scene::Texture texture;
  texture.pigment.colour = {rgb, 0, transmit, nullptr};
  return {texture};
}
/// A texture that lets all light pass and adds none.
inline scene::Layers clear() {
  auto layers = plain(Vec3(1), 1);
  layers[0].finish->ambient.rgb = Vec3(0);
  layers[0].finish->diffuse = 0;
  return layers;
}

inline scene::Object object(geometry::ShapePtr shape, geometry::Transform const& placement,
                            scene::Layers texture) {
  scene::Object out;
  out.shape = std::move(shape);
  out.placement = placement;
  out.texture = std::move(texture);
  return out;
}

inline scene::Object with_glass(scene::Object object, optics::GlassPtr glass,
                                scene::DispersionMode mode) {
  auto interior = std::make_shared<scene::Interior>();
  interior->glass = std::move(glass);
  interior->dispersion = mode;
  object.interior = interior;
  for (auto& child : object.children) child.interior = interior;
  return object;
}

inline scene::DispersionMode none() {
  return {scene::DispersionMode::Kind::None, {}, 0, {}};
}
inline scene::DispersionMode deterministic() {
  return {scene::DispersionMode::Kind::Deterministic, {}, 0, {}};
}
inline scene::DispersionMode adaptive(double tolerance_px) {
  return {scene::DispersionMode::Kind::Adaptive, {}, tolerance_px, {}};
}
inline scene::DispersionMode stochastic(optics::Comb const& comb = {}) {
  return {scene::DispersionMode::Kind::Stochastic, comb, 0, {}};
}
using Jitter = optics::Comb::Jitter;
using Follow = optics::Comb::Follow;
inline scene::DispersionMode triangular() {
  return stochastic({0, Jitter::Triangular, 2, Follow::Every});
}
inline scene::DispersionMode faithful() {
  return stochastic({0, Jitter::LowDiscrepancy, 1, Follow::Doubled});
}

inline image::Image picture(scene::Scene const& scene, RenderOptions const& options,
                            plan::Overrides const& overrides = {}) {
  auto const plan = plan::make_plan(scene, overrides);
  ABBE_ASSERT(plan);
  return render(scene, *plan, options).image;
}

} // namespace abbe::render::testing
