// SPDX-License-Identifier: MIT
#include "geometry/lane_tree.hpp"

#include "geometry/shapes/torus.hpp"

#include "fan_check.hpp"
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

struct Counts {
  int rays = 0, single = 0;
};

void follow_fan(World const& world, double size, Dice& dice, Counts& counts) {
  ScratchPtr const scratch = World::make_scratch();
  FanLines lines;
  lines.count = 1 + static_cast<std::size_t>(dice.below(fan_width));
  Vec3 const eye = dice.direction() * (6 * size);
  Vec3 target = dice.in_cube(size);
  // Some at points of the lattice: edges and corners.
  if (dice.below(3) == 0) {
    double const x = dice.below(3) - 1, y = dice.below(3) - 1, z = dice.below(3) - 1;
    target = size * Vec3(x, y, z);
  }
  double const spread = std::pow(10.0, -dice.number(0.5, 9));
  for (std::size_t k = 0; k < lines.count; ++k) {
    lines.origin.set(k, eye);
    lines.direction.set(k, glm::normalize(target - eye) + dice.in_cube(spread));
    lines.origin_error.set(k, Vec3(0));
  }
  Departure from;
  for (int depth = 0; depth < 4 && !testing::Test::HasFailure(); ++depth) {
    double t_max[fan_width];
    for (double& t : t_max) t = dice.number(0, 10) * size;
    counts.rays += static_cast<int>(lines.count);
    counts.single += compare_fan(world, lines, depth > 0 ? &from : nullptr, t_max, *scratch);
    HitGroup hit;
    if (!world.closest(lines.get(0), depth > 0 ? &from : nullptr, 0xff, infinity, *scratch, hit))
      return;
    // On through the surface, or back from it, with directions that drift apart.
    bool const through = dice.below(3) != 0;
    Departure const next = leave(hit, through);
    Vec3 const normal =
        world.geometric_normal(hit.crossings[0].primitive, hit.crossings[0].face, hit.point);
    bool const to_inside = hit.members[0].was_entering == through;
    for (std::size_t k = 0; k < lines.count; ++k) {
      Vec3 d = lines.direction.get(0) + dice.in_cube(spread);
      if ((glm::dot(d, normal) < 0) != to_inside) d = d - 2 * glm::dot(d, normal) * normal;
      lines.origin.set(k, hit.point);
      lines.direction.set(k, d);
      lines.origin_error.set(k, hit.point_error);
    }
    from = next;
  }
}

Counts compare(int worlds, int operands, bool with_torus, unsigned seed) {
  Dice dice(seed);
  Counts counts;
  for (int i = 0; i < worlds && !testing::Test::HasFailure(); ++i) {
    double const size = std::pow(10.0, dice.below(7) * 3 - 9);
    Transform const turn = i % 2 == 0 ? Transform{} : Transform::rotation(dice.in_cube(90));
    Transform const place = turn.then(Transform::translation(dice.in_cube(i % 3) * size));
    std::vector<PlacedShape> shapes;
    for (int k = 0; k < operands; ++k) {
      shapes.push_back(moved(any_shape(dice, Mix::All, size), place));
    }
    if (with_torus) {
      PlacedShape torus = moved(*make_torus(1, 0.25), Transform::scaling(Vec3(size)));
      shapes.back() = moved(torus, place);
    }
    // Two solids, so that faces of other solids are in the way, too.
    World const world(shapes, {{any_tree(dice, operands, 3)}, {any_tree(dice, operands, 2)}});
    for (int fan = 0; fan < 40; ++fan) follow_fan(world, size, dice, counts);
  }
  return counts;
}

TEST(LaneTree, GivesTheBitsOfTheGeneralWay) {
  Counts const counts = compare(300, 6, false, 1);
  // The comparison says something: many rays meet one clear surface.
  EXPECT_GT(counts.single, counts.rays / 4);
}

TEST(LaneTree, AsksTheGeneralWayWhereAnOperandHasNoKernel) {
  Counts const counts = compare(100, 4, true, 2);
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
