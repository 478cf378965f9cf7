// SPDX-License-Identifier: MIT
#include "blocks_scene.hpp"

namespace abbe::lang {
namespace {

scene::Pigment pigment(std::string const& items) {
  return scene_of("sphere { 0, 1 pigment { " + items + " } }").objects[0].texture->front().pigment;
}
double value(scene::Pigment const& p, Vec3 const& at) {
  return p.pattern->evaluate(at);
}

TEST(Pigment, MapsOldAndNew) {
  auto const p =
      pigment("gradient x color_map { [0 rgb 0] [0.2, 0.5 color rgb 1 color rgb <1, 0, 0>]\n"
              "[0.7 color rgb 0.3 transmit 0.5] }");
  ASSERT_EQ(p.entries.size(), 4u);
  EXPECT_EQ(p.entries[1].value, 0.2);
  EXPECT_EQ(p.entries[2].value, 0.5);
  EXPECT_EQ(p.entries[2].pigment->colour.rgb, Vec3(1, 0, 0));
  EXPECT_EQ(p.entries[3].pigment->colour.transmit, 0.5);
}

TEST(Pigment, MapsTakeColourNames) {
  auto const s = scene_of(
      "#declare Red = rgb <1, 0, 0>; #declare M = color_map { [0 Red filter 0.5] [1 Red*0.5] }\n"
      "sphere { 0, 1 pigment { bozo color_map { M } } }");
  auto const& p = s.objects[0].texture->front().pigment;
  EXPECT_EQ(p.entries[0].pigment->colour.filter, 0.5);
  EXPECT_EQ(p.entries[1].pigment->colour.rgb, Vec3(0.5, 0, 0));
}

TEST(Pigment, PigmentMapsNest) {
  auto const p = pigment("gradient y pigment_map { [0 checker rgb 1, rgb 0 scale 0.5] [1 rgb 1] }");
  ASSERT_EQ(p.entries.size(), 2u);
  EXPECT_EQ(p.entries[0].pigment->entries.size(), 2u);
  EXPECT_EQ(value(*p.entries[0].pigment, Vec3(0.75, 0.25, 0.25)), 1);
}

TEST(Pigment, DefaultMapsArePovRays) {
  // Section 7.1 of the language notes: checker is blue and green.
  auto const checker = pigment("checker rgb 1");
  ASSERT_EQ(checker.entries.size(), 2u);
  EXPECT_EQ(checker.entries[0].pigment->colour.rgb, Vec3(1));
  EXPECT_EQ(checker.entries[1].pigment->colour.rgb, Vec3(0, 1, 0));
  auto const marble = pigment("marble");
  EXPECT_EQ(marble.entries[0].pigment->colour.rgb, Vec3(0.9, 0.8, 0.8));
  auto const leopard = pigment("leopard");
  ASSERT_EQ(leopard.entries.size(), 2u);
  EXPECT_EQ(leopard.entries[1].pigment->colour.rgb, Vec3(1));
}

TEST(Pigment, TransformsOfOnePatternAreOneMapping) {
  auto const p = pigment("gradient x translate x rotate 90*z scale 2");
  ASSERT_EQ(p.pattern->mappings.size(), 1u);
  // (0, 2 + 2a, 0) in space is a along x of the pattern.
  EXPECT_NEAR(value(p, Vec3(0, 2.5, 0)), 0.25, 1e-14);
}

TEST(Pigment, PatternOptionsMayStandBehindTheColours) {
  auto const p =
      pigment("brick rgb 1, rgb 0 brick_size <2, 1, 1> mortar 0.1 turbulence 0.1 octaves 3");
  EXPECT_EQ(p.entries.size(), 2u);
  EXPECT_EQ(p.pattern->modifiers.turbulence->octaves, 3);
}

TEST(Pigment, ACopyKeepsItsMapUnderAnotherPattern) {
  auto const s =
      scene_of("#declare P = pigment { bozo color_map { [0 rgb 0.1] [1 rgb 0.2] } scale 2 }\n"
               "sphere { 0, 1 pigment { P gradient x } }\n"
               "#declare Q = pigment { wood } sphere { 0, 1 pigment { Q leopard } }");
  EXPECT_EQ(s.objects[0].texture->front().pigment.entries[0].pigment->colour.rgb, Vec3(0.1));
  EXPECT_EQ(value(s.objects[0].texture->front().pigment, Vec3(0.5, 0, 0)), 0.25);
  EXPECT_EQ(s.objects[1].texture->front().pigment.entries[1].pigment->colour.rgb, Vec3(1));
}

TEST(Pigment, MistakesAreNamedOnce) {
  EXPECT_EQ(codes("sphere { 0, 1 pigment { color_map { [0 rgb 1] } } }"), "E0250");
  EXPECT_EQ(codes("sphere { 0, 1 pigment { checker color_map { [0 rgb 1] } } }"), "E0252");
  EXPECT_EQ(codes("sphere { 0, 1 pigment { bozo color_map { } } }"), "E0250");
  EXPECT_EQ(codes("sphere { 0, 1 pigment { bozo color_map { [1 rgb 1] [0 rgb 1] } } }"), "E0356");
  EXPECT_EQ(codes("sphere { 0, 1 pigment { image_map { png \"a.png\" once } scale 2 } }"), "E0501");
  EXPECT_EQ(codes("sphere { 0, 1 pigment { wood pigment_map { [bozo] [1 wood] } } }"), "E0301");
  EXPECT_EQ(codes("sphere { 0, 1 pigment { function(a) { a } color_map { [0 rgb 1] } } }"),
            "E0622");
  EXPECT_EQ(codes("sphere { 0, 1 texture { checker texture { } texture { T2 } scale 2 } }"),
            "E0202");
  EXPECT_EQ(codes("sphere { 0, 1 texture { bozo scale 2 } }"), "E0250");
  EXPECT_EQ(codes("sphere { 0, 1 pigment { rgb 1 } normal { pavement } }"), "E0901");
}

} // namespace
} // namespace abbe::lang
