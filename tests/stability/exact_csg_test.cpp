// SPDX-License-Identifier: MIT
#include "exact_line.hpp"
#include "geometry/shapes/box.hpp"
#include "geometry/shapes/cone.hpp"
#include "geometry/shapes/cylinder.hpp"
#include "geometry/shapes/plane.hpp"
#include "geometry/shapes/sphere.hpp"

#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>
#include <iostream>
#include <limits>
#include <random>

/// Random boolean trees of bodies on a small integer lattice (so that faces coincide all the time),
/// followed by rays from surface to surface, against integer arithmetic.
/// ABBE_STABILITY_RAYS: rays a family, 1e6 for the full measure; 4e4 without.
namespace abbe::geometry {
namespace {

using exact::Point;
using Op = CsgTree::Op;

class Dice {
public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  std::int64_t from(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(engine_() % static_cast<std::uint64_t>(high - low + 1));
  }
  bool one_in(std::int64_t n) { return from(1, n) == 1; }

private:
  std::mt19937_64 engine_;
};

struct Scene {
  std::vector<PlacedShape> shapes;
  std::vector<exact::Body> bodies;
  CsgTree tree;
};

Vec3 vec(Point const& p) {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

void add_box(Dice& dice, Scene& scene) {
  Point low, high;
  for (std::size_t i = 0; i < 3; ++i) {
    low[i] = dice.from(-4, 2);
    high[i] = low[i] + dice.from(1, 4);
  }
  scene.shapes.push_back(*make_box(vec(low), vec(high)));
  scene.bodies.push_back(exact::box(low, high));
}

void add_half_space(Dice& dice, Scene& scene) {
  // Normals of integer length: distances are rational.
  static constexpr std::array<std::array<std::int64_t, 4>, 6> normals = {
      {{1, 0, 0, 1}, {0, -1, 0, 1}, {0, 0, 1, 1}, {1, 2, 2, 3}, {-2, 3, 6, 7}, {4, -4, 7, 9}}};
  auto const& n = normals[static_cast<std::size_t>(dice.from(0, 5))];
  std::int64_t const level = dice.from(-3 * n[3], 3 * n[3]);
  Point const normal{n[0], n[1], n[2]};
  scene.shapes.push_back(
      *make_plane(vec(normal), static_cast<double>(level) / static_cast<double>(n[3])));
  scene.bodies.push_back(exact::half_space(normal, level));
}

void add_sphere(Dice& dice, Scene& scene) {
  Point const centre{dice.from(-2, 2), dice.from(-2, 2), dice.from(-2, 2)};
  std::int64_t const radius = dice.from(1, 4);
  scene.shapes.push_back(*make_sphere(vec(centre), static_cast<double>(radius)));
  scene.bodies.push_back(exact::sphere(centre, radius));
}

void add_round(Dice& dice, Scene& scene) {
  auto const axis = static_cast<int>(dice.from(0, 2));
  Point const middle{dice.from(-2, 2), dice.from(-2, 2), dice.from(-2, 2)};
  std::int64_t const low = dice.from(-4, 1), high = low + dice.from(1, 4);
  Point base = middle, cap = middle;
  base[static_cast<std::size_t>(axis)] = low;
  cap[static_cast<std::size_t>(axis)] = high;
  std::int64_t const r0 = dice.from(1, 3), r1 = dice.one_in(2) ? r0 : dice.from(0, 3);
  if (r0 == r1) {
    scene.shapes.push_back(*make_cylinder(vec(base), vec(cap), static_cast<double>(r0), false));
    scene.bodies.push_back(exact::cylinder(axis, middle, low, high, r0));
  } else {
    scene.shapes.push_back(
        *make_cone(vec(base), static_cast<double>(r0), vec(cap), static_cast<double>(r1), false));
    scene.bodies.push_back(exact::cone(axis, middle, low, r0, high, r1));
  }
}

CsgTree random_tree(Dice& dice, std::int64_t leaves, bool quadrics, Scene& scene) {
  CsgTree tree;
  tree.inverse = dice.one_in(8);
  if (leaves == 1) {
    std::int64_t const kind = dice.from(0, quadrics ? 4 : 2);
    kind < 2    ? add_box(dice, scene)
    : kind == 2 ? add_half_space(dice, scene)
    : kind == 3 ? add_sphere(dice, scene)
                : add_round(dice, scene);
    tree.primitive = static_cast<PrimitiveId>(scene.shapes.size() - 1);
    return tree;
  }
  static constexpr Op ops[] = {Op::Merge, Op::Intersection, Op::Difference};
  tree.op = ops[dice.from(0, 2)];
  while (leaves > 0) {
    bool const last = tree.children.size() >= 3;
    std::int64_t const part = last                    ? leaves
                              : tree.children.empty() ? dice.from(1, leaves - 1)
                                                      : dice.from(1, leaves);
    tree.children.push_back(random_tree(dice, part, quadrics, scene));
    leaves -= part;
  }
  return tree;
}

/// @param parallel some along faces of the lattice (turned, no double is exactly along)
exact::IntegerLine random_line(Dice& dice, bool parallel) {
  exact::IntegerLine line;
  constexpr std::int64_t unit = exact::IntegerLine::unit;
  bool const within = dice.one_in(4);
  for (std::size_t i = 0; i < 3; ++i) {
    std::int64_t const target = dice.from(-5 * unit, 5 * unit);
    line.origin[i] = dice.from(-20 * unit, 20 * unit) / (within ? 4 : 1);
    line.direction[i] = target - line.origin[i];
    if (parallel && dice.one_in(16)) line.direction[i] = 0;
  }
  return line;
}

struct Counts {
  long rays = 0, left_out = 0, crossings = 0, coincident = 0, wrong = 0;
};

void compare(World const& world, Scratch& scratch, Transform const& place,
             exact::IntegerLine const& line, exact::Answer const& expected, Counts& counts) {
  constexpr double unit = static_cast<double>(exact::IntegerLine::unit);
  Ray ray;
  ray.origin = place.point(vec(line.origin) / unit);
  ray.direction = place.vector(vec(line.direction) / unit);
  Departure from;
  double travelled = 0;
  bool right = true;
  for (std::size_t i = 0; right; ++i) {
    HitGroup hit;
    bool const found = world.closest(ray, i == 0 ? nullptr : &from, 0xff,
                                     std::numeric_limits<double>::infinity(), scratch, hit);
    if (!found || i == expected.changes.size()) {
      right = !found && i == expected.changes.size();
      break;
    }
    exact::Change const& change = expected.changes[i];
    travelled += hit.t;
    right = hit.crossings.size() == 1 && hit.crossings[0].entering == change.entering
            && std::fabs(travelled - change.t) <= 1e-9 * (1 + change.t);
    from = {hit.members, true};
    ray = {hit.point, ray.direction, hit.point_error};
    ++counts.crossings;
  }
  counts.wrong += right ? 0 : 1;
}

Counts run(bool quadrics, bool placed, std::uint64_t seed) {
  char const* const wanted = std::getenv("ABBE_STABILITY_RAYS");
  long const rays = wanted != nullptr ? std::strtol(wanted, nullptr, 10) : 40000;
  Dice dice(seed);
  Counts counts;
  ScratchPtr const scratch = World::make_scratch();
  while (counts.rays < rays) {
    Scene scene;
    scene.tree = random_tree(dice, dice.from(2, 12), quadrics, scene);
    Transform place;
    if (placed) {
      double const size = std::pow(10.0, static_cast<double>(dice.from(-6, 6)));
      auto const angle = [&] { return static_cast<double>(dice.from(-180, 180)); };
      auto const away = [&] { return size * static_cast<double>(dice.from(-1000, 1000)) / 7; };
      Vec3 const there(away(), away(), away());
      Transform const size_of = Transform::scaling(Vec3(size));
      Transform const turn = Transform::rotation({angle(), angle(), angle()});
      place = size_of.then(turn).then(Transform::translation(there));
      for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
        Transform shape = scene.shapes[i].placement.then(size_of);
        // Half of them by way of another place.
        if (i % 2 == 1) {
          shape = shape.then(Transform::translation(there)).then(Transform::translation(-there));
        }
        scene.shapes[i].placement = shape.then(turn).then(Transform::translation(there));
      }
    }
    World const world(scene.shapes, {{scene.tree, 0xff}});
    // Placed 1000 / 7 sizes away: so many more units in the last place.
    double const rounding = gamma_bound(placed ? 4096 : 64) * 32;
    for (int i = 0; i < 100; ++i) {
      exact::IntegerLine const line = random_line(dice, !placed);
      if (line.direction == Point{}) continue;
      exact::Answer const expected = exact::follow(line, scene.bodies, scene.tree, rounding);
      ++counts.rays;
      counts.coincident += expected.coincident;
      if (expected.doubtful) {
        ++counts.left_out;
      } else {
        compare(world, *scratch, place, line, expected, counts);
      }
    }
  }
  ::testing::Test::RecordProperty("rays", std::to_string(counts.rays));
  ::testing::Test::RecordProperty("left_out", std::to_string(counts.left_out));
  std::cout << counts.rays << " rays, " << counts.crossings << " crossings, " << counts.coincident
            << " coincidences, " << counts.left_out << " left out, " << counts.wrong << " wrong\n";
  return counts;
}

void expect_right(Counts const& counts) {
  EXPECT_EQ(counts.wrong, 0);
  EXPECT_LT(counts.left_out, counts.rays / 100);
  EXPECT_GT(counts.crossings, counts.rays / 4);
  EXPECT_GT(counts.coincident, counts.rays / 20);
}

TEST(ExactCsg, PlanesAndBoxes) {
  expect_right(run(false, false, 1));
}
TEST(ExactCsg, WithQuadrics) {
  expect_right(run(true, false, 2));
}
TEST(ExactCsg, PlanesAndBoxesTurnedAndMoved) {
  expect_right(run(false, true, 3));
}
TEST(ExactCsg, WithQuadricsTurnedAndMoved) {
  expect_right(run(true, true, 4));
}

} // namespace
} // namespace abbe::geometry
