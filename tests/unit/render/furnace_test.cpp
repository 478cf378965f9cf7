// SPDX-License-Identifier: MIT
#include "geometry/shapes/box.hpp"
#include "geometry/shapes/sphere.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>

namespace abbe::render::testing {
namespace {

/// A solid of glass in a uniform white surround renders as the surround: what is reflected and what
/// is passed add up to all of it, at every wavelength, through any number of internal reflections.
scene::Scene furnace(geometry::ShapePtr shape, optics::GlassPtr glass, scene::DispersionMode mode,
                     int bands) {
  scene::Scene scene;
  auto const placement =
      geometry::Transform::rotation({20, 30, 10}).then(geometry::Transform::translation({0, 0, 4}));
  scene.objects.push_back(
      with_glass(object(std::move(shape), placement, clear()), std::move(glass), mode));
  scene.background.rgb = Vec3(1);
  scene.settings.spectral.requested = true;
  scene.settings.spectral.bands = bands;
  scene.settings.max_trace_level = 50;
  scene.settings.adc_bailout = 0;
  return scene;
}

struct Case {
  std::string name;
  scene::DispersionMode mode;
  int bands;
};

class Furnace : public ::testing::TestWithParam<Case> {};

TEST_P(Furnace, GlassInWhiteIsWhite) {
  RenderOptions options;
  options.width = options.height = 24;
  for (auto const& shape : {geometry::ShapePtr(std::make_shared<geometry::Sphere>()),
                            geometry::ShapePtr(std::make_shared<geometry::Box>())}) {
    auto const image =
        picture(furnace(shape, n_sf11(), GetParam().mode, GetParam().bands), options);
    for (float const value : image.rgb) ASSERT_NEAR(value, 1, 1e-3);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Modes, Furnace,
    ::testing::Values(Case{"none", none(), 8}, Case{"deterministic", deterministic(), 8},
                      Case{"stochastic", stochastic(), 8}, Case{"triangular", triangular(), 8},
                      Case{"deterministic45", deterministic(), 45},
                      Case{"stochastic1", stochastic(), 1}, Case{"stochastic3", stochastic(), 3}),
    [](auto const& instance) { return instance.param.name; });

/// The published scheme draws a new wavelength where a ray leaves the glass. At grazing entry that
/// wavelength may find itself totally reflected for ever, in some bands and not in others: white is
/// kept on the mean, not in each pixel (docs/dispersion.md).
TEST(FurnaceFaithful, KeepsWhiteOnTheMean) {
  RenderOptions options;
  options.width = options.height = 24;
  auto const image =
      picture(furnace(std::make_shared<geometry::Sphere>(), n_sf11(), faithful(), 8), options);
  double sum = 0;
  for (float const value : image.rgb) {
    EXPECT_NEAR(value, 1, 0.5); // one of eight bands at the most
    sum += value;
  }
  EXPECT_NEAR(sum / static_cast<double>(image.rgb.size()), 1, 1e-3);
}

} // namespace
} // namespace abbe::render::testing
