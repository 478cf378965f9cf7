// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/shapes/box.hpp"
#include "geometry/shapes/plane.hpp"
#include "scenes.hpp"

#include <cmath>

namespace abbe::render::testing {

/// A wedge of glass before a white wall with black bars: fringes of every colour occur.
/// @param wall_rgb, bar_rgb other colours of the wall and the bars
inline scene::Scene wedge(optics::GlassPtr glass, scene::DispersionMode mode, int bands,
                          Vec3 const& wall_rgb = Vec3(1), Vec3 const& bar_rgb = Vec3(0)) {
  scene::Scene scene;
  scene::Object prism;
  prism.kind = scene::Object::Kind::Intersection;
  double const tilt = 0.45;
  auto const front = geometry::make_plane({0, 0, -1}, -4);
  auto const back = geometry::make_plane({std::sin(tilt), 0, std::cos(tilt)}, 5);
  auto const rim = geometry::make_box({-1.3, -1, 3}, {1.3, 1, 8});
  for (auto const& placed : {*front, *back, *rim})
    prism.children.push_back(object(placed.shape, placed.placement, clear()));
  scene.objects.push_back(with_glass(std::move(prism), std::move(glass), mode));
  auto const glowing = [](Vec3 const& value) {
    auto layers = plain(value);
    layers[0].finish->ambient.rgb = Vec3(1);
    layers[0].finish->diffuse = 0;
    return layers;
  };
  auto const wall = geometry::make_plane({0, 0, -1}, -40);
  scene.objects.push_back(object(wall->shape, wall->placement, glowing(wall_rgb)));
  for (int i = -8; i < 24; ++i) {
    auto const bar = geometry::make_box({3.0 * i, -40, 39}, {3.0 * i + 1.5, 40, 39.5});
    scene.objects.push_back(object(bar->shape, bar->placement, glowing(bar_rgb)));
  }
  scene.settings.spectral.requested = true;
  scene.settings.spectral.bands = bands;
  scene.settings.max_trace_level = 4;
  scene.settings.adc_bailout = 0.01;
  scene.camera.direction = {0, 0, 1.6};
  return scene;
}

inline RenderOptions small() {
  RenderOptions options;
  options.width = 20;
  options.height = 15;
  return options;
}

} // namespace abbe::render::testing
