// SPDX-License-Identifier: MIT
#include "geometry/lane_tree.hpp"

#include "geometry/shapes/quadric.hpp"
#include "geometry/shapes/torus.hpp"

#include "fan_walk.hpp"
#include "lattice.hpp"

#include <cmath>

/// Boolean trees asked for the rays of a fan side by side give the bits of TracedSolid, ray by ray.
namespace abbe::geometry::test {
namespace {

/// Some tree over `operands` shapes, each of which may stand in it more than once.
CsgTree any_tree(Dice& dice, int operands, int depth) {
  if (depth == 0 || dice.below(4) == 0) return leaf(static_cast<PrimitiveId>(dice.below(operands)));
  constexpr Op ops[] = {Op::Merge, Op::Intersection, Op::Difference, Op::Difference, Op::Clip};
  std::vector<CsgTree> children;
  for (int i = 1 + dice.below(4); i > 0; --i) {
    children.push_back(any_tree(dice, operands, depth - 1));
  }
  CsgTree tree = node(ops[dice.below(5)], std::move(children));
  tree.inverse = dice.below(8) == 0;
  return tree;
}

/// Hyperboloids, saddles, cones and pairs of planes.
std::array<double, 10> any_quadric(Dice& dice) {
  std::array<double, 10> k{};
  for (std::size_t i = 0; i < 3; ++i) k[i] = dice.below(3) - 1;
  k[static_cast<std::size_t>(dice.below(3))] = -1;
  if (dice.below(2) == 0) k[static_cast<std::size_t>(3 + dice.below(3))] = dice.below(5) - 2;
  if (dice.below(2) == 0) k[static_cast<std::size_t>(6 + dice.below(3))] = dice.below(3) - 1;
  k[9] = 0.25 * (dice.below(5) - 2);
  return k;
}

enum class Last { Any, Torus, Quadric };

/// @param last what the last of the operands is
WalkCounts compare(int worlds, int operands, Last last, unsigned seed) {
  Dice dice(seed);
  WalkCounts counts;
  for (int i = 0; i < worlds && !testing::Test::HasFailure(); ++i) {
    double const size = std::pow(10.0, dice.below(7) * 3 - 9);
    Transform const turn = i % 2 == 0 ? Transform{} : Transform::rotation(dice.in_cube(90));
    Transform const place = turn.then(Transform::translation(dice.in_cube(i % 3) * size));
    std::vector<PlacedShape> shapes;
    for (int k = 0; k < operands; ++k) {
      shapes.push_back(moved(any_shape(dice, Mix::All, size), place));
    }
    if (last == Last::Torus) {
      PlacedShape torus = moved(*make_torus(1, 0.25), Transform::scaling(Vec3(size)));
      shapes.back() = moved(torus, place);
    } else if (last == Last::Quadric) {
      PlacedShape const quadric = *make_quadric(any_quadric(dice));
      shapes.back() = moved(moved(quadric, Transform::scaling(Vec3(size))), place);
    }
    // Two solids or three, so that faces of other solids are in the way, too.
    std::vector<World::Solid> solids{{any_tree(dice, operands, 3)}, {any_tree(dice, operands, 2)}};
    if (i % 2 == 1) solids.push_back({any_tree(dice, operands, dice.below(2))});
    World const world(shapes, solids);
    for (int fan = 0; fan < 40; ++fan) walk_fan(world, size, dice, counts);
  }
  return counts;
}

TEST(LaneTree, GivesTheBitsOfTheGeneralWay) {
  WalkCounts const counts = compare(300, 6, Last::Any, 1);
  // The comparison says something: many rays meet one clear surface.
  EXPECT_GT(counts.single, counts.rays / 4);
  EXPECT_GT(counts.pairs, counts.rays / 64);
}

TEST(LaneTree, GivesTheBitsOfTheGeneralWayForQuadricsThatAreNotConvex) {
  WalkCounts const counts = compare(300, 4, Last::Quadric, 3);
  EXPECT_GT(counts.single, counts.rays / 8);
}

TEST(LaneTree, AsksTheGeneralWayWhereAnOperandHasNoKernel) {
  WalkCounts const counts = compare(100, 4, Last::Torus, 2);
  EXPECT_GT(counts.single, counts.rays / 8);
}

TEST(LaneTree, IsMadeOfFewSolidLeaves) {
  std::vector<Placed> primitives;
  primitives.emplace_back(*make_sphere(Vec3(0), 1));
  primitives.emplace_back(*make_box(Vec3(-1), Vec3(1)));
  auto const made = [&](CsgTree const& tree) {
    return LaneTree::of(tree, CsgProgram(tree), primitives) != nullptr;
  };
  EXPECT_TRUE(made(node(Op::Merge, {leaf(0), leaf(1)})));
  EXPECT_FALSE(made(node(Op::Merge, {})));
  std::vector<CsgTree> const many(LaneTree::most_operands + 1, leaf(0));
  EXPECT_FALSE(made(node(Op::Merge, many)));
}

} // namespace
} // namespace abbe::geometry::test
