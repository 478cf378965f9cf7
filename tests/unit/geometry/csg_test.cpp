// SPDX-License-Identifier: MIT
#include "geometry/line.hpp"
#include "geometry/shapes/box.hpp"
#include "geometry/shapes/cylinder.hpp"
#include "geometry/shapes/mesh.hpp"
#include "geometry/shapes/polynomial_surface.hpp"
#include "geometry/shapes/sphere.hpp"
#include "geometry/shapes/torus.hpp"
#include "geometry/traced_solid.hpp"
#include "scene.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace abbe::geometry::test {
namespace {

/// T-COIN in miniature: box minus box with two coincident faces (a square tube), the two boxes
/// placed by differently composed matrices. In the frame of the box: does the ray meet the tube?
bool meets_tube(Vec3 const& o, Vec3 const& d, double& margin) {
  auto const slice = [&](double low, double high, bool in_z, double& from, double& to) {
    from = -1e300;
    to = 1e300;
    for (int a = 0; a < 3; ++a) {
      double const l = a == 2 && in_z ? 0 : low, h = a == 2 && in_z ? 1 : high;
      double const x = (l - o[a]) / d[a], y = (h - o[a]) / d[a];
      from = std::fmax(from, std::fmin(x, y));
      to = std::fmin(to, std::fmax(x, y));
    }
  };
  double a0, a1, b0, b1;
  slice(0, 1, true, a0, a1);
  slice(.25, .75, true, b0, b1);
  margin = std::fabs(a1 - a0);
  if (!(a0 < a1)) return false;
  margin = std::fmin(margin, std::fabs(b1 - b0));
  if (!(b0 < b1)) return true;
  double const left = (b0 - a0) + (a1 - b1); // what the hole leaves
  margin = std::fmin(margin, std::fabs(left));
  bool const lids = b0 - a0 < 1e-9 && a1 - b1 < 1e-9;
  if (lids) margin = std::fmin(a1 - a0, b1 - b0);
  return !lids;
}

TEST(Csg, CoincidentFacesOfADifferenceVanish) {
  int wrong = 0, rays = 0, met = 0;
  ScratchPtr const scratch = World::make_scratch();
  Dice dice(11);
  for (double const scale : {1e-9, 1e-4, 1.0, 1e4, 1e9}) {
    for (double const offset : {0.0, 1.0, 1e3, 1e6}) {
      for (int turn = 0; turn < 5; ++turn) {
        Vec3 const angles = turn == 0 ? Vec3(0) : dice.in_cube(180);
        Vec3 const away = offset * scale * dice.direction();
        Transform const one = Transform::scaling(Vec3(scale))
                                  .then(Transform::rotation(angles))
                                  .then(Transform::translation(away));
        // The same, by other steps: half the size twice as large, and turned axis by axis.
        Transform const other = Transform::scaling(Vec3(scale * 3))
                                    .then(Transform::rotation({angles.x, 0, 0}))
                                    .then(Transform::rotation({0, angles.y, 0}))
                                    .then(Transform::rotation({0, 0, angles.z}))
                                    .then(Transform::translation(away));
        double const third = 1.0 / 3.0;
        auto const outer = *make_box({0, 0, 0}, {1, 1, 1});
        auto const hole = *make_box(Vec3(.25, .25, 0) * third, Vec3(.75, .75, 1) * third);
        World const world({moved(outer, one), moved(hole, other)},
                          {{node(Op::Difference, {leaf(0), leaf(1)})}});
        for (int i = 0; i < 1000; ++i) {
          Vec3 const direction =
              i % 4 == 0 ? glm::normalize(Vec3(dice.number(-.1, .1), dice.number(-.1, .1), 1))
                         : dice.direction();
          Vec3 const origin = Vec3(.5) + dice.in_cube(.6) - 3.0 * direction;
          double margin = 0;
          bool const expected = meets_tube(origin, direction, margin);
          // The edges move by the digits of the offset.
          if (margin < 1e-11 * (1 + offset * 1e-4)) continue;
          Ray const ray = ray_from(one.point(origin), one.vector(direction));
          HitGroup hit;
          bool const found = world.closest(ray, nullptr, 0xff, infinity, *scratch, hit);
          ++rays;
          met += found;
          wrong += found != expected;
        }
      }
    }
  }
  EXPECT_EQ(wrong, 0) << "of " << rays;
  EXPECT_GT(rays, 95000);
  EXPECT_GT(met, 30000);
}

struct RandomSolid {
  std::vector<PlacedShape> primitives;
  CsgTree tree;
};
PlacedShape random_shape(Dice& dice) {
  Transform const place = Transform::scaling({dice.number(.3, 1), dice.number(.3, 1), 1})
                              .then(Transform::rotation(dice.in_cube(180)))
                              .then(Transform::translation(dice.in_cube(.7)));
  switch (dice.below(4)) {
  case 0:
    return moved(*make_sphere({0, 0, 0}, .8), place);
  case 1:
    return moved(*make_box(Vec3(-.7), Vec3(.7)), place);
  case 2:
    return moved(*make_cylinder({0, -1, 0}, {0, 1, 0}, .5, false), place);
  default:
    return moved(*make_torus(.8, .3), place);
  }
}
CsgTree random_tree(Dice& dice, int depth, RandomSolid& solid) {
  if (depth == 0 || dice.below(4) == 0) {
    solid.primitives.push_back(random_shape(dice));
    CsgTree tree = leaf(static_cast<PrimitiveId>(solid.primitives.size() - 1));
    tree.inverse = dice.below(6) == 0;
    return tree;
  }
  Op const ops[] = {Op::Merge, Op::Intersection, Op::Difference};
  std::vector<CsgTree> children;
  int const count = 2 + dice.below(2);
  for (int i = 0; i < count; ++i) children.push_back(random_tree(dice, depth - 1, solid));
  CsgTree tree = node(ops[dice.below(3)], std::move(children));
  tree.inverse = dice.below(8) == 0;
  return tree;
}
bool member(CsgTree const& tree, World const& world, Vec3 const& point) {
  bool value = false;
  if (tree.op == Op::Primitive) {
    value = world.inside(tree.primitive, point);
  } else {
    value = tree.op != Op::Merge;
    for (std::size_t i = 0; i < tree.children.size(); ++i) {
      bool const in = member(tree.children[i], world, point);
      if (tree.op == Op::Merge) value = value || in;
      if (tree.op == Op::Intersection) value = value && in;
      if (tree.op == Op::Difference) value = value && (i == 0 ? in : !in);
    }
  }
  return value != tree.inverse;
}

/// Following a ray from surface to surface by departures, the points between must have the
/// membership that the boolean tree gives for a point.
TEST(Csg, RandomTreesAgreeWithPointMembershipAlongTheRay) {
  ScratchPtr const scratch = World::make_scratch();
  int passed = 0;
  for (unsigned seed = 0; seed < 150; ++seed) {
    Dice dice(100 + seed);
    RandomSolid solid;
    solid.tree = random_tree(dice, 3, solid);
    World const world(solid.primitives, {{solid.tree}});
    for (int i = 0; i < 60; ++i) {
      Vec3 const direction = dice.direction();
      Ray ray = ray_from(dice.in_cube(.8) - 4.0 * direction, direction);
      Departure from;
      bool inside = member(solid.tree, world, ray.origin);
      HitGroup hit;
      double travelled = 0;
      for (int step = 0; step < 100; ++step) {
        bool const found =
            world.closest(ray, step == 0 ? nullptr : &from, 0xff, infinity, *scratch, hit);
        double const gap = found ? hit.t : 20;
        for (double const part : {.1, .5, .9}) {
          if (gap < 1e-9) break;
          ASSERT_EQ(member(solid.tree, world, ray.origin + part * gap * direction), inside)
              << "seed " << seed << " ray " << i << " step " << step;
        }
        if (!found) break;
        ++passed;
        ASSERT_EQ(hit.crossings.size(), 1U);
        ASSERT_EQ(hit.crossings[0].entering, !inside) << seed << " " << i << " " << step;
        inside = !inside;
        travelled += hit.t;
        from = leave(hit, true);
        ray = {hit.point, direction, hit.point_error};
      }
    }
  }
  EXPECT_GT(passed, 5000);
}

TEST(Csg, OrderOfOperandsDoesNotMatter) {
  ScratchPtr const scratch = World::make_scratch();
  for (unsigned seed = 0; seed < 60; ++seed) {
    Dice dice(500 + seed);
    std::vector<PlacedShape> shapes;
    std::vector<CsgTree> leaves;
    for (PrimitiveId i = 0; i < 12; ++i) {
      // Every second pair coincides.
      shapes.push_back(i % 2 == 1 && dice.below(2) == 0 ? shapes.back() : random_shape(dice));
      leaves.push_back(leaf(i));
    }
    Op const op = seed % 2 == 0 ? Op::Merge : Op::Intersection;
    std::vector<CsgTree> shuffled(leaves.rbegin(), leaves.rend());
    std::swap(shuffled[2], shuffled[7]);
    World const one(shapes, {{node(op, leaves)}}), other(shapes, {{node(op, shuffled)}});
    for (int i = 0; i < 200; ++i) {
      Vec3 const direction = dice.direction();
      Ray const ray = ray_from(dice.in_cube(.5) - 3.0 * direction, direction);
      HitGroup a, b;
      bool const found = one.closest(ray, nullptr, 0xff, infinity, *scratch, a);
      ASSERT_EQ(found, other.closest(ray, nullptr, 0xff, infinity, *scratch, b));
      if (!found) continue;
      EXPECT_EQ(a.t, b.t);
      EXPECT_EQ(a.crossings[0].primitive, b.crossings[0].primitive);
      EXPECT_EQ(a.crossings[0].face, b.crossings[0].face);
    }
  }
}

TEST(Csg, MergeOfCubesIsOneCube) {
  std::vector<PlacedShape> shapes;
  std::vector<CsgTree> leaves;
  Transform const turn = Transform::rotation({17, 31, 9});
  for (int x = 0; x < 4; ++x) {
    for (int y = 0; y < 4; ++y) {
      for (int z = 0; z < 4; ++z) {
        Vec3 const corner = Vec3(x, y, z) * .3;
        shapes.push_back(moved(*make_box(corner, corner + .3), turn));
        leaves.push_back(leaf(static_cast<PrimitiveId>(leaves.size())));
      }
    }
  }
  World const world(shapes, {{node(Op::Merge, leaves)}});
  World const whole({moved(*make_box(Vec3(0), Vec3(1.2)), turn)}, {{leaf(0)}});
  ScratchPtr const scratch = World::make_scratch();
  Dice dice(12);
  int hits = 0;
  for (int i = 0; i < 5000; ++i) {
    Vec3 const direction = dice.direction();
    Ray ray = ray_from(turn.point(Vec3(.6)) + dice.in_cube(.6) - 4.0 * direction, direction);
    HitGroup a, b;
    bool const found = whole.closest(ray, nullptr, 0xff, infinity, *scratch, b);
    ASSERT_EQ(world.closest(ray, nullptr, 0xff, infinity, *scratch, a), found) << i;
    if (!found) continue;
    ++hits;
    EXPECT_NEAR(a.t, b.t, 1e-13);
    // Through the whole of it: the next surface is the far side.
    Departure const from = leave(a, true), whole_from = leave(b, true);
    Ray const on{a.point, direction, a.point_error}, whole_on{b.point, direction, b.point_error};
    ASSERT_TRUE(whole.closest(whole_on, &whole_from, 0xff, infinity, *scratch, b));
    ASSERT_TRUE(world.closest(on, &from, 0xff, infinity, *scratch, a)) << i;
    EXPECT_NEAR(a.t, b.t, 1e-13) << i;
    EXPECT_FALSE(a.crossings[0].entering);
  }
  EXPECT_GT(hits, 2000);
}

/// Rays reflected inside a closed solid never leave it and never stop (T-TRAP).
int bounces(World const& world, Vec3 const& inside, int count) {
  ScratchPtr const scratch = World::make_scratch();
  Dice dice(13);
  int escaped = 0;
  for (int start = 0; start < 4; ++start) {
    Ray ray = ray_from(inside, dice.direction());
    Departure from;
    HitGroup hit;
    double travelled = 0;
    for (int i = 0; i < count; ++i) {
      if (!world.closest(ray, i == 0 ? nullptr : &from, 0xff, infinity, *scratch, hit)
          || hit.crossings[0].entering) {
        ++escaped;
        break;
      }
      travelled += hit.t;
      Vec3 const n =
          world.geometric_normal(hit.crossings[0].primitive, hit.crossings[0].face, hit.point);
      Vec3 const d = ray.direction;
      from = leave(hit, false);
      ray = {hit.point, glm::normalize(d - 2 * glm::dot(d, n) * n), hit.point_error};
    }
    escaped += travelled < .01 * count ? 1 : 0; // stuck
  }
  return escaped;
}

TEST(Departure, NothingEscapesFromClosedSolids) {
  Transform const turn = Transform::rotation({11, 22, 33}).then(Transform::translation({5, 6, 7}));
  auto const world_of = [&](PlacedShape const& shape) {
    return World({moved(shape, turn)}, {{leaf(0)}});
  };
  Vec3 const middle(5, 6, 7);
  EXPECT_EQ(bounces(world_of(*make_sphere(Vec3(0), 1)), middle, 10000), 0);
  EXPECT_EQ(bounces(world_of(*make_box(Vec3(-1), Vec3(1))), middle, 10000), 0);
  EXPECT_EQ(bounces(world_of(*make_cylinder({0, -1, 0}, {0, 1, 0}, 1, false)), middle, 10000), 0);
  EXPECT_EQ(bounces(world_of(*make_torus(.6, .9)), middle, 10000), 0);
  World const lens({*make_sphere({0, 0, -.6}, 1), *make_sphere({0, 0, .6}, 1)},
                   {{node(Op::Intersection, {leaf(0), leaf(1)})}});
  EXPECT_EQ(bounces(lens, Vec3(0), 10000), 0);
}

/// A closed mesh whose vertices the rays aim at: even crossings, and never a way in without one
/// out.
TEST(Mesh, IsWatertightAtVerticesAndEdges) {
  MeshData ball;
  Dice dice(14);
  int const rings = 12, around = 16;
  ball.vertices.push_back({0, 1, 0});
  for (int r = 1; r < rings; ++r) {
    for (int k = 0; k < around; ++k) {
      double const up = 3.14159265358979 * r / rings, on = 6.28318530717959 * k / around;
      double const size = dice.number(.8, 1.2);
      ball.vertices.push_back(
          size * Vec3(std::sin(up) * std::cos(on), std::cos(up), std::sin(up) * std::sin(on)));
    }
  }
  ball.vertices.push_back({0, -1, 0});
  auto const at = [&](int r, int k) {
    return static_cast<std::uint32_t>(1 + (r - 1) * around + k % around);
  };
  auto const bottom = static_cast<std::uint32_t>(ball.vertices.size() - 1);
  for (int k = 0; k < around; ++k) {
    ball.faces.push_back({0, at(1, k), at(1, k + 1)});
    ball.faces.push_back({bottom, at(rings - 1, k + 1), at(rings - 1, k)});
    for (int r = 1; r + 1 < rings; ++r) {
      ball.faces.push_back({at(r, k), at(r + 1, k), at(r + 1, k + 1)});
      ball.faces.push_back({at(r, k), at(r + 1, k + 1), at(r, k + 1)});
    }
  }
  ball.inside_vector = Vec3(0, 1, 0);
  auto const vertices = ball.vertices;
  auto const faces = ball.faces;
  PlacedShape const placed = *make_mesh(ball).shape;
  World const world({placed}, {{leaf(0)}});
  ScratchPtr const scratch = World::make_scratch();
  HitGroup hit;
  int wrong = 0;
  for (int i = 0; i < 20000; ++i) {
    Corners const& face =
        faces[static_cast<std::size_t>(dice.below(static_cast<int>(faces.size())))];
    Vec3 const a = vertices[face[0]], b = vertices[face[1]];
    Vec3 const target = i % 2 == 0 ? a : a * .5 + b * .5;
    Ray const from_inside = ray_from(Vec3(0), target);
    wrong += !world.closest(from_inside, nullptr, 0xff, infinity, *scratch, hit);
    wrong += hit.crossings.size() != 1 || hit.crossings[0].entering;
    // A line along y through the corner: no digits are lost, it is hit exactly.
    Crossings out;
    Ray straight = ray_from({target.x, -5, target.z}, {0, 1, 0});
    Transform const there = placed.placement;
    straight.origin = there.inverse_linear * (straight.origin - there.offset);
    straight.direction = there.inverse_linear * straight.direction;
    placed.shape->crossings(straight, nullptr, out);
    wrong += out.size() % 2 != 0;
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(bounces(world, Vec3(0), 5000), 0);
}

TEST(Mesh, AMillionFacesAreSmallAndQuick) {
  MeshData grid;
  int const n = 708;
  Dice dice(15);
  for (int x = 0; x <= n; ++x) {
    for (int z = 0; z <= n; ++z) grid.vertices.push_back({x, dice.number(0, 2), z});
  }
  auto const at = [&](int x, int z) { return static_cast<std::uint32_t>(x * (n + 1) + z); };
  for (int x = 0; x < n; ++x) {
    for (int z = 0; z < n; ++z) {
      grid.faces.push_back({at(x, z), at(x + 1, z), at(x, z + 1)});
      grid.faces.push_back({at(x + 1, z), at(x + 1, z + 1), at(x, z + 1)});
    }
  }
  grid.normals.assign(grid.vertices.size(), Vec3(0, 1, 0));
  grid.normal_corners = grid.faces;
  auto const faces = static_cast<double>(grid.faces.size());
  PlacedShape const placed = *make_mesh(std::move(grid)).shape;
  auto const& mesh = dynamic_cast<Mesh const&>(*placed.shape);
  EXPECT_FALSE(mesh.inside(Vec3(0))); // without an inside nothing is looked for
  auto const unsorted = static_cast<double>(mesh.memory());
  Crossings found;
  mesh.crossings(Ray{Vec3(0.25, -9, 0.25), Vec3(0, 1, 0), Vec3(0)}, nullptr, found);
  EXPECT_EQ(found.size(), 1U);
  EXPECT_GT(static_cast<double>(mesh.memory()), unsorted); // now there is a hierarchy
  EXPECT_LT(static_cast<double>(mesh.memory()) / faces, 100);
  RecordProperty("bytes_per_face", std::to_string(static_cast<double>(mesh.memory()) / faces));
  World const world({placed}, {{leaf(0)}});
  ScratchPtr const scratch = World::make_scratch();
  HitGroup hit;
  for (int i = 0; i < 1000; ++i) {
    Vec3 const from(dice.number(1, n - 1), 10, dice.number(1, n - 1));
    ASSERT_TRUE(world.closest(ray_from(from, {0, -1, 0}), nullptr, 0xff, infinity, *scratch, hit));
    EXPECT_GE(hit.t, 8);
    EXPECT_LE(hit.t, 10);
  }
}

/// What has no bounds of its own has those of what it is cut by.
TEST(Bounds, OfUnboundedSurfacesThatAreCutAreThoseOfWhatCutsThem) {
  std::vector<double> cubic(20);
  cubic[0] = 1;  // x^3
  cubic[18] = 1; // z
  std::vector<Placed> primitives;
  primitives.emplace_back(*make_polynomial(3, cubic));
  primitives.emplace_back(PlacedShape{std::make_shared<Box const>(), {}});
  ASSERT_TRUE(primitives[0].bounds().infinite);
  Bounds const box = primitives[1].bounds();
  for (CsgTree const& tree :
       {node(Op::Intersection, {leaf(0), leaf(1)}), node(Op::Intersection, {leaf(1), leaf(0)}),
        node(Op::Difference, {leaf(1), leaf(0)}), node(Op::Clip, {leaf(0), leaf(1)}),
        node(Op::Clip, {node(Op::Merge, {leaf(0), leaf(1)}), leaf(1)})}) {
    Bounds const bounds = bounds_of(tree, primitives);
    EXPECT_FALSE(bounds.infinite);
    EXPECT_EQ(bounds.low, box.low);
    EXPECT_EQ(bounds.high, box.high);
  }
  EXPECT_TRUE(bounds_of(node(Op::Merge, {leaf(0), leaf(1)}), primitives).infinite);
}

} // namespace
} // namespace abbe::geometry::test
