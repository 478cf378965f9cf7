// SPDX-License-Identifier: MIT
#include "geometry/shapes/box.hpp"
#include "geometry/shapes/plane.hpp"
#include "optics/spectrum.hpp"
#include "render/compile.hpp"
#include "scenes.hpp"
#include "transport/tracer.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace abbe::render::testing {
namespace {

constexpr double mercury_nm[] = {404.6563, 435.8328, 546.0735, 576.9598, 579.0663};
constexpr double apex_rad = 20 * std::numbers::pi / 180;
constexpr double screen_z = 1e4;

/// A prism whose first face is the plane z = 1, and a half plane far behind it that glows for x <
/// 0.
scene::Scene behind_a_prism(scene::DispersionMode const& mode) {
  scene::Scene scene;
  scene::Object prism;
  prism.kind = scene::Object::Kind::Intersection;
  auto const front = geometry::make_plane({0, 0, -1}, -1);
  auto const back = geometry::make_plane({std::sin(apex_rad), 0, std::cos(apex_rad)}, 3);
  for (auto const& placed : {*front, *back})
    prism.children.push_back(object(placed.shape, placed.placement, clear()));
  scene.objects.push_back(with_glass(std::move(prism), n_sf11(), mode));
  auto lit = plain(Vec3(1));
  lit[0].finish->diffuse = 0;
  lit[0].finish->ambient.rgb = Vec3(0);
  auto const screen = geometry::make_box({-1e6, -1e6, screen_z}, {0, 1e6, screen_z + 1e-3});
  scene.objects.push_back(object(screen->shape, screen->placement, lit));
  scene.settings.spectral.requested = true;
  scene.settings.spectral.bands = 3;
  scene.settings.spectral.representation.kind = scene::Representation::Kind::Composite;
  scene.settings.adc_bailout = 1e-6;
  scene.settings.max_trace_level = 8;
  return scene;
}

/// Where a camera ray at an angle lands on the screen, by Snell's law alone.
long double landing(long double angle_rad, long double n) {
  using std::sin, std::cos, std::asin, std::tan;
  long double const apex = apex_rad;
  // In the glass, then from the plane z = 1 to the second face.
  long double const inside = asin(sin(angle_rad) / n);
  long double const x0 = tan(angle_rad);
  long double const t =
      (3 - sin(apex) * x0 - cos(apex)) / (sin(apex) * sin(inside) + cos(apex) * cos(inside));
  long double const x1 = x0 + t * sin(inside), z1 = 1 + t * cos(inside);
  // The face's normal is turned by the apex towards +x.
  long double const out = asin(n * sin(inside - apex)) + apex;
  return x1 + (static_cast<long double>(screen_z) - z1) * tan(out);
}

/// Each line of a mercury lamp is seen at the angle of its own wavelength, to 1e-9 rad, with three
/// bands as with many, and whether or not wavelengths are drawn: no band's width, no jitter.
TEST(Composite, LinesStandAtTheirAngles) {
  auto const comb = [](int teeth, Follow follow) {
    return stochastic(optics::Comb{teeth, Jitter::LowDiscrepancy, 1, follow});
  };
  for (auto const& mode : {deterministic(), comb(0, Follow::Every), comb(4, Follow::Hero)}) {
    for (double const line_nm : mercury_nm) {
      auto only = behind_a_prism(mode);
      auto lamp = optics::Spectrum::lines({{line_nm, 1}});
      only.objects[1].texture->front().finish->emission = {
          Vec3(1), 0, 0, std::make_shared<optics::Spectrum const>(*lamp)};
      auto const own_plan = plan::make_plan(only);
      ASSERT_TRUE(own_plan);
      ASSERT_EQ(own_plan->spectral->lines_nm, std::vector<double>{line_nm});
      Stage const own = compile(only, *own_plan);
      transport::Tracer alone(own);
      auto const light = [&](double angle_rad) {
        // The usual camera: 1.33 across, in the direction of z.
        double const x = std::tan(angle_rad) / 1.33 + 0.5, y = 0.5;
        transport::SampleKey const key{RandomKey(1), 3, 0, 0, RandomKey(1)};
        alone.trace({&x, &y, 1, 1, 1}, {&key, 1});
        Vec3 const rgb = alone.light_of(0, {});
        return std::abs(rgb.x) + std::abs(rgb.y) + std::abs(rgb.z);
      };
      // Light that was reflected in the prism goes elsewhere: it is a tenth at most.
      double const straight = light(0.2);
      auto const lit = [&](double angle_rad) { return light(angle_rad) > 0.5 * straight; };
      long double const n = n_sf11()->index_unchecked(line_nm);
      double low = 0.2, high = 0.5; // lands left of the edge, and right of it
      ASSERT_LT(landing(low, n), 0);
      ASSERT_GT(landing(high, n), 0);
      ASSERT_TRUE(lit(low));
      ASSERT_FALSE(lit(high));
      long double exact_low = low, exact_high = high;
      for (int i = 0; i < 60; ++i) {
        double const middle = (low + high) / 2;
        (lit(middle) ? low : high) = middle;
        long double const exact = (exact_low + exact_high) / 2;
        (landing(exact, n) < 0 ? exact_low : exact_high) = exact;
      }
      EXPECT_NEAR(low, static_cast<double>(exact_low), 1e-9) << line_nm;
    }
  }
}

/// A lamp of lines is as bright and of the same colour as without them apart, seen directly.
TEST(Composite, DirectLightKeepsItsColour) {
  auto lamp = optics::Spectrum::lines({{435.8328, .5}, {546.0735, 1}, {579.0663, .7}});
  Vec3 const exact = optics::light_rgb(*lamp);
  scene::Scene scene;
  auto lit = plain(Vec3(1));
  lit[0].finish->diffuse = 0;
  lit[0].finish->ambient.rgb = Vec3(0);
  lit[0].finish->emission = {Vec3(1), 0, 0, std::make_shared<optics::Spectrum const>(*lamp)};
  auto const wall = geometry::make_plane({0, 0, -1}, -4);
  scene.objects.push_back(object(wall->shape, wall->placement, lit));
  scene.settings.spectral.requested = true;
  scene.settings.spectral.bands = 4;
  scene.settings.spectral.representation.kind = scene::Representation::Kind::Composite;
  // light_rgb integrates over 360..830 nm, which moves white by some 1e-4 against 380..780.
  scene.settings.spectral.low_nm = 360;
  scene.settings.spectral.high_nm = 830;
  RenderOptions options;
  options.width = options.height = 1;
  auto const image = picture(scene, options);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(image.rgb[static_cast<std::size_t>(c)], exact[c], 2e-7 * glm::length(exact));
}

} // namespace
} // namespace abbe::render::testing
