// SPDX-License-Identifier: MIT
#include "base/random.hpp"
#include "geometry/half_space_bounds.hpp"
#include "geometry/shapes/plane.hpp"
#include "geometry/shapes/quadric.hpp"
#include "geometry/shapes/sphere.hpp"

#include "scene.hpp"

#include <gtest/gtest.h>

/// Boxes around what shapes without an end have in common.
namespace abbe::geometry::test {
namespace {

PlacedShape cylinder_along_z(double radius) {
  return *make_quadric({1, 1, 0, 0, 0, 0, 0, 0, 0, -radius * radius});
}

Bounds bounds_of_all(Op op, std::vector<PlacedShape> const& shapes) {
  std::vector<CsgTree> leaves;
  for (PrimitiveId id = 0; id < shapes.size(); ++id) leaves.push_back(leaf(id));
  World const world(shapes, {{node(op, leaves)}});
  return world.bounds(0);
}

TEST(HalfSpaceBounds, OfATetrahedronAreItsCorners) {
  double const third = 1 / std::sqrt(3.0);
  // x, y, z >= 0, x + y + z <= 2
  Bounds const box =
      bounds_of({{{-1, 0, 0}, 0}, {{0, -1, 0}, 0}, {{0, 0, -1}, 0}, {Vec3(third), 2 * third}});
  ASSERT_FALSE(box.infinite);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(box.low[axis], 0, 1e-9);
    EXPECT_LE(box.low[axis], 0);
    EXPECT_NEAR(box.high[axis], 2, 1e-9);
    EXPECT_GE(box.high[axis], 2);
  }
}

TEST(HalfSpaceBounds, AreInfiniteWhereTheSpaceIs) {
  EXPECT_TRUE(
      bounds_of({{{-1, 0, 0}, 0}, {{1, 0, 0}, 1}, {{0, -1, 0}, 0}, {{0, 1, 0}, 1}, {{0, 0, -1}, 0}})
          .infinite);
  EXPECT_TRUE(bounds_of({}).infinite);
}

TEST(HalfSpaceBounds, OfACylinderBetweenTwoPlanesAreFiniteHoweverItIsTurned) {
  for (Vec3 const& turn : {Vec3(0), Vec3(-90, 0, 160), Vec3(20, 130, 7)}) {
    Transform const place = Transform::rotation(turn).then(Transform::translation({0, -2, 5}));
    Bounds const box = bounds_of_all(Op::Intersection, {moved(cylinder_along_z(2), place),
                                                        moved(*make_plane({0, 0, 1}, 1.4), place),
                                                        moved(*make_plane({0, 0, -1}, 0), place)});
    ASSERT_FALSE(box.infinite);
    // Points of its rims are within it, and it is no larger than the box around the turned box.
    Vec3 low(INFINITY), high(-INFINITY);
    for (int k = 0; k < 360; ++k) {
      double const angle = k * 3.14159265358979 / 180;
      for (double const z : {0.0, 1.4}) {
        Vec3 const p = place.point({2 * std::cos(angle), 2 * std::sin(angle), z});
        EXPECT_TRUE(glm::all(glm::lessThanEqual(box.low, p + 1e-9)));
        EXPECT_TRUE(glm::all(glm::lessThanEqual(p - 1e-9, box.high)));
      }
    }
    for (double const x : {-2.0, 2.0})
      for (double const y : {-2.0, 2.0})
        for (double const z : {0.0, 1.4}) {
          low = glm::min(low, place.point({x, y, z}));
          high = glm::max(high, place.point({x, y, z}));
        }
    EXPECT_TRUE(glm::all(glm::lessThan(low - 1e-6, box.low)));
    EXPECT_TRUE(glm::all(glm::lessThan(box.high, high + 1e-6)));
  }
}

TEST(HalfSpaceBounds, OfWhatIsTakenAwayCountForNothing) {
  std::vector<PlacedShape> const shapes{cylinder_along_z(1), *make_plane({0, 0, 1}, 1),
                                        *make_plane({0, 0, -1}, 1)};
  EXPECT_TRUE(bounds_of_all(Op::Difference, shapes).infinite);
  EXPECT_TRUE(bounds_of_all(Op::Merge, shapes).infinite);
  EXPECT_FALSE(bounds_of_all(Op::Intersection, shapes).infinite);
}

TEST(QuadricBounds, OfAParaboloidUnderAPlaneAreFinite) {
  // x^2 + y^2 <= z, z <= 4
  PlacedShape const paraboloid = *make_quadric({1, 1, 0, 0, 0, 0, 0, 0, -1, 0});
  Bounds const box = bounds_of_all(Op::Intersection, {paraboloid, *make_plane({0, 0, 1}, 4)});
  ASSERT_FALSE(box.infinite);
  EXPECT_NEAR(box.low.x, -2, 1e-9);
  EXPECT_NEAR(box.high.y, 2, 1e-9);
  EXPECT_NEAR(box.low.z, 0, 1e-9);
  EXPECT_NEAR(box.high.z, 4, 1e-9);
  EXPECT_TRUE(bounds_of_all(Op::Intersection, {paraboloid, *make_plane({1, 0, 0}, 4)}).infinite);
}

TEST(QuadricBounds, OfAHyperboloidBetweenTwoPlanesIsItsWiderEnd) {
  // x^2 - y^2 + z^2 = 1 for y from -2 to 1, twice as wide along x, three above (5, 0, 0).
  Transform const place = Transform::scaling({2, 1, 1}).then(Transform::translation({5, 3, 0}));
  for (double const turn : {0.0, 90.0, 180.0}) {
    Transform const turned = place.then(Transform::rotation({0, turn, 0}));
    Bounds const box = bounds_of_all(
        Op::Intersection,
        {moved(*make_quadric({1, -1, 1, 0, 0, 0, 0, 0, 0, -1}), turned),
         moved(*make_plane({0, 1, 0}, 1), turned), moved(*make_plane({0, -1, 0}, 2), turned)});
    ASSERT_FALSE(box.infinite) << turn;
    Vec3 const low = turned.point({-std::sqrt(5.0), -2, -std::sqrt(5.0)}),
               high = turned.point({std::sqrt(5.0), 1, std::sqrt(5.0)});
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_LE(box.low[axis], std::min(low[axis], high[axis]));
      EXPECT_NEAR(box.low[axis], std::min(low[axis], high[axis]), 1e-8);
      EXPECT_GE(box.high[axis], std::max(low[axis], high[axis]));
      EXPECT_NEAR(box.high[axis], std::max(low[axis], high[axis]), 1e-8);
    }
  }
}

TEST(QuadricBounds, HoldWhatIsInside) {
  // Quadrics of any coefficients between planes square to the axes: points inside of all are in the
  // box.
  RandomKey const key(42);
  int bounded = 0, inside = 0;
  for (std::uint64_t n = 0; n < 3000; ++n) {
    auto const draw = [&](std::uint64_t d) { return 2 * key.child(n).uniform(d) - 1; };
    std::array<double, 10> k{};
    for (std::uint64_t i = 0; i < 10; ++i) k[i] = std::abs(draw(40 + i)) < 0.4 ? 0 : draw(i);
    auto const quadric = make_quadric(k);
    if (!quadric) continue;
    Transform const place = Transform::scaling({1 + draw(20) / 2, 1, 1 + draw(21) / 2})
                                .then(Transform::translation({draw(22), 3 * draw(23), 0}));
    double const above = 1 + draw(24), below = 1 + draw(25);
    Bounds const box =
        bounds_of_all(Op::Intersection, {moved(*quadric, place), *make_plane({0, 1, 0}, above),
                                         *make_plane({0, -1, 0}, below)});
    if (box.infinite) continue;
    ++bounded;
    for (std::uint64_t i = 0; i < 300; ++i) {
      auto const at = [&](std::uint64_t d) { return key.child(n).child(i).uniform(d); };
      Vec3 const middle = 0.5 * (box.low + box.high);
      Vec3 const p =
          middle + 2.0 * (box.high - middle) * (2.0 * Vec3(at(0), at(1), at(2)) - Vec3(1));
      if (p.y > above || -p.y > below
          || !quadric->shape->inside(place.inverse_linear * p + place.inverse_offset))
        continue;
      ++inside;
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LE(box.low[axis], p[axis]);
        EXPECT_GE(box.high[axis], p[axis]);
      }
    }
  }
  EXPECT_GT(bounded, 10);
  EXPECT_GT(inside, 500);
}

} // namespace
} // namespace abbe::geometry::test
