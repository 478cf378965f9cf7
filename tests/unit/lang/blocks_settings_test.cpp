// SPDX-License-Identifier: MIT
#include "blocks_scene.hpp"
#include "optics/spectrum.hpp"

#include <fstream>
#include <set>

namespace abbe::lang {
namespace {

TEST(Settings, SpectralBlock) {
  using Spacing = scene::SpectralSettings::Spacing;
  auto const s = scene_of("global_settings { assumed_gamma 1 adc_bailout 0.01 max_trace_level 12\n"
                          "ambient_light rgb 0 spectral { bands 45 range 400, 700 spacing hall\n"
                          "dispersion { stochastic } unit 1000 } }")
                     .settings;
  EXPECT_EQ(s.assumed_gamma, 1);
  EXPECT_EQ(s.adc_bailout, 0.01);
  EXPECT_EQ(s.max_trace_level, 12);
  EXPECT_TRUE(s.spectral.requested);
  EXPECT_EQ(s.spectral.bands, 45);
  EXPECT_EQ(s.spectral.low_nm, 400);
  EXPECT_EQ(s.spectral.spacing, Spacing::Hall);
  EXPECT_EQ(s.spectral.mm_per_unit, 1000);
  EXPECT_EQ(s.spectral.dispersion.kind, scene::DispersionMode::Kind::Stochastic);
  auto const b =
      scene_of("global_settings { spectral { spacing boundaries { 380, 500, 600, 780 } } }")
          .settings;
  EXPECT_EQ(b.spectral.bands, 3);
  EXPECT_EQ(b.spectral.high_nm, 780);
}

TEST(Settings, SamplesOfAPixel) {
  auto const of = [](std::string const& words) {
    return *scene_of("global_settings { samples " + words + " }").settings.samples;
  };
  EXPECT_EQ(of("16").least, 16);
  EXPECT_EQ(of("16").most, 16);
  EXPECT_EQ(of("4, 64").least, 4);
  EXPECT_EQ(of("4 8*8").most, 64);
  EXPECT_EQ(of("4, 64").error, scene::SampleSettings::default_error);
  EXPECT_EQ(of("4, 64 error 1/100").error, 0.01);
  EXPECT_FALSE(scene_of("global_settings { }").settings.samples);
  EXPECT_EQ(codes("global_settings { samples 8, 4 }"), "E0353");
  EXPECT_EQ(codes("global_settings { samples 1, 4 error 2 }"), "E0353");
  EXPECT_EQ(codes("global_settings { samples 0 }"), "E0304");
}

TEST(Settings, MistakesAreNamedOnce) {
  EXPECT_EQ(codes("global_settings { spectral { range 700, 400 } }"), "E0416");
  EXPECT_EQ(codes("global_settings { spectral { spacing boundaries { 500, 400 } } }"), "E0416");
  EXPECT_EQ(codes("global_settings { spectral { unit 0 } }"), "E0353");
  EXPECT_EQ(codes("global_settings { radiosity { count 35 } }"), "E0903");
  EXPECT_EQ(codes("global_settings { photons { count 20000 media 10 } }"), "E0904 E0903");
  EXPECT_EQ(
      codes("global_settings { number_of_waves 3 charset utf8 hf_gray_16 max_intersections 64 }"),
      "");
  EXPECT_EQ(codes("global_settings { assumed_gamma 1 } global_settings { assumed_gamma 2 }"),
            "E0357");
}

TEST(Light, KindsAndFalloff) {
  auto const s = scene_of(
      "light_source { <1, 2, 3>, rgb 2 }\n"
      "light_source { 0, rgb 1 spotlight point_at y radius 10 falloff 20 tightness 3 translate x "
      "}\n"
      "light_source { y, rgb 1 parallel point_at 0 shadowless fade_distance 5 fade_power 2 }\n"
      "#declare L = light_source { 0 rgb 1 } light_source { L translate z }");
  using Kind = scene::Light::Kind;
  ASSERT_EQ(s.lights.size(), 4u);
  EXPECT_EQ(s.lights[0].position, Vec3(1, 2, 3));
  EXPECT_EQ(s.lights[1].kind, Kind::Spot);
  EXPECT_EQ(s.lights[1].position, Vec3(1, 0, 0));
  EXPECT_EQ(s.lights[1].point_at, Vec3(1, 1, 0));
  EXPECT_EQ(s.lights[1].falloff_deg, 20);
  EXPECT_EQ(s.lights[2].kind, Kind::Parallel);
  EXPECT_TRUE(s.lights[2].shadowless);
  EXPECT_EQ(s.lights[2].fade_power, 2);
  EXPECT_EQ(s.lights[3].position, Vec3(0, 0, 1));
}

TEST(Light, MistakesAreNamedOnce) {
  EXPECT_EQ(codes("light_source { 0, rgb 1 area_light x, y, 0, 4 adaptive 1 jitter }"), "E0304");
  EXPECT_EQ(codes("light_source { 0, rgb 1 area_light x, y, 1, 4 circular }"), "E0353");
  EXPECT_EQ(codes("light_source { 0, rgb 1 looks_like { } }"), "E0250");
  EXPECT_EQ(codes("light_source { 0, rgb 1 cylinder point_at y radius -1 falloff 2 }"), "E0353");
  EXPECT_EQ(codes("light_source { 0, rgb 1 orient }"), "E0257");
}

TEST(Light, WithoutColourOrDirectionIsBlackAndSaysSo) {
  for (auto const& [text, code] :
       {std::pair{"light_source { 0 shadowless }", "E0250"},
        std::pair{"light_source { y, rgb 1 spotlight point_at y }", "E0353"},
        std::pair{"light_source { y, rgb 1 parallel point_at y }", "E0353"}}) {
    auto const e = evaluate(text);
    EXPECT_TRUE(e.ok());
    EXPECT_EQ(codes(text), code);
    ASSERT_EQ(e.scene.lights.size(), 1u);
    EXPECT_EQ(e.scene.lights[0].colour.rgb, Vec3(0));
  }
}

TEST(Light, AFadePowerBelowZeroWarns) {
  EXPECT_TRUE(evaluate("light_source { 0, rgb 1 fade_distance 2 fade_power -1 }").ok());
  EXPECT_EQ(codes("light_source { 0, rgb 1 fade_distance 2 fade_power -1 }"), "E0353");
}

TEST(Sky, PigmentsStack) {
  auto const s = scene_of(
      "sky_sphere { pigment { gradient y color_map { [0 rgb 1] [1 rgb <0, 0, 1>] } scale 2 }\n"
      "pigment { rgbt <1, 1, 1, 0.5> } emission 0.5 rotate 90*x }\nbackground { rgb 0.1 }");
  ASSERT_TRUE(s.sky_sphere);
  EXPECT_EQ(s.sky_sphere->pigments.size(), 2u);
  EXPECT_EQ(s.sky_sphere->emission.rgb, Vec3(0.5));
  EXPECT_EQ(s.background.rgb, Vec3(0.1));
}

TEST(Spectrum, EveryFormIsRead) {
  auto const s = scene_of("#macro L(S) light_source { 0, S } #end\n"
                          "L(spectrum { [400, 0.1] [500, 0.6] [700, 0.2] })\n"
                          "L(spectrum { blackbody 5600 })\nL(spectrum { illuminant \"D65\" })\n"
                          "L(spectrum { lines { [404.66, 0.3] [546.07, 1.0] [578.0, 0.7] } })\n"
                          "L(spectrum { illuminant \"sodium\" })");
  ASSERT_EQ(s.lights.size(), 5u);
  for (auto const& light : s.lights) EXPECT_TRUE(light.colour.spectrum);
  // A light of the sRGB white point is white: the tolerance is that of the 5 nm table of D65.
  expect_near(optics::light_rgb(*s.lights[2].colour.spectrum), Vec3(1), 2e-3);
}

TEST(Spectrum, MistakesAreNamedOnce) {
  EXPECT_EQ(codes("light_source { 0, spectrum { illuminant \"D66\" } }"), "E0413");
  EXPECT_EQ(codes("light_source { 0, spectrum { blackbody 0 } }"), "E0415");
  EXPECT_EQ(codes("light_source { 0, spectrum { [500, 1] [400, 1] } }"), "E0415");
  EXPECT_EQ(codes("light_source { 0, spectrum { } }"), "E0250");
  EXPECT_EQ(codes("sphere { 0, 1 pigment { spectrum { \"Au\" } } }"), "E0420");
}

TEST(NotRendered, EveryWordIsReadAndToldOnce) {
  EXPECT_EQ(
      codes("global_settings { radiosity { brightness 1 count 35, 1600 error_bound 1.8\n"
            "gray_threshold 0 low_error_factor .5 minimum_reuse .015 maximum_reuse .2\n"
            "nearest_count 5, 2 recursion_limit 2 max_sample -1 adc_bailout .01 normal off\n"
            "media on subsurface off pretrace_start .08 pretrace_end .04 always_sample no } }"),
      "E0903");
  EXPECT_EQ(codes("global_settings { photons { spacing .1 count 100 gather 20, 100 media 10, 1\n"
                  "jitter .4 max_trace_level 4 adc_bailout .01 autostop .5\n"
                  "expand_thresholds .2, 35 radius .1, 2, .1, 2 load_file \"a.ph\" } }"),
            "E0904 E0904 E0903");
  EXPECT_EQ(codes("global_settings { subsurface { samples 50, 50 radiosity off } }"), "E0903");
  EXPECT_EQ(codes("media { absorption .1 emission rgb 1 scattering { 5, .1 eccentricity .3\n"
                  "extinction 1 } method 3 intervals 1 samples 3, 4 confidence .9 variance .1\n"
                  "ratio .9 jitter .5 aa_level 3 aa_threshold .1 collect off translate x\n"
                  "density { checker density { rgb 1 } density { gradient x } }\n"
                  "density { bozo density_map { [0 rgb 1] [1 wood turbulence 1] } scale 2 } }\n"
                  "media { emission 1 }"),
            "E0903");
}

TEST(NotRendered, WithoutTheGlobalBlockNothingIsMissing) {
  scene_of("#default { radiosity { importance .5 } }\n"
           "sphere { 0, 1 finish { subsurface { translucency .5 anisotropy rgb .1 } }\n"
           "photons { target 1 refraction on reflection off collect on pass_through }\n"
           "radiosity { importance .5 } no_radiosity }\n"
           "light_source { 0, 1 photons { refraction on reflection on } }");
}

TEST(NotRendered, MediaIsToldWhereItIsUsed) {
  std::string const declared =
      "#declare D = density { spherical color_map { [0 rgb 0] [1 rgb 1] } }\n"
      "#declare M = media { emission 1 density { D } density { D scale 2 } }\n"
      "#declare Map = density_map { [0 D] [1 rgb 1] }\n"
      "#declare I = interior { media { M } }\n";
  scene_of(declared);
  EXPECT_EQ(codes(declared + "sphere { 0, 1 interior { I } } media { M }"), "E0903");
}

TEST(NotRendered, StrictMakesItAnError) {
  for (std::string const text :
       {"media { emission 1 } effects strict", "effects { strict } media { emission 1 }"}) {
    Evaluated const evaluated = evaluate(text);
    ASSERT_EQ(evaluated.diagnostics.size(), 1u);
    EXPECT_EQ(evaluated.diagnostics[0].severity, Severity::Error);
  }
}

TEST(Unsupported, TheListAndTheDocumentationAgree) {
  std::set<std::string> listed;
#define ABBE_UNSUPPORTED(word, where, what)                                                        \
  listed.insert(std::string("| `") + word + "` | " + where + " | " + what + " |");
#include "lang/unsupported.def"
#undef ABBE_UNSUPPORTED
  std::ifstream stream(ABBE_SOURCE_DIR "/docs/compatibility.md");
  std::set<std::string> documented;
  bool in_table = false;
  for (std::string line; std::getline(stream, line);) {
    if (line == "<!-- unsupported -->") in_table = true;
    if (line == "<!-- /unsupported -->") in_table = false;
    if (in_table && line.rfind("| `", 0) == 0) documented.insert(line);
  }
  EXPECT_EQ(documented, listed);
}

TEST(StandardLibrary, EveryFileIsReadWithoutAMessage) {
  auto const s = scene_of("#include \"colors.inc\"\n#include \"glasses.inc\"\n#include "
                          "\"metals.inc\"\n#include \"lamps.inc\"\n"
                          "background { SkyBlue }\nlight_source { 0, Lamp_Sodium() * 2 }\n"
                          "light_source { 0, Lamp_Mercury_Lines() }\n"
                          "sphere { 0, 1 interior { glass { Glass_BK7() } } }\n"
                          "sphere { 0, 1 texture { pigment { Orange } Finish_Gold() } }\n"
                          "sphere { 0, 1 Texture_Metal(\"Cr\") }");
  EXPECT_EQ(s.background.rgb, Vec3(0.196078, 0.6, 0.8));
  EXPECT_EQ(s.lights[0].colour.rgb, Vec3(2));
  EXPECT_TRUE(s.objects[1].texture->front().finish->reflection->metal);
}

} // namespace
} // namespace abbe::lang
