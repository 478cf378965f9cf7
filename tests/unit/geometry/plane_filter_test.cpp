// SPDX-License-Identifier: MIT
#include "geometry/plane_filter.hpp"

#include "fan_walk.hpp"
#include "lattice.hpp"

#include <cmath>

/// Cut stones, of whose many half-spaces fans ask those alone that a filter in floats leaves, give
/// the bits of each ray alone.
namespace abbe::geometry::test {
namespace {

/// An intersection of planes about a ball, some of them nearly or wholly alike, some taken away by
/// their other side; and of a cylinder.
World stone(Dice& dice, int planes, double size, Vec3 const& centre) {
  std::vector<PlacedShape> shapes;
  std::vector<CsgTree> parts;
  Transform const place = Transform::translation(centre * size);
  Vec3 normal(0, 1, 0);
  for (int i = 0; i < planes; ++i) {
    if (dice.below(8) != 0) normal = dice.direction();
    if (dice.below(6) == 0) normal += 1e-6 * dice.direction();
    double const distance = size * (1 + 0.2 * dice.below(3));
    bool const other_side = dice.below(5) == 0;
    shapes.push_back(moved(
        *make_plane(other_side ? -normal : normal, other_side ? -distance : distance), place));
    CsgTree part = leaf(static_cast<PrimitiveId>(i));
    part.inverse = other_side;
    parts.push_back(part);
  }
  if (dice.below(2) == 0) {
    parts.push_back(leaf(static_cast<PrimitiveId>(planes)));
    shapes.push_back(
        moved(*make_cylinder(Vec3(0, -size, 0), Vec3(0, size, 0), 1.2 * size, false), place));
  }
  return World(shapes, {{node(Op::Intersection, std::move(parts))}});
}

TEST(PlaneFilter, LeavesTheBitsOfCutStones) {
  Dice dice(5);
  WalkCounts counts;
  for (int i = 0; i < 150 && !HasFailure(); ++i) {
    // Also where floats are too narrow, and far from the origin.
    constexpr double sizes[] = {1, 1e-9, 1e9, 1e-30, 1e30};
    double const size = sizes[i % 5];
    Vec3 const centre = dice.in_cube(std::pow(10.0, dice.below(4) - 1));
    World const world = stone(dice, 6 + dice.below(70), size, centre);
    for (int fan = 0; fan < 30; ++fan) walk_fan(world, size, dice, counts);
  }
  EXPECT_GT(counts.single, counts.rays / 8);
}

/// By less than floats tell apart: rays that start over a plane or under it, and such that are
/// nearly parallel to one.
TEST(PlaneFilter, KeepsPlanesThatAreNearOrNearlyParallel) {
  Dice dice(7);
  ScratchPtr const scratch = World::make_scratch();
  int single = 0;
  for (int i = 0; i < 400 && !HasFailure(); ++i) {
    std::vector<PlacedShape> shapes;
    std::vector<CsgTree> parts;
    std::vector<Vec3> normals;
    for (PrimitiveId k = 0; k < 40; ++k) {
      normals.push_back(dice.direction());
      shapes.push_back(*make_plane(normals.back(), 1));
      parts.push_back(leaf(k));
    }
    World const world(shapes, {{node(Op::Intersection, std::move(parts))}});
    for (int fan = 0; fan < 20; ++fan) {
      Vec3 const normal = normals[static_cast<std::size_t>(dice.below(40))];
      Vec3 const along = glm::normalize(glm::cross(normal, dice.direction()));
      auto const sign = [&] { return dice.below(2) == 0 ? 1.0 : -1.0; };
      auto const small = [&] { return sign() * std::pow(10.0, -dice.number(3, 12)); };
      // All alike: a plane that one ray needs is listed for all.
      Vec3 const origin = (1 + small()) * normal;
      Vec3 const direction = sign() * along + (dice.below(2) == 0 ? small() : sign()) * normal;
      FanLines lines;
      lines.count = fan_width;
      double t_max[fan_width];
      for (std::size_t k = 0; k < lines.count; ++k) {
        lines.origin.set(k, origin);
        lines.direction.set(k, glm::normalize(direction + dice.in_cube(1e-15)));
        lines.origin_error.set(k, Vec3(0));
        t_max[k] = infinity;
      }
      single += compare_fan(world, lines, nullptr, t_max, *scratch).single;
    }
  }
  EXPECT_GT(single, 10000);
}

/// Rays that start inside of a stone and are near none of its planes need few of them.
TEST(PlaneFilter, ListsThePlanesThatMatter) {
  HalfSpaces planes;
  Dice dice(6);
  std::vector<Placed> placed;
  for (int i = 0; i < 60; ++i) placed.emplace_back(*make_plane(dice.direction(), 1));
  for (std::size_t i = 0; i < placed.size(); ++i)
    planes.add(static_cast<PrimitiveId>(i), placed[i], false);
  planes.finish();
  std::size_t listed = 0;
  for (int i = 0; i < 100; ++i) {
    FanLines rays;
    rays.count = filter_rays;
    Vec3 const direction = dice.direction();
    for (std::size_t k = 0; k < rays.count; ++k) {
      rays.origin.set(k, Vec3(0.1, 0.2, 0.3));
      rays.direction.set(k, direction);
      rays.origin_error.set(k, Vec3(0));
    }
    PlaneList list;
    list_planes<lane::Float8>(planes, rays, nullptr, {}, 0, list);
    ASSERT_GE(list.count, 1U);
    listed += list.count;
    // The nearest is among them.
    std::size_t nearest = 0;
    double t = infinity;
    for (std::size_t k = 0; k < planes.count(); ++k) {
      auto const [normal, level] = planes.plane(k);
      double const speed = glm::dot(normal, direction);
      double const here = (level - glm::dot(normal, rays.origin.get(0))) / speed;
      if (speed > 0 && here < t) {
        t = here;
        nearest = k;
      }
    }
    EXPECT_NE(std::find(list.place.begin(), list.place.begin() + list.count, nearest),
              list.place.begin() + list.count);
  }
  EXPECT_LT(listed, 300U);
}

} // namespace
} // namespace abbe::geometry::test
