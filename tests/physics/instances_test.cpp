// SPDX-License-Identifier: MIT
#include "pixel.hpp"

#include <set>

/// Declared unions that are stored once look as their copies do.
namespace abbe::physics {
namespace {

struct Made {
  image::Image picture;
  std::size_t objects = 0;   ///< that are stored, each once
  std::size_t instances = 0; ///< objects of the scene that are stored once
};

/// Objects that are stored once, in copies of what they are part of too.
std::size_t stored_in(scene::Object const& object) {
  std::size_t count = object.instance ? 1 : 0;
  for (auto const& part : object.children) count += stored_in(part);
  return count;
}

/// Objects of the scene that are stored, each once.
std::size_t objects_in(scene::Object const& object, std::set<scene::Object const*>& seen) {
  if (!seen.insert(&object).second) return 0;
  std::size_t count = 1;
  if (object.instance) count += objects_in(*object.instance, seen);
  for (auto const& part : object.children) count += objects_in(part, seen);
  return count;
}

Made make(std::string const& body, double most_copied) {
  lang::EvaluateOptions reading;
  reading.stdlib_dir = ABBE_STDLIB_DIR;
  reading.most_copied_shapes = most_copied;
  auto const evaluated = lang::evaluate_text(
      "test.scn", "#version 3.7; global_settings { assumed_gamma 1 }\n" + body, reading);
  for (Diagnostic const& d : evaluated.diagnostics) ADD_FAILURE() << format(d);
  Made made;
  std::set<scene::Object const*> seen;
  for (auto const& object : evaluated.scene.objects) {
    made.instances += stored_in(object);
    made.objects += objects_in(object, seen);
  }
  auto const plan = plan::make_plan(evaluated.scene, {});
  ABBE_ASSERT(plan);
  render::RenderOptions options;
  options.width = 64;
  options.height = 48;
  options.threads = 2;
  made.picture = render::render(evaluated.scene, *plan, options).image;
  return made;
}

constexpr char const* room = R"(
camera { location <3, 9, -20> look_at <3, 2, 3> angle 50 }
light_source { <20, 30, -20> rgb 1 }
light_source { <-20, 10, -10> rgb <0.2, 0.3, 0.5> }
plane { y, -1 pigment { rgb <0.6, 0.7, 0.6> } finish { reflection 0.2 } }
)";

/// 64 balls, rings and boxes of three textures, in unions of unions; placed, turned, in a texture
/// that those get which have none.
constexpr char const* things = R"(
#declare A = union {
  sphere { 0, 0.4 pigment { rgb <0.9, 0.2, 0.1> } finish { phong 0.5 } }
  torus { 0.5, 0.1 rotate 30*x }
  box { <0.6, 0, 0>, <0.9, 0.7, 0.4> pigment { rgb <0.2, 0.4, 0.9> } finish { reflection 0.3 } }
  triangle { <0, 0.5, 0>, <0.6, 1, 0>, <0, 1, 0.5> pigment { rgb <1, 0.9, 0.1> } }
}
#for (I, 0, 3)
#declare A = union { object { A } object { A translate pow(2, floor(I/2)) * (mod(I, 2) ? z : x) } }
#end
#declare A = union { object { A } }
)";

void expect_the_same(std::string const& placed, std::size_t instances) {
  auto const copied = make(std::string(room) + things + placed, 1e9);
  auto const stored = make(std::string(room) + things + placed, 0);
  EXPECT_EQ(copied.instances, 0u);
  EXPECT_EQ(stored.instances, instances);
  ASSERT_EQ(copied.picture.rgb.size(), stored.picture.rgb.size());
  std::size_t lit = 0;
  for (std::size_t i = 0; i < copied.picture.rgb.size(); ++i) {
    EXPECT_NEAR(copied.picture.rgb[i], stored.picture.rgb[i], 1e-6F) << i / 3;
    lit += copied.picture.rgb[i] > 0.05F;
  }
  EXPECT_GT(lit, copied.picture.rgb.size() / 4);
}

TEST(Instances, LookAsCopiesDo) {
  expect_the_same("object { A }", 1);
  expect_the_same("object { A } object { A scale 0.5 rotate <10, 50, 20> translate <4, 1, 0> }", 2);
}
TEST(Instances, TakeTexturesOfWhatTheyArePartOf) {
  expect_the_same("object { A pigment { rgb <0.1, 0.8, 0.3> } }\n"
                  "object { A pigment { rgb <0.8, 0.1, 0.3> } translate 5*x no_shadow }",
                  2);
}
TEST(Instances, WithWhatTheyCannotHaveAreCopied) {
  expect_the_same("object { A clipped_by { plane { y, 0.3 } } }", 0);
  expect_the_same("object { A pigment { checker rgb 1 rgb 0 scale 0.2 } }", 0);
  expect_the_same("object { A hollow interior { ior 1.5 } }", 0);
  expect_the_same("intersection { object { A } box { -0.3, 0.8 } pigment { rgb 1 } }", 0);
}
TEST(Instances, OfUnionsWithinOthersKeepTheirPlaces) {
  expect_the_same("union { object { A } sphere { <2, 4, 2>, 1 pigment { rgb 1 } } rotate 20*y }",
                  1);
}

/// 2^40 balls: no copy could be made. Only the nearest ones are seen.
TEST(Instances, MayBeMoreThanAnyMemoryHolds) {
  auto const made = make("camera { location <0, 3, -12> look_at 0 angle 60 }\n"
                         "light_source { <-5, 20, -40> rgb 1 }\n"
                         "#declare A = sphere { 0, 0.4 pigment { rgb <0.7, 0.4, 0.3> } }\n"
                         "#for (I, 0, 39)\n"
                         "#declare A = union { object { A } object { A translate pow(2, "
                         "floor(I/3)) * (mod(I, 3) = 0 ? x : mod(I, 3) = 1 ? y : z) } }\n"
                         "#end\n"
                         "object { A translate <-100, -50, 0> }",
                         0x1p20);
  EXPECT_EQ(made.instances, 1u);
  // The lowest six doublings are copied into one definition, each of the others has two parts.
  EXPECT_LE(made.objects, 250u);
  double sum = 0;
  for (float const value : made.picture.rgb) sum += static_cast<double>(value);
  EXPECT_GT(sum / static_cast<double>(made.picture.rgb.size()), 0.05);
}

} // namespace
} // namespace abbe::physics
