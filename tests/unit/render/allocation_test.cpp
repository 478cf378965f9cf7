// SPDX-License-Identifier: MIT
#include "render/camera.hpp"
#include "table_scene.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

/// Counts what this program takes from the heap.
namespace {
std::atomic<std::size_t> taken{0};

void* take(std::size_t size, std::size_t alignment) {
  ++taken;
  std::size_t const whole = (size + alignment - 1) / alignment * alignment;
  void* const memory = alignment > alignof(std::max_align_t) ? std::aligned_alloc(alignment, whole)
                                                             : std::malloc(size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
} // namespace

void* operator new(std::size_t size) {
  return take(size > 0 ? size : 1, 1);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return take(size > 0 ? size : 1, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

namespace abbe::render::testing {
namespace {

/// Samples of a whole picture, one by one or, where that can be, together.
void take_samples(Stage const& stage, Tracer& tracer, bool together) {
  constexpr int size = 32;
  static_assert(size % geometry::fan_width == 0);
  Vec3 sum(0);
  for (int y = 0; y < size; ++y) {
    geometry::FanLines rays;
    SampleKey keys[geometry::fan_width];
    rays.count = 0;
    for (int x = 0; x < size; ++x) {
      auto const ray = camera_ray(stage.camera, x + 0.5, y + 0.5, size, size);
      auto const pixel = static_cast<std::uint64_t>(y * size + x);
      if (!together) {
        sum += tracer.sample(ray, {RandomKey(1).child(pixel), 0}, {});
        continue;
      }
      rays.origin.set(rays.count, ray.origin);
      rays.direction.set(rays.count, ray.direction);
      rays.origin_error.set(rays.count, ray.origin_error);
      keys[rays.count] = {RandomKey(1).child(pixel), 0};
      if (++rays.count < geometry::fan_width) continue;
      tracer.samples(rays, keys);
      for (std::size_t k = 0; k < rays.count; ++k) sum += tracer.light_of(k, {});
      rays.count = 0;
    }
  }
  EXPECT_GT(sum.x, 0);
}

void expect_no_allocation(scene::Scene const& scene) {
  auto const plan = plan::make_plan(scene, {});
  ASSERT_TRUE(plan);
  Stage const stage = compile(scene, *plan);
  Tracer tracer(stage);
  for (bool const together : {false, true}) {
    if (together && !tracer.together()) continue;
    take_samples(stage, tracer, together); // scratch memory grows to what it needs
    std::size_t const before = taken;
    take_samples(stage, tracer, together);
    EXPECT_EQ(taken, before) << (together ? "together" : "one by one");
  }
}

TEST(Allocation, NoneForSamplesOfRgb) {
  expect_no_allocation(table(none(), false));
}
TEST(Allocation, NoneForSamplesOfBands) {
  expect_no_allocation(table(deterministic(), true));
}
TEST(Allocation, NoneForStochasticSamples) {
  expect_no_allocation(table(stochastic(), true));
}

} // namespace
} // namespace abbe::render::testing
