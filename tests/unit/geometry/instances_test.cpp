// SPDX-License-Identifier: MIT
#include "geometry/shapes/instances.hpp"

#include "base/random.hpp"
#include "geometry/shapes/sphere.hpp"
#include "geometry/shapes/torus.hpp"
#include "geometry/world.hpp"

#include <cmath>
#include <gtest/gtest.h>

/// What is stored once is met where copies of it would be.
namespace abbe::geometry {
namespace {

/// Two balls and a ring; two of that, turned; three of those, with a ball between them.
struct Nest {
  ShapePtr ball = make_sphere(Vec3(0), 1)->shape;
  ShapePtr ring = make_torus(1, 0.25)->shape;
  std::shared_ptr<Definition const> inner, middle, outer;

  Nest() {
    inner = std::make_shared<Definition const>(
        std::vector<Definition::Leaf>{
            {ball, Transform::scaling(Vec3(0.5)), 0},
            {ball, Transform::scaling(Vec3(0.25)).then(Transform::translation({1, 0.5, 0})), 1},
            {ring, Transform::rotation({30, 0, 20}), 2}},
        std::vector<Definition::Part>{});
    middle = std::make_shared<Definition const>(
        std::vector<Definition::Leaf>{},
        std::vector<Definition::Part>{
            {inner, Transform{}},
            {inner, Transform::rotation({0, 40, 0}).then(Transform::translation({3, 0, 1}))}});
    outer = std::make_shared<Definition const>(
        std::vector<Definition::Leaf>{{ball, Transform::translation({2, 3, 0}), 0}},
        std::vector<Definition::Part>{
            {middle, Transform{}},
            {middle, Transform::scaling({1, 2, 0.5}).then(Transform::translation({0, 0, 6}))},
            {middle, Transform::rotation({0, 0, 90}).then(Transform::translation({-4, 1, 2}))}});
  }

  /// Every leaf as a shape of its own.
  static void copy(Definition const& definition, Transform const& at, Transform const& to_stage,
                   std::vector<PlacedShape>& out, std::vector<int>& textures) {
    for (auto const& leaf : definition.leaves()) {
      out.push_back({leaf.shape, leaf.placement.then(at).then(to_stage)});
      textures.push_back(leaf.texture);
    }
    for (auto const& part : definition.parts())
      copy(*part.definition, part.placement.then(at), to_stage, out, textures);
  }
};

World::Solid solid(PrimitiveId primitive) {
  CsgTree tree;
  tree.primitive = primitive;
  return {std::move(tree), 0xff};
}

struct Both {
  Nest nest;
  Transform at = Transform::rotation({10, 20, 30}).then(Transform::translation({1, 2, 3}));
  Transform to_stage = Transform::translation({-5, 0.5, 4});
  std::vector<PlacedShape> copies;
  std::vector<int> textures;
  std::shared_ptr<Instances const> shape =
      std::make_shared<Instances const>(nest.outer, at, to_stage);
  World stored{{{shape, Transform{}}}, {solid(0)}};
  World copied = make_copies();

  World make_copies() {
    Nest::copy(*nest.outer, at, to_stage, copies, textures);
    std::vector<World::Solid> solids;
    for (PrimitiveId i = 0; i < copies.size(); ++i) solids.push_back(solid(i));
    return World(copies, solids);
  }
};

Vec3 direction(RandomKey key) {
  Vec3 v;
  do {
    key = key.child(0);
    v = 2.0 * Vec3(key.uniform(1), key.uniform(2), key.uniform(3)) - 1.0;
  } while (glm::dot(v, v) > 1 || glm::dot(v, v) < 1e-3);
  return glm::normalize(v);
}

TEST(Instances, AreMetWhereCopiesAre) {
  Both both;
  ASSERT_EQ(both.copies.size(), 19u);
  auto one = World::make_scratch(), other = World::make_scratch();
  int met = 0, onward = 0;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    RandomKey const key(i);
    Vec3 const from = 12.0 * direction(key.child(1));
    Bounds const box = both.stored.bounds(0);
    Vec3 const to =
        box.low + (box.high - box.low) * Vec3(key.uniform(0), key.uniform(1), key.uniform(2));
    Ray ray{from, glm::normalize(to - from)};
    HitGroup a, b;
    bool const first = both.stored.closest(ray, nullptr, 0xff, 1e9, *one, a);
    ASSERT_EQ(first, both.copied.closest(ray, nullptr, 0xff, 1e9, *other, b)) << i;
    EXPECT_EQ(first, both.stored.occluded(ray, nullptr, 0xff, 1e9, *one));
    if (!first) continue;
    ++met;
    SurfaceCrossing const &x = a.crossings[0], &y = b.crossings[0];
    EXPECT_EQ(a.t, b.t);
    EXPECT_EQ(a.point, b.point);
    EXPECT_EQ(x.entering, y.entering);
    EXPECT_EQ(both.shape->face_texture(x.face), both.textures[y.primitive]);
    Vec3 const n = both.stored.normal(x.primitive, x.face, a.point);
    EXPECT_LT(glm::length(n - both.copied.normal(y.primitive, y.face, b.point)), 1e-14);
    // From there a ray comes back, and does not meet what it leaves.
    Vec3 const side = glm::dot(n, ray.direction) > 0 ? -n : n;
    Vec3 back = direction(key.child(2));
    if (glm::dot(back, side) < 0) back = -back;
    Departure here{a.members, false}, there{b.members, false};
    Ray const away{a.point, back, a.point_error};
    HitGroup c, d;
    bool const again = both.stored.closest(away, &here, 0xff, 1e9, *one, c);
    ASSERT_EQ(again, both.copied.closest(away, &there, 0xff, 1e9, *other, d)) << i;
    if (!again) continue;
    ++onward;
    EXPECT_EQ(c.t, d.t);
  }
  EXPECT_GT(met, 500);
  EXPECT_GT(onward, 50);
}

TEST(Instances, ACubeOfCubesCountsManyAndTakesLittle) {
  // 2^36 balls on a cubic grid of 4096 a side, 36 definitions.
  ShapePtr const ball = make_sphere(Vec3(0), 1)->shape;
  auto grid = std::make_shared<Definition const>(
      std::vector<Definition::Leaf>{{ball, Transform::scaling(Vec3(0.25)), 0}},
      std::vector<Definition::Part>{});
  for (int k = 0; k < 36; ++k) {
    Vec3 by(0);
    by[k % 3] = std::ldexp(1.0, k / 3);
    grid = std::make_shared<Definition const>(
        std::vector<Definition::Leaf>{},
        std::vector<Definition::Part>{{grid, Transform{}}, {grid, Transform::translation(by)}});
  }
  EXPECT_NEAR(grid->bounds().high.z, 4095.25, 1e-9);
  World const world(
      {{std::make_shared<Instances const>(grid, Transform{}, Transform{}), Transform{}}},
      {solid(0)});
  auto scratch = World::make_scratch();
  for (std::uint64_t i = 0; i < 200; ++i) {
    // The ball at a place of the grid, met from half a unit beside it.
    RandomKey const key(i);
    Vec3 centre;
    for (int axis = 0; axis < 3; ++axis)
      centre[axis] = std::floor(4096 * key.uniform(static_cast<std::uint64_t>(axis)));
    HitGroup hit;
    Vec3 const from = centre + Vec3(-0.5, 0, 0);
    ASSERT_TRUE(world.closest({from, Vec3(1, 0, 0)}, nullptr, 0xff, 1e9, *scratch, hit));
    EXPECT_NEAR(hit.t, 0.25, 1e-9);
    SurfaceCrossing const& met = hit.crossings[0];
    EXPECT_LT(glm::length(world.normal(met.primitive, met.face, hit.point) - Vec3(-1, 0, 0)), 1e-9);
  }
}

} // namespace
} // namespace abbe::geometry
