// SPDX-License-Identifier: MIT
#include "geometry/line.hpp"
#include "geometry/shapes/registry.hpp"
#include "geometry/world.hpp"
#include "scene.hpp"

#include <gtest/gtest.h>
#include <sstream>

namespace abbe::geometry::test {
namespace {

/// Parameters from words between blanks: `<1,2,3>` is a vector, `{` and `}` stand alone.
class Words final : public Parameters {
public:
  explicit Words(std::string const& text) {
    std::istringstream in(text);
    for (std::string word; in >> word;) words_.push_back(word);
  }
  double number(std::string_view) override { return std::stod(take()); }
  int integer(std::string_view, int, int) override { return std::stoi(take()); }
  Vec2 vec2(std::string_view) override {
    Vec4 const v = vector();
    return {v.x, v.y};
  }
  Vec3 vec3(std::string_view) override { return Vec3(vector()); }
  Vec4 vec4(std::string_view) override { return vector(); }
  bool has_value() override {
    return !at_end() && std::string("<-.0123456789").find(next()[0]) < 99;
  }
  bool has_number() override { return has_value() && next()[0] != '<'; }
  bool accept(std::string_view word) override {
    if (at_end() || next() != word) return false;
    ++at_;
    return true;
  }
  std::optional<bool> flag(std::string_view word) override {
    return accept(word) ? std::optional(true) : std::nullopt;
  }
  bool open(std::string_view word) override {
    if (!accept(word)) return false;
    EXPECT_EQ(take(), "{");
    return true;
  }
  void close() override { EXPECT_EQ(take(), "}"); }
  int face_texture() override { return accept("texture") ? textures_++ : -1; }
  bool at_end() override { return at_ >= words_.size() || words_[at_] == "}"; }
  Span next_span() override { return {}; }
  void report(Severity severity, std::string_view code, std::string_view, Span) override {
    if (severity == Severity::Warning) reports += 'W';
    reports.append(code);
    reports += ' ';
  }
  std::string reports;
  bool all_read() const { return at_ == words_.size(); }

private:
  std::string const& next() const { return words_[at_]; }
  std::string take() { return at_ < words_.size() ? words_[at_++] : "0"; }
  Vec4 vector() {
    std::string text = take();
    for (char& c : text) c = c == '<' || c == '>' || c == ',' ? ' ' : c;
    std::istringstream in(text);
    Vec4 v(0);
    in >> v.x >> v.y >> v.z >> v.w;
    return v;
  }
  std::vector<std::string> words_;
  std::size_t at_ = 0;
  int textures_ = 0;
};

struct Read {
  std::optional<PlacedShape> shape;
  std::string reports;
  bool all_read;
};
Read read(std::string const& keyword, std::string const& text) {
  Words words(text);
  for (ShapeKind const& kind : shape_kinds()) {
    if (kind.keyword != keyword) continue;
    auto shape = kind.read(words);
    return {shape, words.reports, words.all_read()};
  }
  return {std::nullopt, "unknown", false};
}

TEST(Reading, GoodShapesReadAllOfTheirParameters) {
  char const* const good[][2] = {
      {"sphere", "<1,2,3> 2"},
      {"box", "<1,1,1> <-1,0,0>"},
      {"plane", "<0,2,0> -1"},
      {"cylinder", "<0,0,0> <0,1,0> 1 open"},
      {"cone", "<0,0,0> 1 <0,1,0> 0 open"},
      {"torus", "1 .25 sturm"},
      {"disc", "<0,0,0> <0,1,0> 1"},
      {"disc", "<0,0,0> <0,1,0> 1 .5"},
      {"quadric", "<1,0,1> <0,0,0> <0,-1,0> 0"},
      {"triangle", "<0,0,0> <1,0,0> <0,1,0>"},
      {"smooth_triangle", "<0,0,0> <0,0,1> <1,0,0> <0,0,1> <0,1,0> <0,0,2>"},
      {"prism", "linear_sweep linear_spline 0 1 4 <0,0> <1,0> <0,1> <0,0> open"},
      {"prism", "conic_sweep 0 1 3 <0,0> <1,0> <0,1>"},
      {"prism", "cubic_spline 0 1 6 <0,1> <0,0> <1,0> <0,1> <0,0> <1,0> sturm open"},
      {"mesh", "triangle { <0,0,0> <1,0,0> <0,1,0> uv_vectors <0,0> <1,0> <0,1> texture } "
               "smooth_triangle { <0,0,0> <0,0,1> <1,0,0> <0,0,1> <0,1,0> <0,0,2> } "
               "inside_vector <0,0,1>"},
      {"mesh2", "vertex_vectors { 3 <0,0,0> <1,0,0> <0,1,0> } texture_list { 2 texture texture } "
                "face_indices { 2 <0,1,2> 1 <0,2,1> 0 1 0 } inside_vector <0,0,1>"},
  };
  for (auto const& [keyword, text] : good) {
    Read const result = read(keyword, text);
    EXPECT_TRUE(result.shape) << keyword;
    EXPECT_EQ(result.reports, "") << keyword;
    EXPECT_TRUE(result.all_read) << keyword;
  }
}

TEST(Reading, BadParametersAreReportedByCode) {
  char const* const bad[][3] = {
      {"sphere", "<0,0,0> 0", "WE0601 "},
      {"box", "<0,0,0> <1,0,0>", "WE0602 "},
      {"box", "<1,2,3> <1,2,3>", "WE0602 "},
      {"plane", "<0,0,0> 1", "E0603 "},
      {"cylinder", "<1,1,1> <1,1,1> 1", "E0604 "},
      {"cylinder", "<0,0,0> <0,1,0> 0", "WE0604 "},
      {"cone", "<0,0,0> 0 <0,1,0> 0", "WE0605 "},
      {"cone", "<0,0,0> 1 <0,0,0> 2", "E0605 "},
      {"disc", "<0,0,0> <0,1,0> 0", "WE0606 "},
      {"disc", "<0,0,0> <0,0,0> 1", "WE0606 "},
      {"quadric", "<0,0,0> <0,0,0> <0,0,0> 1", "WE0607 "},
      {"torus", "1 0", "WE0608 "},
      {"prism", "0 0 3 <0,0> <1,0> <0,1> open", "WE0609 "},
      {"prism", "0 1 3 <1,2> <1,2> <1,2>", "WE0609 "},
      {"polygon", "3 <0,0,0> <1,0,0> <2,0,0>", "WE0631 "},
      {"polygon", "4 <0,0,0> <1,0,0> <1,1,0> <0,1,.1>", "WE0631 "},
      {"blob", "sphere { <0,0,0> 0 1 }", "WE0619 WE0620 "},
      {"blob", "sphere { <0,0,0> 1 1 } threshold -1", "WE0620 "},
      {"sphere_sweep", "linear_spline 2 <0,0,0> 0 <1,0,0> 0", "WE0626 "},
      {"lathe", "2 <1,0> <1,0>", "WE0624 "},
      {"smooth_triangle", "<0,0,0> <0,0,1> <1,0,0> <0,0,1> <0,1,0> <0,0,-1>", "WE0610 "},
      {"prism", "0 1 5 <0,0> <1,0> <0,1>", "E0616 "},
      {"prism", "quadratic_spline 0 1 5 <1,0> <1,0> <0,1> <0,0> <2,2>", "E0633 "},
      {"prism", "bezier_spline 0 1 5 <1,0> <1,0> <0,1> <0,0> <2,2>", "E0623 "},
      {"triangle", "<0,0,0> <1,0,0> <2,0,0>", "WE0610 "},
      {"mesh", "inside_vector <0,0,1>", "E0615 "},
      {"mesh2", "vertex_vectors { 3 <0,0,0> <1,0,0> <0,1,0> } face_indices { 1 <0,1,3> }",
       "E0612 "},
      {"mesh2", "vertex_vectors { 4 <0,0,0> <1,0,0> <0,1,0> } face_indices { 1 <0,1,2> }",
       "E0613 "},
  };
  for (auto const& [keyword, text, code] : bad) {
    Read const result = read(keyword, text);
    EXPECT_FALSE(result.shape) << keyword << " " << text;
    EXPECT_EQ(result.reports, code) << keyword << " " << text;
  }
}

TEST(Reading, WhatIsFlatOrOddIsDrawnWithAWarning) {
  char const* const odd[][3] = {
      {"box", "<0,0,0> <1,0,1>", "WE0602 "},
      {"prism", "0 0 3 <0,0> <1,0> <0,1>", "WE0609 "},
      {"prism", "0 1 4 <0,0> <1,1> <2,2> <0,0>", "WE0609 "},
      {"disc", "<0,0,0> <0,1,0> 1 2", "WE0606 "},
      {"torus", "1 -.2", "WE0608 "},
      {"cone", "<0,0,0> -1 <0,1,0> -.5", "WE0605 "},
      {"cone", "<0,0,0> -1 <0,1,0> .5", ""},
      {"blob", "sphere { <0,0,0> 0 1 } sphere { <0,0,0> 1 1 } threshold .5", "WE0619 "},
      {"superellipsoid", "<0,1>", "WE0627 "},
  };
  for (auto const& [keyword, text, code] : odd) {
    Read const result = read(keyword, text);
    EXPECT_TRUE(result.shape) << keyword << " " << text;
    EXPECT_EQ(result.reports, code) << keyword << " " << text;
    EXPECT_TRUE(result.all_read) << keyword << " " << text;
  }
}

TEST(Reading, FaceTexturesFollowTheFaces) {
  Read const result = read("mesh2", "vertex_vectors { 4 <0,0,0> <1,0,0> <0,1,0> <1,1,0> } "
                                    "texture_list { 2 texture texture } "
                                    "face_indices { 2 <0,1,2> 1 <1,3,2> 0 1 0 }");
  ASSERT_TRUE(result.shape);
  World const world({*result.shape}, {{leaf(0)}});
  ScratchPtr const scratch = World::make_scratch();
  HitGroup hit;
  auto const texture = [&](double x, double y) {
    EXPECT_TRUE(
        world.closest(ray_from({x, y, -1}, {0, 0, 1}), nullptr, 0xff, infinity, *scratch, hit));
    EXPECT_FALSE(hit.crossings[0].toggles);
    return result.shape->shape->face_texture(hit.crossings[0].face);
  };
  EXPECT_EQ(texture(.2, .2), 1);
  EXPECT_EQ(texture(.8, .8), 0);
  Vec3 const in_object = result.shape->placement.inverse().point({.8, .8, 0});
  auto const blend = result.shape->shape->face_blend(in_object, hit.crossings[0].face);
  ASSERT_TRUE(blend);
  EXPECT_EQ(blend->texture[1], 1);
  // <.8, .8> = .2 <1, 0> + .6 <1, 1> + .2 <0, 1>
  EXPECT_NEAR(blend->share[1], .6, 1e-15);
}

TEST(World, PatchesShowWhereTheRestOfTheTreeAllows) {
  auto const triangle = read("triangle", "<-9,-9,0> <9,-9,0> <0,9,0>").shape;
  auto const ball = read("sphere", "<0,0,0> 1").shape;
  ScratchPtr const scratch = World::make_scratch();
  HitGroup hit;
  auto const first = [&](Op op, double x) {
    World const world({*triangle, *ball}, {{node(op, {leaf(0), leaf(1)})}});
    return world.closest(ray_from({x, 0, -3}, {0, 0, 1}), nullptr, 0xff, infinity, *scratch, hit)
               ? hit.t
               : -1;
  };
  EXPECT_EQ(first(Op::Intersection, 0), 3); // only inside the ball
  EXPECT_EQ(first(Op::Intersection, 2), -1);
  EXPECT_EQ(first(Op::Difference, 2), 3); // only outside
  EXPECT_EQ(first(Op::Difference, 0), -1);
  EXPECT_EQ(first(Op::Clip, 0), 3);
  EXPECT_EQ(first(Op::Merge, 0), 2); // the ball first
  EXPECT_EQ(first(Op::Merge, 2), 3);
}

TEST(World, ContainingIsOrderedByEntry) {
  auto const big = read("sphere", "<0,0,0> 3").shape, small = read("sphere", "<0,0,0> 1").shape;
  auto const ground = read("plane", "<0,1,0> 10").shape, away = read("sphere", "<9,0,0> 1").shape;
  World const world({*small, *away, *big, *ground}, {{leaf(0)}, {leaf(1)}, {leaf(2)}, {leaf(3)}});
  ScratchPtr const scratch = World::make_scratch();
  std::vector<SolidId> in;
  world.containing({.1, .2, .3}, *scratch, in);
  EXPECT_EQ(in, (std::vector<SolidId>{3, 2, 0}));
}

} // namespace
} // namespace abbe::geometry::test
