// SPDX-License-Identifier: MIT
#include "lang/evaluate.hpp"
#include "render/render.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>

/// Paths end by what they can still add. Here: the bound that the picture's file states is never
/// smaller than what is really missing, in any pixel and on the mean, and without limits in the
/// scene the loss is below 1e-4 of the picture's light.
namespace abbe::render {
namespace {

namespace fs = std::filesystem;

struct Limits {
  std::optional<double> adc_bailout;
  std::optional<int> max_trace_level;
};
/// What the scene's author says nothing about.
Limits const by_default{};
/// So deep that the loss left over is a hundredth of the default's at most.
Limits const deep{1e-7, 256};

struct Mode {
  char const* name;
  std::optional<scene::DispersionMode> mode;
};
std::vector<Mode> modes() {
  using Kind = scene::DispersionMode::Kind;
  using Jitter = optics::Comb::Jitter;
  using Follow = optics::Comb::Follow;
  auto const mode = [](Kind kind, optics::Comb const& comb = {}) {
    return scene::DispersionMode{kind, comb, 0.5, {}};
  };
  auto const stochastic = [&](int teeth, Jitter jitter, double width, Follow follow) {
    return mode(Kind::Stochastic, {teeth, jitter, width, follow});
  };
  return {{"none", mode(Kind::None)},
          {"deterministic", mode(Kind::Deterministic)},
          {"adaptive", mode(Kind::Adaptive)},
          {"stochastic", mode(Kind::Stochastic)},
          {"triangular", stochastic(0, Jitter::Triangular, 2, Follow::Every)},
          {"faithful", stochastic(0, Jitter::LowDiscrepancy, 1, Follow::Doubled)},
          {"rays 3", stochastic(3, Jitter::LowDiscrepancy, 1, Follow::Every)},
          {"hero 4", stochastic(4, Jitter::LowDiscrepancy, 1, Follow::Hero)},
          {"clusters 4 degrade", stochastic(4, Jitter::LowDiscrepancy, 1, Follow::Importance)}};
}

/// Pictures of 16 x 12 pixels.
constexpr int size = 4;

RenderResult render_with(scene::Scene& scene, Limits const& limits, Mode const& mode, int bands) {
  scene.settings.adc_bailout = limits.adc_bailout;
  scene.settings.max_trace_level = limits.max_trace_level;
  plan::Overrides overrides;
  overrides.dispersion = mode.mode;
  overrides.bands = bands;
  auto const plan = plan::make_plan(scene, overrides);
  EXPECT_TRUE(plan);
  RenderOptions options;
  options.width = 4 * size;
  options.height = 3 * size;
  return render(scene, *plan, options);
}

/// The pixels' floats and the sums of some thousand terms: 1e-6 of the values at hand.
double rounding(double value) {
  return 1e-6 * (1 + std::abs(value));
}

void expect_bounded(RenderResult const& less, RenderResult const& more) {
  double mean = 0;
  for (std::size_t i = 0; i < less.image.rgb.size(); ++i) {
    double const off = double(more.image.rgb[i]) - double(less.image.rgb[i]);
    ASSERT_LE(std::abs(off), less.missing_most + more.missing_most + rounding(less.image.rgb[i]))
        << "value " << i;
    mean += off;
  }
  mean /= static_cast<double>(less.image.rgb.size());
  EXPECT_LE(std::abs(mean), less.missing_mean + more.missing_mean + 1e-6);
}

double light(RenderResult const& result) {
  double sum = 0;
  for (float const value : result.image.rgb) sum += value;
  return sum;
}

class MissingLight : public ::testing::TestWithParam<std::string> {};

TEST_P(MissingLight, IsWithinWhatTheFileSays) {
  lang::EvaluateOptions options;
  options.stdlib_dir = ABBE_STDLIB_DIR;
  auto evaluated = lang::evaluate_file(GetParam(), options);
  ASSERT_TRUE(evaluated.ok());
  scene::Scene scene = evaluated.scene;
  Limits const shallow{scene.settings.adc_bailout, scene.settings.max_trace_level};
  for (Mode const& mode : modes()) {
    SCOPED_TRACE(mode.name);
    auto const more = render_with(scene, deep, mode, 6);
    auto const usual = render_with(scene, by_default, mode, 6);
    expect_bounded(usual, more);
    // Without sign: a picture of what is missing.
    EXPECT_LE(std::abs(light(more) - light(usual)), 1e-4 * light(more));
    for (Limits const& limits : {shallow, Limits{1.0 / 255, 5}, Limits{0.1, 3}})
      expect_bounded(render_with(scene, limits, mode, 6), more);
  }
}

std::vector<std::string> scenes() {
  std::vector<std::string> out;
  for (auto const& entry : fs::directory_iterator(ABBE_SOURCE_DIR "/examples"))
    if (entry.path().extension() == ".scn") out.push_back(entry.path().string());
  out.push_back(ABBE_SOURCE_DIR "/tests/stability/scenes/bent_mirrors.scn");
  std::sort(out.begin(), out.end());
  return out;
}

/// Powers want the whole light, also of combs that part it: no mode loses or gains light.
TEST(BentMirrors, ShowTheSameInAllModes) {
  lang::EvaluateOptions options;
  options.stdlib_dir = ABBE_STDLIB_DIR;
  auto evaluated =
      lang::evaluate_file(ABBE_SOURCE_DIR "/tests/stability/scenes/bent_mirrors.scn", options);
  ASSERT_TRUE(evaluated.ok());
  scene::Scene scene = evaluated.scene;
  double const plain = light(render_with(scene, by_default, modes()[1], 6));
  for (Mode const& mode : modes()) {
    SCOPED_TRACE(mode.name);
    // A picked wavelength's noise on the part of the light that is dispersed: a percent.
    EXPECT_NEAR(light(render_with(scene, by_default, mode, 6)), plain, .01 * plain);
  }
}

INSTANTIATE_TEST_SUITE_P(Examples, MissingLight, ::testing::ValuesIn(scenes()),
                         [](auto const& instance) {
                           return fs::path(instance.param).stem().string();
                         });

} // namespace
} // namespace abbe::render
