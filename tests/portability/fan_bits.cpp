// SPDX-License-Identifier: MIT
#include "geometry/shapes/box.hpp"
#include "geometry/shapes/cone.hpp"
#include "geometry/shapes/cylinder.hpp"
#include "geometry/shapes/plane.hpp"
#include "geometry/shapes/sphere.hpp"
#include "geometry/shapes/torus.hpp"
#include "tests/unit/geometry/fan_batch.hpp"

#include <bit>
#include <cstdint>
#include <cstdio>
#include <random>
#include <vector>

/// Writes what fans of rays meet in a small world, bit for bit: the same text from every processor
/// and for every kind of registers (tests/portability/aarch64).
namespace abbe::geometry {
namespace {

CsgTree leaf(PrimitiveId id) {
  CsgTree tree;
  tree.primitive = id;
  return tree;
}

World make_world() {
  std::vector<PlacedShape> primitives;
  std::vector<World::Solid> solids;
  auto const shape = [&](auto const& made, Vec3 const& at) {
    auto const moved = made->placement.then(Transform::translation(at));
    primitives.push_back({made->shape, moved});
    return static_cast<PrimitiveId>(primitives.size() - 1);
  };
  auto const alone = [&](PrimitiveId id) { solids.push_back({leaf(id), 0xff, false}); };
  alone(shape(make_plane({0, 1, 0}, -1.5), Vec3(0)));
  alone(shape(make_sphere({-2, 0, 4}, 1), Vec3(0)));
  alone(shape(make_box({-0.5, -1, -0.5}, {0.5, 1, 0.75}), {0.25, 0, 5}));
  alone(shape(make_cylinder({0, -1, 0}, {0, 1, 0}, 0.5, false), {2, 0, 4}));
  alone(shape(make_cone({0, -1, 0}, 1, {0, 1, 0}, 0.25, false), {4, 0, 6}));
  alone(shape(make_torus(1, 0.25), {-4, 0, 7}));
  CsgTree bitten;
  bitten.op = CsgTree::Op::Difference;
  bitten.children = {leaf(shape(make_sphere({0, 2, 6}, 1), Vec3(0))),
                     leaf(shape(make_box({0, 1, 4}, {2, 3, 5.5}), Vec3(0)))};
  solids.push_back({bitten, 0xff, false});
  return World(std::move(primitives), std::move(solids));
}

void write(double value) {
  std::printf(" %016llx", static_cast<unsigned long long>(std::bit_cast<std::uint64_t>(value)));
}

void run() {
  World const world = make_world();
  auto const scratch = World::make_scratch();
  std::mt19937_64 engine(1);
  auto const number = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(engine() >> 11) * 0x1p-53);
  };
  // One after the other: arguments may be evaluated in any order.
  auto const near = [&](Vec3 place, double reach) {
    place.x += number(-reach, reach);
    place.y += number(-reach, reach);
    return place;
  };
  for (int fan = 0; fan < 4000; ++fan) {
    FanLines lines;
    lines.count = 1 + static_cast<std::size_t>(fan) % fan_width;
    Vec3 const aim = near(Vec3(0, 0, 1), 0.8);
    double const spread = fan % 3 == 0 ? 0.2 : 0.01;
    for (std::size_t k = 0; k < lines.count; ++k) {
      Vec3 const way = near(aim, spread);
      lines.origin.set(k, near(Vec3(0), 0.1));
      lines.direction.set(k, way / std::sqrt(glm::dot(way, way)));
      lines.origin_error.set(k, Vec3(0));
    }
    std::vector<RayStart> const starts(lines.count);
    RayLines const rays = batch_of(lines, starts.data());
    Hits hits;
    world.intersect(rays, 0xff, nullptr, *scratch, hits);
    for (std::size_t k = 0; k < lines.count; ++k) {
      RayHit const& hit = hits.hit[k];
      std::printf("%d %d", fan, static_cast<int>(hit.kind));
      if (hit.kind == RayHit::Kind::Single) {
        std::printf(" %u %u %d", hit.primitive, hit.face, hit.entering);
        for (double const value : {hits.t[k], hits.error[k], hits.point.x[k], hits.point.y[k],
                                   hits.point.z[k], hits.point_error.x[k]})
          write(value);
      }
      std::printf("\n");
    }
  }
}

} // namespace
} // namespace abbe::geometry

int main() {
  abbe::geometry::run();
}
