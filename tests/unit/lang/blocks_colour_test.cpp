// SPDX-License-Identifier: MIT
#include "blocks_scene.hpp"

namespace abbe::lang {
namespace {

scene::Colour background(std::string const& colour) {
  return scene_of("global_settings { assumed_gamma 1 }\n" + colour).background;
}

void expect_colour(scene::Colour const& c, Vec3 rgb, double filter, double transmit) {
  // srgb decoding is compared to the six digits that POV-Ray prints.
  expect_near(c.rgb, rgb, 5e-7);
  EXPECT_EQ(c.filter, filter);
  EXPECT_EQ(c.transmit, transmit);
}

// Each expected value was printed by POV-Ray 3.7.0.10 with vstr(5, ...).
TEST(Colour, VectorFormsPutTheirComponentsWherePovRayDoes) {
  expect_colour(background("background { rgb <1, 2, 3, .4, .5> }"), {1, 2, 3}, .4, .5);
  expect_colour(background("background { rgb 0.5 }"), Vec3(0.5), 0, 0);
  expect_colour(background("background { rgbf <.1, .2, .3, .4> }"), {.1, .2, .3}, .4, 0);
  expect_colour(background("background { rgbt <.1, .2, .3, .4, .5> }"), {.1, .2, .3}, 0, .4);
  expect_colour(background("background { rgbft <.1, .2, .3, .4, .5> }"), {.1, .2, .3}, .4, .5);
  expect_colour(background("#declare R = rgbft <.1, .2, .3, .4, .5>; background { rgb R*2 }"),
                {.2, .4, .6}, .8, 1);
}

TEST(Colour, SrgbIsDecodedToTheWorkingSpace) {
  // IEC 61966-2-1: 0.5 -> 0.214041
  expect_colour(background("background { srgb 0.5 }"), Vec3(0.214041), 0, 0);
  expect_colour(background("background { srgbt <0.5, 0, 1, 0.25> }"), {0.214041, 0, 1}, 0, 0.25);
}

TEST(Colour, SrgbFollowsAssumedGamma) {
  auto const s = scene_of("global_settings { assumed_gamma 2.2 } background { srgb 0.5 }");
  // 0.2140411 ^ (1 / 2.2)
  expect_near(s.background.rgb, Vec3(0.4962272), 1e-6);
  auto const same = scene_of("global_settings { assumed_gamma srgb } background { srgb 0.5 }");
  EXPECT_EQ(same.background.rgb, Vec3(0.5));
  EXPECT_EQ(codes("background { srgb 0.5 }"), "E0355");
}

TEST(Colour, ComponentsFollowInAnyOrder) {
  expect_colour(background("background { color <.1, .2> red 5 }"), {5, .2, 0}, 0, 0);
  expect_colour(background("background { blue .5 transmit .25 red 1 }"), {1, 0, .5}, 0, .25);
  expect_colour(background("background { color rgb <1, 1, 0> filter .5 }"), {1, 1, 0}, .5, 0);
}

TEST(Colour, ALoneScalarFillsAllFiveWhereOnlyAColourCanStand) {
  expect_colour(background("background { 0.4 }"), Vec3(0.4), 0.4, 0.4);
  expect_colour(background("background { <1, 0, 1> }"), {1, 0, 1}, 0, 0);
}

TEST(Colour, ABareVectorIsNoColourInAPigment) {
  EXPECT_EQ(codes("sphere { 0, 1 pigment { <1, 0, 0> } }"), "E0354");
  EXPECT_EQ(codes("#declare V = <1, 0, 0>; sphere { 0, 1 pigment { V } }"), "E0354");
  EXPECT_EQ(codes("#declare V = <1, 0, 0>; sphere { 0, 1 pigment { color V } }"), "");
  EXPECT_EQ(codes("#declare C = rgb <1, 0, 0>; sphere { 0, 1 pigment { C } }"), "");
}

TEST(Colour, ASpectrumStandsWhereverAColourMay) {
  auto const s =
      scene_of("#declare S = spectrum { [400, 0.1] [700, 0.3] };\n"
               "light_source { 0, spectrum { blackbody 5600 } }\n"
               "light_source { 0, S * 2 }\n"
               "sphere { 0, 1 pigment { S } }\n"
               "sphere { 0, 1 pigment { spectrum { [400, 0.1] [700, 0.3] } filter 0.5 } }");
  ASSERT_EQ(s.lights.size(), 2u);
  EXPECT_TRUE(s.lights[0].colour.spectrum);
  ASSERT_TRUE(s.lights[1].colour.spectrum);
  EXPECT_EQ(s.lights[1].colour.rgb, Vec3(2));
  EXPECT_TRUE(s.objects[0].texture->front().pigment.colour.spectrum);
  EXPECT_EQ(s.objects[1].texture->front().pigment.colour.filter, 0.5);
}

} // namespace
} // namespace abbe::lang
