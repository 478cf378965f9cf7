// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/shapes/box.hpp"
#include "geometry/shapes/plane.hpp"
#include "geometry/shapes/sphere.hpp"
#include "scenes.hpp"

namespace abbe::render::testing {

/// A box of glass over a floor, and a ball that a box bites into, under a lamp.
inline scene::Scene table(scene::DispersionMode mode, bool spectral) {
  using geometry::Transform;
  scene::Scene scene;
  auto const floor = geometry::make_plane({0, 1, 0}, -1.2);
  scene.objects.push_back(object(floor->shape, floor->placement, plain(Vec3(0.6))));
  auto const turned = Transform::rotation({20, 30, 10}).then(Transform::translation({-1, 0, 5}));
  auto const box = geometry::make_box(Vec3(-1), Vec3(1));
  scene.objects.push_back(
      with_glass(object(box->shape, box->placement.then(turned), clear()), n_sf11(), mode));
  scene::Object bitten;
  bitten.kind = scene::Object::Kind::Difference;
  auto const ball = geometry::make_sphere({1.5, 0, 5}, 1);
  auto const bite = geometry::make_box({1, -0.5, 3}, {2, 0.5, 5});
  bitten.children.push_back(object(ball->shape, ball->placement, plain({0.8, 0.3, 0.2})));
  bitten.children.push_back(object(bite->shape, bite->placement, plain({0.2, 0.3, 0.8})));
  scene.objects.push_back(bitten);
  scene::Light light;
  light.position = {-3, 8, -4};
  light.colour.rgb = Vec3(1);
  scene.lights.push_back(light);
  scene.background.rgb = Vec3(0.2);
  scene.settings.spectral.requested = spectral;
  scene.settings.spectral.bands = 8;
  scene.settings.max_trace_level = 10;
  return scene;
}

} // namespace abbe::render::testing
