// SPDX-License-Identifier: MIT
#include "optics/spectrum.hpp"
#include "wedge.hpp"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>

/// The picture of each scheme comes nearer to that of 450 bands as its parameter grows: at two
/// sizes. That drawn schemes are without bias at three standard errors is tested in modes_test.cpp.
namespace abbe::render::testing {
namespace {

using optics::Comb;
using Representation = scene::Representation;
using Spectral = scene::SpectralSettings;

struct Scheme {
  std::string name;
  std::function<void(scene::Scene&, double)> set; ///< its parameter, in the settings or the mode
  double coarse, fine;
  double most;   ///< of the coarse setting's error, that the fine one may have
  int seeds = 1; ///< whose mean square error it is
  bool lamp = false;
  bool disperses = true;
};

void each_mode(scene::Scene& scene, scene::DispersionMode const& mode) {
  for (auto& object : scene.objects)
    if (object.interior) object = with_glass(object, object.interior->glass, mode);
}

/// A lamp of five peaks over smooth light, in steps of 5 nm: a fluorescent tube in the rough.
std::shared_ptr<optics::Spectrum const> tube() {
  std::vector<optics::Pair> rows;
  for (int nm = 380; nm <= 780; nm += 5) {
    double const hump = 0.3 * std::exp(-std::pow((nm - 580) / 60.0, 2));
    bool const peak = nm == 405 || nm == 435 || nm == 545 || nm == 580 || nm == 610;
    rows.push_back({double(nm), hump + (peak ? 2.0 : 0.02)});
  }
  auto const made = optics::Spectrum::power(rows);
  ABBE_ASSERT(made);
  return std::make_shared<optics::Spectrum const>(*made);
}

/// The wedge before a pale wall with red bars; in the light of a lamp when the scheme wants it.
scene::Scene fringes(bool lamp, bool disperses = true) {
  auto scene = wedge(n_sf11(), deterministic(), 450, Vec3(.9, .85, .7), Vec3(.5, .1, .1));
  scene.settings.adc_bailout = 1e-3;
  if (!disperses) each_mode(scene, none());
  auto const light = lamp ? tube() : nullptr;
  for (auto& object : scene.objects) {
    if (!lamp || !object.texture || object.interior) continue;
    auto& finish = *object.texture->front().finish;
    finish.ambient.rgb = Vec3(0);
    finish.emission = {Vec3(1), 0, 0, light};
  }
  return scene;
}

double square_error(Scheme const& scheme, double parameter, image::Image const& reference) {
  auto options = small();
  auto scene = fringes(scheme.lamp, scheme.disperses);
  scene.settings.spectral.bands = 64;
  scheme.set(scene, parameter);
  double sum = 0;
  for (int seed = 0; seed < scheme.seeds; ++seed) {
    options.seed = static_cast<std::uint64_t>(seed) + 1;
    auto const image = picture(scene, options);
    for (std::size_t i = 0; i < image.rgb.size(); ++i)
      sum += std::pow(double(image.rgb[i]) - double(reference.rgb[i]), 2);
  }
  return sum / scheme.seeds;
}

class Converges : public ::testing::TestWithParam<Scheme> {};

TEST_P(Converges, TowardsManyBandsAsTheParameterGrows) {
  auto const& scheme = GetParam();
  auto const reference = picture(fringes(scheme.lamp, scheme.disperses), small());
  double const coarse = std::sqrt(square_error(scheme, scheme.coarse, reference));
  double const fine = std::sqrt(square_error(scheme, scheme.fine, reference));
  EXPECT_GT(coarse, 0);
  EXPECT_LT(fine, scheme.most * coarse) << fine << " after " << coarse;
}

void bands(scene::Scene& scene, double n) {
  scene.settings.spectral.bands = static_cast<int>(n);
}

std::vector<Scheme> schemes() {
  auto const mode = [](auto const& make) {
    return [make](scene::Scene& scene, double parameter) { each_mode(scene, make(parameter)); };
  };
  auto const of_bands = [](scene::DispersionMode const& split) {
    return [split](scene::Scene& scene, double n) {
      bands(scene, n);
      each_mode(scene, split);
    };
  };
  auto const comb = [](double teeth, Follow follow) {
    return stochastic({static_cast<int>(teeth), Jitter::LowDiscrepancy, 1, follow});
  };
  auto const representation = [](Representation::Kind kind, auto const& set) {
    return [kind, set](scene::Scene& scene, double parameter) {
      scene.settings.spectral.representation.kind = kind;
      set(scene.settings.spectral, parameter);
    };
  };
  auto const hall = [](scene::Scene& scene, double n) {
    bands(scene, n);
    scene.settings.spectral.spacing = Spectral::Spacing::Hall;
  };
  auto const basis = representation(Representation::Kind::Basis, [](Spectral& s, double k) {
    s.representation.size = static_cast<int>(k);
  });
  // Four times as fine: a third of the error, where theory has a quarter (bands and their like).
  // Noise of M jittered rays falls as 1/M where fringes are wide, as 1/sqrt(M) at the worst.
  return {{"Bands", bands, 4, 16, 0.4},
          {"Hall", hall, 4, 16, 0.4},
          {"Adaptive", mode([](double px) { return adaptive(px); }), 2, 0.125, 0.4},
          {"Stochastic", of_bands(stochastic()), 4, 16, 0.5, 6},
          {"Triangular", of_bands(triangular()), 4, 16, 0.5, 6},
          {"FanoutTwo", of_bands(faithful()), 4, 16, 0.5, 6},
          {"Rays", mode([&](double m) { return comb(m, Follow::Every); }), 2, 8, 0.55, 6},
          {"Composite",
           representation(Representation::Kind::Composite,
                          [](Spectral& s, double n) { s.bands = static_cast<int>(n); }),
           4, 32, 0.4, 1, true},
          {"Basis", basis, 4, 16, 0.4},
          {"BasisWithoutDispersion", basis, 1, 4, 0.3, 1, false, false},
          {"Subdivided",
           representation(Representation::Kind::Adaptive,
                          [](Spectral& s, double t) { s.representation.tolerance = t; }),
           4, 0.1, 0.5}};
}

INSTANTIATE_TEST_SUITE_P(Schemes, Converges, ::testing::ValuesIn(schemes()),
                         [](auto const& instance) { return instance.param.name; });

/// As many channels as its grid has bands (of 2 nm): those bands, whatever disperses.
TEST(Basis, OfAllBandsIsTheBands) {
  auto scene = fringes(false);
  scene.settings.spectral.bands = 200;
  auto const all = picture(scene, small());
  scene.settings.spectral.representation.kind = Representation::Kind::Basis;
  scene.settings.spectral.representation.size = 200;
  auto const basis = picture(scene, small());
  // Floats of the picture; the weights agree to 1e-12 (tests/unit/optics/basis_test.cpp).
  for (std::size_t i = 0; i < all.rgb.size(); ++i) EXPECT_NEAR(basis.rgb[i], all.rgb[i], 1e-6);
}

/// Peaks of a measured lamp are put where they are, and not over a band: with as many bands, the
/// error is less than half of what it is without.
TEST(Composite, PeaksOfAMeasuredLampAreLines) {
  auto const reference = picture(fringes(true), small());
  for (int const n : {8, 16}) {
    double error[2];
    for (bool const composite : {false, true}) {
      Scheme const scheme{"",
                          [&](scene::Scene& scene, double size) {
                            bands(scene, size);
                            if (composite)
                              scene.settings.spectral.representation.kind =
                                  Representation::Kind::Composite;
                          },
                          0,
                          0,
                          0,
                          1,
                          true};
      error[composite] = std::sqrt(square_error(scheme, n, reference));
    }
    EXPECT_LT(error[1], 0.5 * error[0]) << n << " bands";
  }
}

} // namespace
} // namespace abbe::render::testing
