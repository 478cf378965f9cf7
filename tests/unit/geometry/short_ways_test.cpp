// SPDX-License-Identifier: MIT
#include "lattice.hpp"

#include <gtest/gtest.h>

#include <limits>

/// Intersections of convex operands and merges have short ways. The same solid, with each operand
/// wrapped in a boolean of its own, goes the general way: both must give the same bits.
namespace abbe::geometry::test {
namespace {

constexpr double everywhere = std::numeric_limits<double>::infinity();

CsgTree wrapped(Op op, CsgTree const& leaf) {
  return node(op == Op::Merge ? Op::Intersection : Op::Merge, {leaf});
}

void expect_same(HitGroup const& a, HitGroup const& b) {
  EXPECT_EQ(a.t, b.t);
  EXPECT_EQ(a.error, b.error);
  EXPECT_EQ(a.point_error, b.point_error);
  ASSERT_EQ(a.crossings.size(), b.crossings.size());
  for (std::size_t i = 0; i < a.crossings.size(); ++i) {
    EXPECT_EQ(a.crossings[i].primitive, b.crossings[i].primitive);
    EXPECT_EQ(a.crossings[i].face, b.crossings[i].face);
    EXPECT_EQ(a.crossings[i].entering, b.crossings[i].entering);
  }
  ASSERT_EQ(a.members.size(), b.members.size());
  for (std::size_t i = 0; i < a.members.size(); ++i) {
    EXPECT_EQ(a.members[i].primitive, b.members[i].primitive);
    EXPECT_EQ(a.members[i].face, b.members[i].face);
    EXPECT_EQ(a.members[i].was_entering, b.members[i].was_entering);
  }
}

/// Follows rays through both worlds, from the eye and from surface to surface.
/// @return hits compared
int follow(World const& quick, World const& general, double size, Dice& dice) {
  ScratchPtr const scratch = World::make_scratch();
  ScratchPtr const other = World::make_scratch();
  int hits = 0;
  for (int i = 0; i < 60; ++i) {
    Ray ray = ray_from(dice.direction() * (6 * size), Vec3(0));
    // Some along the axes, and some at points of the lattice: edges and corners.
    Vec3 target = dice.in_cube(size);
    if (i % 3 == 0) target = Vec3(dice.below(3) - 1, dice.below(3) - 1, dice.below(3) - 1) * size;
    ray.direction = glm::normalize(target - ray.origin);
    if (i % 10 == 0) ray = ray_from(Vec3(target.x, -6 * size, target.z), Vec3(0, 1, 0));
    Departure from;
    bool departs = false;
    for (int depth = 0; depth < 8; ++depth) {
      HitGroup a, b;
      Departure const* const on = departs ? &from : nullptr;
      bool const found = quick.closest(ray, on, 0xff, everywhere, *scratch, a);
      EXPECT_EQ(found, general.closest(ray, on, 0xff, everywhere, *other, b));
      EXPECT_EQ(quick.occluded(ray, on, 0xff, 3 * size, *scratch),
                general.occluded(ray, on, 0xff, 3 * size, *other));
      if (!found) break;
      expect_same(a, b);
      if (testing::Test::HasFailure()) return hits;
      ++hits;
      bool const through = dice.below(3) != 0;
      Vec3 const normal = quick.normal(a.crossings[0].primitive, a.crossings[0].face, a.point);
      Vec3 const back = ray.direction - 2 * glm::dot(ray.direction, normal) * normal;
      from = leave(a, through);
      departs = true;
      ray = {a.point, through ? ray.direction : back, a.point_error};
    }
  }
  return hits;
}

int compare(Op op, Mix mix, int operands, int worlds, unsigned seed) {
  Dice dice(seed);
  int hits = 0;
  for (int i = 0; i < worlds && !testing::Test::HasFailure(); ++i) {
    double const size = std::pow(10.0, dice.below(7) * 3 - 9);
    Transform const turn = i % 2 == 0 ? Transform{} : Transform::rotation(dice.in_cube(90));
    Transform const place = turn.then(Transform::translation(dice.in_cube(i % 3) * size));
    std::vector<PlacedShape> shapes;
    std::vector<CsgTree> plain, general;
    for (int k = 0; k < operands; ++k) {
      shapes.push_back(moved(any_shape(dice, mix, size), place));
      plain.push_back(leaf(static_cast<PrimitiveId>(k)));
      // A plane can be taken away, too.
      plain.back().inverse = mix == Mix::Planes && dice.below(4 * operands) == 0;
      general.push_back(wrapped(op, plain.back()));
    }
    hits += follow(World(shapes, {{node(op, plain)}}), World(shapes, {{node(op, general)}}), size,
                   dice);
  }
  return hits;
}

} // namespace

TEST(ShortWays, HalfSpacesGiveTheBitsOfTheGeneralWay) {
  EXPECT_GT(compare(Op::Intersection, Mix::Planes, 5, 300, 1), 10000);
  EXPECT_GT(compare(Op::Intersection, Mix::Planes, 23, 100, 2), 1000);
}

TEST(ShortWays, ConvexOperandsGiveTheBitsOfTheGeneralWay) {
  EXPECT_GT(compare(Op::Intersection, Mix::All, 2, 300, 3), 5000);
  EXPECT_GT(compare(Op::Intersection, Mix::All, 4, 300, 4), 1000);
}

TEST(ShortWays, MergesGiveTheBitsOfTheGeneralWay) {
  EXPECT_GT(compare(Op::Merge, Mix::Bounded, 12, 200, 5), 5000);
}

} // namespace abbe::geometry::test
