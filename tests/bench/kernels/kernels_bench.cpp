// SPDX-License-Identifier: MIT
// Kernels one by one: what a ray asks of the world, and an interface of a ray. `ninja
// bench_kernels`.
#include "geometry/shapes/box.hpp"
#include "geometry/shapes/plane.hpp"
#include "geometry/shapes/prism.hpp"
#include "geometry/shapes/sphere.hpp"
#include "geometry/shapes/torus.hpp"
#include "geometry/world.hpp"
#include "optics/refract.hpp"
#include "tests/unit/geometry/fan_batch.hpp"

#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

namespace abbe::geometry {
namespace {

/// Rays from a sphere of radius 8 to points near the origin.
std::vector<Ray> rays() {
  std::mt19937_64 numbers(1);
  std::normal_distribution<double> normal;
  auto const point = [&] { return Vec3(normal(numbers), normal(numbers), normal(numbers)); };
  std::vector<Ray> out(4096);
  for (auto& ray : out) {
    ray.origin = 8.0 * glm::normalize(point());
    ray.direction = glm::normalize(0.6 * point() - ray.origin);
  }
  return out;
}

World world_of(std::vector<PlacedShape> primitives) {
  std::vector<World::Solid> solids(primitives.size());
  for (std::size_t i = 0; i < solids.size(); ++i)
    solids[i].tree.primitive = static_cast<PrimitiveId>(i);
  return World(std::move(primitives), std::move(solids));
}

World box_less_spheres(int count) {
  std::vector<PlacedShape> primitives{*make_box(Vec3(-1), Vec3(1))};
  World::Solid solid;
  solid.tree.op = CsgTree::Op::Difference;
  solid.tree.children.resize(static_cast<std::size_t>(count) + 1);
  std::mt19937_64 numbers(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 1; i <= count; ++i) {
    primitives.push_back(*make_sphere(Vec3(uniform(numbers), 1, uniform(numbers)), 0.2));
    solid.tree.children[static_cast<std::size_t>(i)].primitive = static_cast<PrimitiveId>(i);
  }
  std::vector<World::Solid> solids;
  solids.push_back(std::move(solid));
  return World(std::move(primitives), std::move(solids));
}

World many_spheres(int count) {
  std::vector<PlacedShape> primitives;
  std::mt19937_64 numbers(3);
  std::uniform_real_distribution<double> uniform(-3, 3);
  for (int i = 0; i < count; ++i)
    primitives.push_back(
        *make_sphere(Vec3(uniform(numbers), uniform(numbers), uniform(numbers)), 0.05));
  return world_of(std::move(primitives));
}

void closest(benchmark::State& state, World const& world) {
  auto const all = rays();
  auto const scratch = World::make_scratch();
  HitGroup hit;
  std::size_t i = 0;
  for (auto _ : state) {
    hit.clear();
    benchmark::DoNotOptimize(
        world.closest(all[i++ % all.size()], nullptr, 0xff, 1e9, *scratch, hit));
  }
  state.SetItemsProcessed(state.iterations());
}

void occluded(benchmark::State& state, World const& world) {
  auto const all = rays();
  auto const scratch = World::make_scratch();
  std::size_t i = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(world.occluded(all[i++ % all.size()], nullptr, 0xff, 1e9, *scratch));
  state.SetItemsProcessed(state.iterations());
}

/// Whole fans from one place, spread a little: a time a ray.
void closest_fan(benchmark::State& state, World const& world) {
  auto const all = rays();
  auto const scratch = World::make_scratch();
  std::vector<FanLines> fans(64);
  for (std::size_t i = 0; i < fans.size(); ++i) {
    Ray const& first = all[i];
    fans[i].count = fan_width;
    for (std::size_t k = 0; k < fan_width; ++k) {
      fans[i].origin.set(k, first.origin);
      fans[i].direction.set(
          k, glm::normalize(first.direction + 1e-3 * static_cast<double>(k) * Vec3(1, 0, 0)));
      fans[i].origin_error.set(k, Vec3(0));
    }
  }
  std::vector<RayStart> const starts(fan_width);
  Hits hits;
  std::size_t i = 0;
  for (auto _ : state) {
    FanLines& fan = fans[i++ % fans.size()];
    RayLines const lines = batch_of(fan, starts.data());
    world.intersect(lines, 0xff, nullptr, *scratch, hits);
    benchmark::DoNotOptimize(hits);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(fan_width));
}
void fan_sphere(benchmark::State& state) {
  closest_fan(state, world_of({*make_sphere(Vec3(0), 1)}));
}
/// As in prism_detail: a prism above a ground.
void fan_prism(benchmark::State& state) {
  closest_fan(state, world_of({*make_plane({0, 1, 0}, -2),
                               *make_prism({{{-1, 0}, {1, 0}, {0, 1.5}}}, -1, 1, false)}));
}

void closest_sphere(benchmark::State& state) {
  closest(state, world_of({*make_sphere(Vec3(0), 1)}));
}
void closest_box(benchmark::State& state) {
  closest(state, world_of({*make_box(Vec3(-1), Vec3(1))}));
}
void closest_torus(benchmark::State& state) {
  closest(state, world_of({*make_torus(1, 0.3)}));
}
void closest_csg(benchmark::State& state) {
  closest(state, box_less_spheres(static_cast<int>(state.range(0))));
}
void closest_spheres(benchmark::State& state) {
  closest(state, many_spheres(static_cast<int>(state.range(0))));
}
void occluded_spheres(benchmark::State& state) {
  occluded(state, many_spheres(static_cast<int>(state.range(0))));
}
void build_spheres(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(many_spheres(static_cast<int>(state.range(0))));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
/// One lane of a split: Fresnel and Snell.
void interface(benchmark::State& state) {
  Vec3 const normal(0, 1, 0);
  double cosine = 0.1;
  for (auto _ : state) {
    cosine = cosine < 0.9 ? cosine + 0.001 : 0.1;
    Vec3 const direction(std::sqrt(1 - cosine * cosine), -cosine, 0);
    auto const at = optics::fresnel<double>(1.0, 1.78472, cosine);
    benchmark::DoNotOptimize(optics::refracted(at, direction, normal));
  }
  state.SetItemsProcessed(state.iterations());
}

BENCHMARK(closest_sphere);
BENCHMARK(closest_box);
BENCHMARK(closest_torus);
BENCHMARK(closest_csg)->Arg(1)->Arg(10)->Arg(100);
BENCHMARK(closest_spheres)->Arg(10)->Arg(1000)->Arg(100000);
BENCHMARK(occluded_spheres)->Arg(10)->Arg(1000)->Arg(100000);
BENCHMARK(build_spheres)->Arg(100000);
BENCHMARK(interface);
BENCHMARK(fan_sphere);
BENCHMARK(fan_prism);

} // namespace
} // namespace abbe::geometry

BENCHMARK_MAIN();
