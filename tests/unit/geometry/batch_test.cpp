// SPDX-License-Identifier: MIT
#include "geometry/batch.hpp"

#include "fan_check.hpp"
#include "geometry/shapes/box.hpp"
#include "geometry/shapes/cone.hpp"
#include "geometry/shapes/cylinder.hpp"
#include "geometry/shapes/disc.hpp"
#include "geometry/shapes/mesh.hpp"
#include "geometry/shapes/plane.hpp"
#include "geometry/shapes/quadric.hpp"
#include "geometry/shapes/sphere.hpp"
#include "geometry/shapes/superellipsoid.hpp"
#include "geometry/shapes/torus.hpp"
#include "scene.hpp"

#include <gtest/gtest.h>

#include <cmath>

/// What a batch of rays is told is what each of its rays is told alone.
namespace abbe::geometry::test {
namespace {

/// A ball of triangles; its poles are fans of them.
MeshData ball(int rings, bool smooth, bool solid) {
  MeshData mesh;
  int const around = 2 * rings;
  for (int ring = 0; ring <= rings; ++ring) {
    double const height = M_PI * ring / rings;
    for (int k = 0; k < around; ++k) {
      double const turn = 2 * M_PI * k / around;
      mesh.vertices.push_back(
          {std::sin(height) * std::cos(turn), std::cos(height), std::sin(height) * std::sin(turn)});
    }
  }
  auto const at = [&](int ring, int k) {
    return static_cast<std::uint32_t>(ring * around + k % around);
  };
  for (int ring = 0; ring < rings; ++ring)
    for (int k = 0; k < around; ++k) {
      mesh.faces.push_back({at(ring, k), at(ring, k + 1), at(ring + 1, k)});
      mesh.faces.push_back({at(ring, k + 1), at(ring + 1, k + 1), at(ring + 1, k)});
    }
  for (Vec3& vertex : mesh.vertices)
    if (std::fabs(vertex.y) == 1)
      vertex = {0, vertex.y, 0}; // poles: faces without area are dropped
  if (smooth) {
    mesh.normals = mesh.vertices;
    mesh.normal_corners = mesh.faces;
    for (std::size_t i = 0; i < mesh.faces.size(); i += 3)
      mesh.normal_corners[i][0] = MeshData::flat;
  }
  if (solid) mesh.inside_vector = Vec3(0.3, 0.5, 0.8);
  return mesh;
}

PlacedShape any_shape(Dice& dice) {
  Vec3 const low = dice.in_cube(4), size = 0.3 + glm::abs(dice.in_cube(1.2));
  auto const mesh = [&] {
    return make_mesh(ball(4 + dice.below(9), dice.below(2) == 0, dice.below(2) == 0));
  };
  PlacedShape placed = [&] {
    switch (dice.below(11)) {
    case 0:
    case 1:
    case 2:
      return *make_sphere(low, size.x);
    case 3:
      return *make_box(low, low + size);
    case 4:
      return *make_cylinder(low, low + size, 0.5 * size.y, dice.below(2) == 0);
    case 5:
      return *make_cone(low, size.x, low + size, 0.3 * size.x, dice.below(2) == 0);
    case 6:
      return *make_torus(size.x, 0.3 * size.x);
    case 7:
      return *make_disc(low, size, size.x, 0.4 * size.x);
    case 8:
      return *make_superellipsoid(0.5, 0.7);
    case 9:
      return *make_quadric({1, 2, 0.5, 0.1, 0, 0, 0, 0, 0.2, -1});
    default:
      return *mesh().shape;
    }
  }();
  if (dice.below(2) == 0) placed = moved(placed, Transform::rotation(180.0 * dice.in_cube(1)));
  if (dice.below(2) == 0) placed = moved(placed, Transform::translation(dice.in_cube(3)));
  return placed;
}

/// Single shapes, boolean trees of two and three, touching boxes, a plane or none; few or many.
World any_world(Dice& dice) {
  std::vector<PlacedShape> shapes;
  std::vector<World::Solid> solids;
  auto const shape = [&](PlacedShape const& placed) {
    shapes.push_back(placed);
    return leaf(static_cast<PrimitiveId>(shapes.size() - 1));
  };
  Op const ops[] = {Op::Difference, Op::Intersection, Op::Merge, Op::Clip};
  int const many = dice.below(2) == 0 ? 6 : 60;
  for (int i = 0; i < many; ++i) {
    CsgTree tree = shape(any_shape(dice));
    for (int more = dice.below(6); more < 2; ++more)
      tree = node(ops[dice.below(4)], {tree, shape(any_shape(dice))});
    auto const mask = static_cast<std::uint8_t>(dice.below(5) == 0 ? 2 : 0xff);
    solids.push_back({tree, mask, dice.below(2) == 0});
  }
  Vec3 const corner = dice.in_cube(2);
  solids.push_back({shape(*make_box(corner, corner + Vec3(1)))});
  solids.push_back({shape(*make_box(corner + Vec3(1, 0, 0), corner + Vec3(2, 1, 1)))});
  if (dice.below(2) == 0) solids.push_back({shape(*make_plane({0, 1, 0}, -3))});
  return World(shapes, solids, dice.below(2) == 0 ? 0x1p-22 : 0);
}

/// The rays of a batch, in memory of their own.
struct Batch {
  static constexpr std::size_t most = 300;
  std::vector<double> numbers = std::vector<double>(9 * most), t_max = std::vector<double>(most);
  std::vector<RayStart> start = std::vector<RayStart>(most);
  RayLines lines;
  Batch() {
    double* at = numbers.data();
    for (VectorArrays* const v : {&lines.origin, &lines.direction, &lines.origin_error})
      for (double** const values : {&v->x, &v->y, &v->z}) {
        *values = at;
        at += most;
      }
    lines.start = start.data();
  }
  void add(Vec3 const& origin, Vec3 const& error, Vec3 const& direction, double until,
           RayStart const& from) {
    std::size_t const k = lines.count++;
    lines.origin.set(k, origin);
    lines.origin_error.set(k, error);
    lines.direction.set(k, direction);
    t_max[k] = until;
    start[k] = from;
  }
};

/// Some directions stand still along one axis or two.
Vec3 any_direction(Dice& dice) {
  Vec3 direction = dice.direction();
  int const still = dice.below(6);
  if (still < 2) direction[dice.below(3)] = 0;
  if (still == 0) {
    int const axis = dice.below(3);
    Vec3 along(0);
    along[axis] = dice.below(2) == 0 ? 1 : -1;
    along[(axis + 1) % 3] = -0.0;
    return along;
  }
  return glm::normalize(direction);
}

struct Counts {
  int single = 0, group = 0, nothing = 0, blocked = 0;
};

class BatchTest : public ::testing::Test {
protected:
  /// Asks for the batch together and one by one.
  void compare(World const& world, Batch const& batch, std::uint8_t mask, bool bounded,
               Hits& hits) {
    RayLines const& lines = batch.lines;
    world.intersect(lines, mask, bounded ? batch.t_max.data() : nullptr, *together_, hits);
    std::vector<std::uint8_t> blocked(Batch::most, 2);
    world.occluded(lines, mask, batch.t_max.data(), *together_, blocked.data());
    for (std::size_t k = 0; k < lines.count; ++k) {
      RayStart const& start = batch.start[k];
      Departure from;
      if (start.kind == RayStart::Kind::Surface)
        from.on = {{start.number, start.face, start.was_entering}};
      if (start.kind == RayStart::Kind::Group) from.on = (*lines.groups)[start.number].members;
      from.through = start.through;
      Departure const* const given = start.kind == RayStart::Kind::Nowhere ? nullptr : &from;
      expect_same(world, lines.get(k), given, mask, bounded ? batch.t_max[k] : infinity, hits, k);
      bool const own = world.occluded(lines.get(k), given, mask, batch.t_max[k], *alone_);
      ASSERT_EQ(blocked[k], own ? 1 : 0);
      counts_.blocked += own ? 1 : 0;
    }
  }
  void expect_same(World const& world, Ray const& ray, Departure const* from, std::uint8_t mask,
                   double until, Hits const& hits, std::size_t k) {
    HitGroup alone;
    RayHit const& hit = hits.hit[k];
    bool const found = world.closest(ray, from, mask, until, *alone_, alone);
    ASSERT_EQ(found, hit.kind != RayHit::Kind::Nothing);
    ++(!found                             ? counts_.nothing
       : hit.kind == RayHit::Kind::Single ? counts_.single
                                          : counts_.group);
    if (!found) return;
    expect_same_group(alone, group_of(hits, k));
  }
  /// A batch from what the rays of another met, through it and back from it.
  void leave_all(World const& world, Batch const& from, Hits const& hits, Dice& dice, Batch& out) {
    out.lines.count = 0;
    out.lines.groups = &hits.groups;
    for (std::size_t k = 0; k < from.lines.count && out.lines.count < Batch::most; ++k) {
      RayHit const& hit = hits.hit[k];
      if (hit.kind == RayHit::Kind::Nothing) continue;
      RayStart start{hit.primitive, hit.face, RayStart::Kind::Surface, hit.was_entering,
                     dice.below(2) == 0};
      if (hit.kind == RayHit::Kind::Group) {
        start.kind = RayStart::Kind::Group;
        start.number = hits.group[k];
        start.face = 0;
      }
      Vec3 const point = hits.point.get(k);
      Vec3 direction = dice.below(2) == 0 ? from.lines.direction.get(k) : any_direction(dice);
      Vec3 const normal = world.geometric_normal(hit.primitive, hit.face, point);
      double const before = glm::dot(from.lines.direction.get(k), normal);
      if ((glm::dot(direction, normal) * before > 0) != start.through) direction = -direction;
      out.add(point, hits.point_error.get(k), direction, dice.number(0, 12), start);
    }
  }

  ScratchPtr together_ = World::make_scratch(), alone_ = World::make_scratch();
  Counts counts_;
};

TEST_F(BatchTest, EachRayIsToldWhatItIsToldAlone) {
  Dice dice(1);
  for (int run = 0; run < 60 && !HasFailure(); ++run) {
    World const world = any_world(dice);
    Hits hits[2];
    Batch batch[2];
    Vec3 const eye = 12.0 * dice.direction(), to = dice.in_cube(2);
    double const spread = std::pow(10.0, -dice.number(-0.5, 6));
    std::size_t const count = 1 + static_cast<std::size_t>(dice.below(Batch::most - 1));
    for (std::size_t k = 0; k < count; ++k) {
      bool const astray = dice.below(8) == 0;
      batch[0].add(astray ? dice.in_cube(5) : eye, Vec3(0),
                   astray ? any_direction(dice) : glm::normalize(to - eye + dice.in_cube(spread)),
                   dice.number(0, 20), {});
    }
    auto const mask = static_cast<std::uint8_t>(run % 3 == 0 ? 2 : 1);
    for (int depth = 0; depth < 4 && !HasFailure(); ++depth) {
      Batch& here = batch[depth % 2];
      compare(world, here, mask, dice.below(3) == 0, hits[depth % 2]);
      leave_all(world, here, hits[depth % 2], dice, batch[(depth + 1) % 2]);
    }
  }
  // The comparison says something of each kind.
  EXPECT_GT(counts_.single, 5000);
  EXPECT_GT(counts_.group, 100);
  EXPECT_GT(counts_.nothing, 1000);
  EXPECT_GT(counts_.blocked, 2000);
}

TEST_F(BatchTest, NormalsOfManyHitsAreThoseOfEach) {
  Dice dice(2);
  int compared = 0, smooth = 0;
  for (int run = 0; run < 60; ++run) {
    World const world = any_world(dice);
    Batch batch;
    Vec3 const eye = 12.0 * dice.direction(), to = dice.in_cube(2);
    for (std::size_t k = 0; k < Batch::most; ++k)
      batch.add(eye, Vec3(0), glm::normalize(to - eye + dice.in_cube(run % 4)), infinity, {});
    Hits hits;
    world.intersect(batch.lines, 0xff, nullptr, *together_, hits);
    std::vector<double> numbers(6 * Batch::most, 7);
    auto const arrays = [&](std::size_t at) {
      double* const first = numbers.data() + at * Batch::most;
      return VectorArrays{first, first + Batch::most, first + 2 * Batch::most};
    };
    VectorArrays const smoothed = arrays(0), geometric = arrays(3);
    // From a place that need not be aligned.
    std::size_t const first = static_cast<std::size_t>(run % 5), count = Batch::most - first;
    world.normals(count, hits.hit.data() + first, hits.point.from(first), smoothed.from(first),
                  geometric.from(first));
    for (std::size_t k = 0; k < Batch::most; ++k) {
      RayHit const& hit = hits.hit[k];
      World::Normals own{Vec3(7), Vec3(7)};
      if (k >= first && hit.kind != RayHit::Kind::Nothing) {
        own = world.normals(hit.primitive, hit.face, hits.point.get(k));
        ++compared;
      }
      ASSERT_EQ(smoothed.get(k), own.smoothed);
      ASSERT_EQ(geometric.get(k), own.geometric);
      smooth += own.smoothed != own.geometric ? 1 : 0;
    }
  }
  EXPECT_GT(compared, 5000);
  EXPECT_GT(smooth, 100);
}

} // namespace
} // namespace abbe::geometry::test
