// SPDX-License-Identifier: MIT
#include "blocks_scene.hpp"
#include "optics/conductor.hpp"

#include <cmath>

namespace abbe::lang {
namespace {

scene::Finish finish(std::string const& items) {
  return *scene_of("sphere { 0, 1 finish { " + items + " } }").objects[0].texture->front().finish;
}

TEST(Finish, DefaultsArePovRays) {
  auto const f = finish("");
  EXPECT_EQ(f.ambient.rgb, Vec3(0.1));
  EXPECT_EQ(f.diffuse, 0.6);
  EXPECT_EQ(f.phong_size, 40);
  EXPECT_EQ(f.roughness, 0.05);
  EXPECT_FALSE(f.reflection);
}

TEST(Finish, TakesAllItems) {
  auto const f =
      finish("ambient rgb <0.1, 0.2, 0.3> emission 0.4 diffuse 0.5, 0.25 brilliance 2 phong 0.6\n"
             "phong_size 50 specular 0.7 roughness 0.01 metallic conserve_energy");
  EXPECT_EQ(f.ambient.rgb, Vec3(0.1, 0.2, 0.3));
  EXPECT_EQ(f.emission.rgb, Vec3(0.4));
  EXPECT_EQ(f.diffuse, 0.5);
  EXPECT_EQ(f.diffuse_back, 0.25);
  EXPECT_EQ(f.brilliance, 2);
  EXPECT_EQ(f.phong_size, 50);
  EXPECT_EQ(f.roughness, 0.01);
  EXPECT_EQ(f.metallic, 1);
  EXPECT_TRUE(f.conserve_energy);
}

TEST(Finish, AlbedoScalesByTheLobesWhereverTheyAreWritten) {
  // Section 7 of the language notes.
  auto const f = finish("diffuse albedo 0.5 phong albedo 0.5 specular albedo 0.5 brilliance 3 "
                        "phong_size 9 roughness 0.1");
  EXPECT_EQ(f.diffuse, 1);
  EXPECT_EQ(f.phong, 2.5);
  double const e = 1 / 0.1;
  EXPECT_EQ(f.specular, 0.5 * ((e + 2) / (4 * (2 - std::exp2(-e / 2)))));
}

TEST(Finish, ReflectionTakesOneColourOrTwo) {
  auto const plain = *finish("reflection 0.3").reflection;
  EXPECT_EQ(plain.minimum.rgb, Vec3(0.3));
  EXPECT_EQ(plain.maximum.rgb, Vec3(0.3));
  auto const two =
      *finish("reflection { 0.1, rgb <1, 0, 0> falloff 2 exponent 0.5 metallic }").reflection;
  EXPECT_EQ(two.minimum.rgb, Vec3(0.1));
  EXPECT_EQ(two.maximum.rgb, Vec3(1, 0, 0));
  EXPECT_EQ(two.falloff, 2);
  EXPECT_EQ(two.exponent, 0.5);
  EXPECT_EQ(two.metallic, 1);
  auto const fresnel = *finish("reflection { 0.8 fresnel on }").reflection;
  EXPECT_EQ(fresnel.minimum.rgb, Vec3(0));
  EXPECT_EQ(fresnel.maximum.rgb, Vec3(0.8));
  EXPECT_TRUE(fresnel.fresnel);
}

TEST(Finish, MetalsAreNamed) {
  auto const r = *finish("reflection { metal \"Au\" }").reflection;
  ASSERT_TRUE(r.metal);
  // Gold: much more red than blue comes back.
  EXPECT_GT(r.metal->reflectance(650, 1), 0.9);
  EXPECT_LT(r.metal->reflectance(450, 1), 0.5);
  EXPECT_EQ(codes("sphere { 0, 1 finish { reflection { metal \"Aux\" } } }"), "E0413");
}

TEST(Finish, MistakesAreNamedOnce) {
  EXPECT_EQ(codes("sphere { 0, 1 finish { reflection { } } }"), "E0250");
  EXPECT_EQ(codes("sphere { 0, 1 finish { roughness 0 } }"), "E0353");
  EXPECT_EQ(codes("sphere { 0, 1 finish { irid { 0.3 thickness 0.2 film 1 } } }"), "E0202");
  EXPECT_EQ(codes("sphere { 0, 1 finish { ior 1.5 } }"), "E0901");
  EXPECT_EQ(codes("sphere { 0, 1 finish { subsurface { translucent 1 } diffuse 1 } }"), "E0202");
}

} // namespace
} // namespace abbe::lang
