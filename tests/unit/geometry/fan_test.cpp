// SPDX-License-Identifier: MIT
#include "geometry/fan.hpp"

#include "base/random.hpp"
#include "fan_check.hpp"
#include "geometry/shapes/box.hpp"
#include "geometry/shapes/cone.hpp"
#include "geometry/shapes/cylinder.hpp"
#include "geometry/shapes/disc.hpp"
#include "geometry/shapes/plane.hpp"
#include "geometry/shapes/prism.hpp"
#include "geometry/shapes/sphere.hpp"
#include "geometry/shapes/torus.hpp"
#include "scene.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace abbe::geometry::test {
namespace {

/// Every convex shape, others, boolean solids, touching ones, and all of them turned.
World mixed_world() {
  std::vector<PlacedShape> shapes{
      *make_plane({0, 1, 0}, -1.5),
      *make_box({-3, -1, 2}, {-1, 1, 4}),
      *make_sphere({1.5, 0, 3}, 1),
      *make_cylinder({3, -1, 3}, {4, 1.2, 4}, 0.6, false),
      *make_cylinder({-4, -1, 6}, {-4, 1.2, 6}, 0.9, true),
      *make_cone({0, -1, 6}, 1, {0.4, 1.5, 6}, 0.2, false),
      *make_prism({{{-1, 0}, {1, 0}, {0, 1.5}}}, -1, 1, false),
      *make_prism({{{0, 0}, {2, 0}, {2, 1}, {1, .3}, {0, 1}}}, 0, 1, false),
      *make_torus(1, 0.3),
      *make_disc({0, 2, 8}, {0.2, 0.1, -1}, 2, 0.5),
      *make_box({-1, -1, 2}, {0, 1, 4}),
      *make_box({5, -1, 2}, {7, 1, 4}),
      *make_sphere({6, 0.5, 2}, 0.8)};
  // A cut stone: planes, two of which touch, and one that is taken away; and what bounds them.
  for (Vec3 const& normal :
       {Vec3(1, 1, 0.2), Vec3(-1, 1.2, 0), Vec3(0.3, -1, 0.4), Vec3(0, 0.5, -1), Vec3(0, 0.5, -1)})
    shapes.push_back(*make_plane(normal, 0.7));
  shapes.push_back(*make_plane({1, 0.2, 0.3}, -0.3));
  shapes.push_back(*make_cylinder({0, -1, 0}, {0, 1, 0}, 1, false));
  Transform const turned =
      Transform::rotation({17, 31, 9}).then(Transform::translation({0.3, 0.2, 5}));
  shapes[6].placement = shapes[6].placement.then(turned);
  shapes[8].placement = shapes[8].placement.then(turned).then(Transform::translation({-3, 0, 3}));
  shapes[7].placement = shapes[7].placement.then(Transform::scaling({1, 2, 0.5}));
  std::vector<World::Solid> solids;
  for (PrimitiveId id = 0; id <= 10; ++id) solids.push_back({leaf(id)});
  solids.push_back({node(Op::Difference, {leaf(11), leaf(12)})});
  Transform const placed =
      Transform::rotation({12, 40, 5}).then(Transform::translation({-0.5, 2.2, 2.5}));
  for (std::size_t i = 13; i < shapes.size(); ++i)
    shapes[i].placement = shapes[i].placement.then(placed);
  solids.push_back({node(Op::Difference, {node(Op::Intersection, {leaf(13), leaf(14), leaf(15),
                                                                  leaf(16), leaf(17), leaf(19)}),
                                          leaf(18)})});
  return World(shapes, solids);
}

class FanTest : public ::testing::Test {
protected:
  FanTest() : world_(mixed_world()), scratch_(World::make_scratch()) {}

  double uniform() { return RandomKey(7).child(++drawn_).uniform(0); }
  Vec3 vector(double size) {
    double const x = uniform(), y = uniform(), z = uniform();
    return size * (2.0 * Vec3(x, y, z) - Vec3(1));
  }

  FanCounts compare(FanLines& lines, Departure const* from) {
    double t_max[fan_width];
    for (double& t : t_max) t = 20 * uniform();
    return compare_fan(world_, lines, from, t_max, *scratch_);
  }

  World world_;
  ScratchPtr scratch_;
  std::uint64_t drawn_ = 0;
};

TEST_F(FanTest, EachRayMeetsWhatItMeetsAlone) {
  int single = 0, rays = 0;
  for (int i = 0; i < 2000; ++i) {
    FanLines lines;
    lines.count = 1 + static_cast<std::size_t>(uniform() * fan_width);
    Vec3 const origin = Vec3(0, 0.5, -6) + vector(1), to = Vec3(0, 0, 4) + vector(5);
    double const spread = std::pow(10.0, -8 * uniform());
    for (std::size_t k = 0; k < lines.count; ++k) {
      lines.origin.set(k, origin);
      lines.direction.set(k, glm::normalize(to - origin + vector(spread)));
      lines.origin_error.set(k, Vec3(0));
    }
    rays += static_cast<int>(lines.count);
    single += compare(lines, nullptr).single;
    // From where the first one hits, to either side, with origins that have drifted apart.
    HitGroup hit;
    if (!world_.closest(lines.get(0), nullptr, 0xff, infinity, *scratch_, hit)) continue;
    Departure const from = leave(hit, i % 2 == 0);
    Vec3 const normal =
        world_.geometric_normal(hit.crossings[0].primitive, hit.crossings[0].face, hit.point);
    bool const to_inside = hit.members[0].was_entering == from.through;
    for (std::size_t k = 0; k < lines.count; ++k) {
      Vec3 d = glm::normalize(lines.direction.get(0) + vector(spread));
      if ((glm::dot(d, normal) < 0) != to_inside) d = -d;
      lines.origin.set(k, hit.point);
      lines.direction.set(k, d);
      lines.origin_error.set(k, hit.point_error);
    }
    compare(lines, &from);
  }
  // The comparison says something: most rays meet one clear surface.
  EXPECT_GT(single, rays / 2);
}

/// Both faces of a plate lie within the error of a ball's surface.
/// Balls on a grid, so that lines along an axis touch boxes too.
World cloud() {
  std::vector<PlacedShape> shapes;
  std::vector<World::Solid> solids;
  for (int i = 0; i < 300; ++i) {
    shapes.push_back(
        *make_sphere({i % 7 - 3.0, i / 7 % 7 - 3.0, i / 49 - 3.0}, 0.125 + 0.125 * (i % 3)));
    solids.push_back({leaf(static_cast<PrimitiveId>(i))});
  }
  return World(shapes, solids);
}

/// Rays that all stand still along an axis, go both ways along it, or go everywhere.
void expect_fans_meet_what_rays_meet(World const& world, int least) {
  ScratchPtr const scratch = World::make_scratch();
  std::uint64_t drawn = 0;
  auto const uniform = [&] { return RandomKey(11).child(++drawn).uniform(0); };
  int found = 0;
  for (int run = 0; run < 600; ++run) {
    int const axis = run % 3, kind = run / 3 % 4;
    double const sign = run % 2 == 0 ? 1 : -1;
    FanLines lines;
    lines.count = 1 + static_cast<std::size_t>(run) % fan_width;
    double t_max[fan_width];
    for (std::size_t k = 0; k < lines.count; ++k) {
      Vec3 origin, direction{0};
      for (int i = 0; i < 3; ++i) origin[i] = std::floor(64 * uniform()) / 8 - 4;
      direction[axis] = sign;
      if (run % 5 == 0) direction[(axis + 1) % 3] = -0.0;
      if (kind == 1)
        direction[(axis + 1) % 3] = 0.02 * (uniform() - 0.5); // both ways, or not at all
      if (kind == 2) direction[(axis + 2) % 3] = -0.0;
      if (kind == 3) direction = {uniform() - 0.5, uniform() - 0.5, uniform() - 0.5};
      if (kind == 1 && k > 0) origin = lines.origin.get(0) + Vec3(0.01 * uniform());
      lines.origin.set(k, origin);
      lines.direction.set(k, direction);
      lines.origin_error.set(k, Vec3(0));
      t_max[k] = 8 * uniform();
    }
    found += compare_fan(world, lines, nullptr, t_max, *scratch).single;
  }
  EXPECT_GT(found, least);
}

TEST(FanAlongAnAxis, MeetsWhatItsRaysMeetAlone) {
  expect_fans_meet_what_rays_meet(cloud(), 2000); // by a hierarchy
  expect_fans_meet_what_rays_meet(World({*make_sphere({.5, 0, -.25}, 2)}, {{leaf(0)}}),
                                  1000); // by a box
}

TEST(FanPair, IsNoneWhereOneOfTheTwoSolidsIsMetTwice) {
  double const gap = 1e-9;
  // What has no bounds is asked last.
  World const world({*make_sphere({0, 0, 1e6}, 1e6), *make_plane({0, 0, -1}, -gap),
                     *make_plane({0, 0, 1}, 2 * gap)},
                    {{leaf(0)}, {node(Op::Intersection, {leaf(1), leaf(2)})}});
  ScratchPtr const scratch = World::make_scratch();
  FanLines lines;
  lines.count = 4;
  double t_max[fan_width];
  for (std::size_t k = 0; k < lines.count; ++k) {
    lines.origin.set(k, Vec3(0, 0, -5));
    lines.direction.set(k, Vec3(0, 0, 1));
    lines.origin_error.set(k, Vec3(0));
    t_max[k] = infinity;
  }
  HitGroup group;
  ASSERT_TRUE(world.closest(lines.get(0), nullptr, 0xff, infinity, *scratch, group));
  EXPECT_EQ(group.crossings.size(), 3U);
  EXPECT_EQ(compare_fan(world, lines, nullptr, t_max, *scratch).pairs, 0);
}

} // namespace
} // namespace abbe::geometry::test
