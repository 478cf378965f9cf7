// SPDX-License-Identifier: MIT
#include "blocks_scene.hpp"

namespace abbe::lang {
namespace {

/// Rounding of a rotation by 90 degrees and a few sums.
constexpr double rounding = 1e-14;

/// Where the centre of a sphere of radius 1 stands.
Vec3 centre(scene::Object const& object) {
  return object.placement.point(Vec3(0));
}
double red(scene::Object const& object) {
  return object.texture->back().pigment.colour.rgb.x;
}

TEST(Object, TransformsActInOrder) {
  auto const s = scene_of("sphere { 0, 1 translate x rotate 90*z }\n"
                          "sphere { 0, 1 rotate 90*z translate x }\n"
                          "#declare T = transform { translate x rotate 90*z }\n"
                          "sphere { 0, 1 transform T }\n"
                          "sphere { 0, 1 transform { T inverse } }\n"
                          "sphere { 0, 1 matrix <1, 0, 0, 0, 1, 0, 0, 0, 1, 5, 6, 7> }\n"
                          "sphere { <1, 2, 3>, 1 scale <2, 3, 4> }");
  expect_near(centre(s.objects[0]), Vec3(0, 1, 0), rounding);
  expect_near(centre(s.objects[1]), Vec3(1, 0, 0), rounding);
  expect_near(centre(s.objects[2]), Vec3(0, 1, 0), rounding);
  expect_near(centre(s.objects[3]), Vec3(-1, 0, 0), rounding);
  expect_near(centre(s.objects[4]), Vec3(5, 6, 7), rounding);
  expect_near(centre(s.objects[5]), Vec3(2, 6, 12), rounding);
}

TEST(Object, TexturesMoveWithTransformsAfterThem) {
  auto const s =
      scene_of("sphere { 0, 1 texture { pigment { checker } } translate x }\n"
               "sphere { 0, 1 translate x texture { pigment { checker } } }\n"
               "sphere { 0, 1 texture { pigment { checker } translate y } translate x }");
  expect_near(s.objects[0].texture->front().placement.point(Vec3(0)), Vec3(1, 0, 0), 0);
  expect_near(s.objects[1].texture->front().placement.point(Vec3(0)), Vec3(0), 0);
  expect_near(s.objects[2].texture->front().placement.point(Vec3(0)), Vec3(1, 1, 0), 0);
}

TEST(Object, APatternGivenToAColourThatWasMovedIsMovedToo) {
  // As in POV-Ray (looked at: a box with texture { pigment { rgb 1 } scale 3 } pigment { gradient x
  // } shows the gradient three times as wide). The first cell of the checker has moved by x.
  auto const s =
      scene_of("sphere { 0, 1 texture { finish { ambient 1 } } translate x pigment { checker } }");
  scene::Texture const& t = s.objects[0].texture->front();
  Vec3 const inside_first_cell(0.5, 0.5, 0.5);
  Vec3 const there = t.placement.inverse().point(inside_first_cell);
  EXPECT_EQ(t.pigment.pattern->evaluate(there), 1);
}

TEST(Object, APigmentOrFinishChangesWhatTheTextureHas) {
  // Each case was rendered by POV-Ray 3.7.0.10.
  auto const s =
      scene_of("#declare T = texture { pigment { rgb 0.2 } finish { ambient 0.5 diffuse 0 } }\n"
               "#declare G = texture { pigment { gradient x } scale 3 }\n"
               "sphere { 0, 1 texture { T } finish { phong 1 } }\n"
               "sphere { 0, 1 texture { T finish { phong 1 } pigment { } } }\n"
               "sphere { 0, 1 texture { G } pigment { scale 2 } }\n"
               "sphere { 0, 1 texture { G } pigment { gradient y } }");
  for (int i = 0; i < 2; ++i) {
    scene::Texture const& t = s.objects[static_cast<std::size_t>(i)].texture->front();
    EXPECT_EQ(t.finish->ambient.rgb, Vec3(0.5));
    EXPECT_EQ(t.finish->phong, 1);
    EXPECT_EQ(t.pigment.colour.rgb, Vec3(0.2));
  }
  auto const value = [&](std::size_t i, Vec3 const& at) {
    scene::Texture const& t = s.objects[i].texture->front();
    return t.pigment.pattern->evaluate(t.placement.inverse().point(at));
  };
  EXPECT_NEAR(value(2, Vec3(1.05, 0, 0)), 0.175, 1e-15);
  EXPECT_NEAR(value(3, Vec3(0, 1.5, 0)), 0.5, 1e-15);
}

TEST(Object, TexturesStackInLayers) {
  auto const s =
      scene_of("sphere { 0, 1 texture { pigment { rgb 0.1 } } texture { pigment { rgb 0.2 } }\n"
               "  pigment { rgb 0.3 } }");
  ASSERT_EQ(s.objects[0].texture->size(), 2u);
  EXPECT_EQ(s.objects[0].texture->front().pigment.colour.rgb.x, 0.1);
  EXPECT_EQ(s.objects[0].texture->back().pigment.colour.rgb.x, 0.3);
}

TEST(Object, CopiesAreSnapshotsAndCanBeChanged) {
  auto const s = scene_of("#declare S = sphere { 0, 1 pigment { rgb 0.1 } }\n"
                          "object { S translate x }\nS\nobject { S pigment { rgb 0.2 } }\n"
                          "#declare S = sphere { 0, 2 }\nsphere { S }");
  ASSERT_EQ(s.objects.size(), 4u);
  expect_near(centre(s.objects[0]), Vec3(1, 0, 0), 0);
  expect_near(centre(s.objects[1]), Vec3(0), 0);
  EXPECT_EQ(red(s.objects[1]), 0.1);
  EXPECT_EQ(red(s.objects[2]), 0.2);
  expect_near(s.objects[3].placement.vector(Vec3(1, 0, 0)), Vec3(2, 0, 0), 0);
}

TEST(Object, PartsTakeTheTextureOfTheWhole) {
  auto const s =
      scene_of("union { sphere { 0, 1 } sphere { 0, 1 pigment { rgb 0.1 } }\n"
               "  difference { sphere { 0, 1 } box { 0, 1 } }\n"
               "  pigment { rgb 0.9 } translate x interior { ior 1.3 } no_shadow hollow }");
  scene::Object const& whole = s.objects[0];
  EXPECT_EQ(red(whole.children[0]), 0.9);
  EXPECT_EQ(red(whole.children[1]), 0.1);
  EXPECT_EQ(red(whole.children[2].children[1]), 0.9);
  EXPECT_EQ(whole.children[2].children[0].interior, whole.interior);
  EXPECT_TRUE(*whole.children[2].children[0].no_shadow);
  EXPECT_TRUE(*whole.children[2].children[0].hollow);
  // Everything is in world space: the whole's placement is worked in.
  EXPECT_TRUE(whole.placement.identity());
  expect_near(centre(whole.children[0]), Vec3(1, 0, 0), 0);
}

TEST(Object, PatternsMoveWithTheWholeAndPlainColoursAreShared) {
  auto const s = scene_of("#declare A = sphere { 0, 1 pigment { rgb 0.5 } }\n"
                          "union { sphere { 0, 1 } pigment { gradient x } translate x }\n"
                          "object { A translate x } object { A translate 2*x }");
  auto const place = [](scene::Object const& object) {
    return object.texture->front().placement.point(Vec3(0));
  };
  expect_near(place(std::as_const(s.objects[0].children)[0]), Vec3(1, 0, 0), 0);
  // They look alike everywhere, and have no place.
  expect_near(place(s.objects[1]), Vec3(0), 0);
  EXPECT_TRUE(s.objects[1].texture.shares(s.objects[2].texture));
}

TEST(Object, HollowOfAPartWins) {
  auto const s = scene_of("union { sphere { 0, 1 hollow off } sphere { 0, 1 } hollow }");
  EXPECT_FALSE(*s.objects[0].children[0].hollow);
  EXPECT_TRUE(*s.objects[0].children[1].hollow);
}

TEST(Object, TheDefaultTextureIsTheOneAtInsertion) {
  auto const s = scene_of("#declare S = sphere { 0, 1 }\n"
                          "#default { pigment { rgb 0.5 } }\nS\n"
                          "#default { texture { pigment { rgb 0.6 } finish { ambient 0.7 } } }\n"
                          "sphere { S finish { diffuse 0 } }");
  EXPECT_EQ(red(s.objects[0]), 0.5);
  EXPECT_EQ(red(s.objects[1]), 0.6);
  EXPECT_EQ(s.objects[1].texture->front().finish->ambient.rgb, Vec3(0.7));
  EXPECT_EQ(s.objects[1].texture->front().finish->diffuse, 0);
}

TEST(Object, GlassWithoutTextureIsClear) {
  auto const s = scene_of("sphere { 0, 1 interior { glass { cauchy <1.5, 0.004> } } }\n"
                          "union { sphere { 0, 1 } interior { glass { abbe 1.5, 60 } } }\n"
                          "sphere { 0, 1 interior { ior 1.5 } }");
  EXPECT_EQ(s.objects[0].texture->front().pigment.colour.transmit, 1);
  EXPECT_EQ(s.objects[0].texture->front().finish->diffuse, 0);
  EXPECT_EQ(s.objects[1].children[0].texture->front().pigment.colour.transmit, 1);
  EXPECT_EQ(s.objects[2].texture->front().pigment.colour.transmit, 0);
}

TEST(Object, ClippingObjectsMoveAlong) {
  auto const s = scene_of("sphere { 0, 1 clipped_by { plane { y, 0 } } translate 3*y }\n"
                          "sphere { 0, 1 bounded_by { box { -1, 1 } } clipped_by { bounded_by } }");
  ASSERT_EQ(s.objects[0].clipped_by.size(), 1u);
  expect_near(s.objects[0].clipped_by[0].placement.point(Vec3(0)), Vec3(0, 3, 0), 0);
  EXPECT_EQ(s.objects[1].clipped_by.size(), 1u);
  EXPECT_TRUE(s.objects[1].bounded_by.empty());
}

TEST(Object, LightsInAUnionMoveWithIt) {
  auto const s = scene_of(
      "union { light_source { 0, rgb 1 translate x } sphere { 0, 1 } scale 2 translate y }");
  ASSERT_EQ(s.lights.size(), 1u);
  expect_near(s.lights[0].position, Vec3(2, 1, 0), 0);
}

TEST(Object, ALightStandsWhereAnObjectCan) {
  auto const s =
      scene_of("#declare L = light_source { 0, rgb 1 }\n"
               "object { L translate x } union { object { L } sphere { 0, 1 } translate y }");
  ASSERT_EQ(s.lights.size(), 2u);
  EXPECT_EQ(s.lights[0].position, Vec3(1, 0, 0));
  EXPECT_EQ(s.lights[1].position, Vec3(0, 1, 0));
  ASSERT_EQ(s.objects.size(), 1u);
  EXPECT_EQ(s.objects[0].children.size(), 1u);
}

TEST(Object, DirectivesMayYieldParts) {
  auto const s =
      scene_of("#macro Ball(P) sphere { P, 1 } #end\n"
               "union { #for (I, 1, 3) Ball(I*x) #end #if (1) scale 2 #else rotate 5 #end }");
  ASSERT_EQ(s.objects[0].children.size(), 3u);
  expect_near(centre(s.objects[0].children[2]), Vec3(6, 0, 0), 0);
}

TEST(Object, MistakesAreNamedOnce) {
  EXPECT_EQ(codes("union { sphere { 0, 1 } translate x sphere { 0, 1 } }"), "E0251");
  EXPECT_EQ(codes("object { translate x }"), "E0203");
  EXPECT_EQ(codes("object { }"), "E0250");
  EXPECT_EQ(codes("object { Undeclared }"), "E0202");
  EXPECT_EQ(codes("#declare B = parametric { 1 } object { B translate x }"), "E0901");
  EXPECT_EQ(codes("union { shpere { 0, 1 } box { 0, 1 } }"), "E0202");
  EXPECT_EQ(codes("union { }"), "E0250");
  EXPECT_EQ(codes("sphere { 0, 1 scale <1, 0, 1> }"), "E0350");
  EXPECT_EQ(codes("sphere { 0, 1 matrix <1, 1, 0, 2, 2, 0, 0, 0, 1, 5, 6, 7> }"), "E0351");
  // A column of zeros is mended, as a scale of 0.
  EXPECT_EQ(codes("sphere { 0, 1 matrix <1, 0, 0, 2, 0, 0, 0, 0, 1, 5, 6, 7> }"), "E0350");
  EXPECT_EQ(codes("pigment { rgb 1 }"), "E0255");
  EXPECT_EQ(codes("parametric { Radius }"), "E0901");
  EXPECT_EQ(codes("union { parametric { 1 } translate x }"), "E0901");
  EXPECT_EQ(codes("object { parametric { function { x*x + f_rounded(y) } } translate x }"),
            "E0901");
}

} // namespace
} // namespace abbe::lang
