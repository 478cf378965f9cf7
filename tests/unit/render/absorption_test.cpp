// SPDX-License-Identifier: MIT
#include "geometry/shapes/box.hpp"
#include "render/camera.hpp"
#include "scenes.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace abbe::render::testing {
namespace {

/// Light of one camera ray through a slab of glass, before the picture makes floats of it.
Vec3 through(double thickness, optics::GlassPtr glass, scene::DispersionMode mode, int sheets = 1) {
  scene::Scene scene;
  for (int i = 0; i < sheets; ++i) {
    double const z = 2 + thickness * i;
    auto const slab = geometry::make_box({-50, -50, z}, {50, 50, z + thickness});
    scene.objects.push_back(with_glass(object(slab->shape, slab->placement, clear()), glass, mode));
  }
  scene.background.rgb = Vec3(1);
  scene.settings.spectral.requested = true;
  scene.settings.spectral.bands = 1;
  scene.settings.adc_bailout = 0;
  scene.settings.max_trace_level = 200;
  auto const plan = plan::make_plan(scene);
  ABBE_ASSERT(plan);
  Stage const stage = compile(scene, *plan);
  Tracer tracer(stage);
  auto const ray = camera_ray(stage.camera, 0.5, 0.5, 1, 1);
  return tracer.sample(ray, SampleKey(), {});
}

/// Of index 1, so that nothing is reflected; a tenth of the light is left after 10 mm.
optics::GlassPtr smoke() {
  auto glass =
      optics::GlassBuilder("smoke").constant(1).transmittance(10, {{0.3, 0.1}, {0.9, 0.1}}).build();
  ABBE_ASSERT(glass);
  return *glass;
}

TEST(Absorption, TwiceAsThickIsTheSquare) {
  for (double const thickness : {1e-9, 1e-3, 0.5, 3.7, 10.0, 60.0, 600.0}) {
    double const once = through(thickness, smoke(), none()).y;
    // Lambert's law: 10^(-d / 10 mm). Relative error of the exponential: that of its exponent.
    double const exponent = thickness * std::log(10) / 10;
    EXPECT_NEAR(once / std::exp(-exponent), 1, 1e-14 * (1 + exponent)) << thickness;
    EXPECT_NEAR(through(2 * thickness, smoke(), none()).y / (once * once), 1,
                1e-14 * (1 + exponent))
        << thickness;
  }
}

/// The depth may be passed in one piece or in many: sheets that touch are one slab.
TEST(Absorption, ManySheetsAreOneSlab) {
  double const slab = through(16, smoke(), none()).y;
  for (int const sheets : {2, 16, 64})
    EXPECT_NEAR(through(16.0 / sheets, smoke(), none(), sheets).y / slab, 1, 1e-14 * sheets);
}

/// Nothing is left of what comes from infinitely far, and depth beyond the numbers is black, not
/// wrong.
TEST(Absorption, EndsInBlack) {
  EXPECT_EQ(through(1e6, smoke(), none()).y, 0);
  EXPECT_EQ(through(1e300, smoke(), none()).y, 0);
}

} // namespace
} // namespace abbe::render::testing
