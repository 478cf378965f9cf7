// SPDX-License-Identifier: MIT
#include "render/compile.hpp"
#include "table_scene.hpp"
#include "transport/tracer.hpp"

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

using transport::SampleKey, transport::Tracer;

/// Samples of a whole picture.
void take_samples(Tracer& tracer) {
  constexpr int size = 32;
  double x[size], y[size];
  SampleKey keys[size];
  Vec3 sum(0);
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column) {
      x[column] = column + 0.5;
      y[column] = row + 0.5;
      keys[column] = {RandomKey(1).child(static_cast<std::uint64_t>(row * size + column)), 0};
    }
    tracer.trace({x, y, size, size, size}, keys);
    for (std::size_t k = 0; k < size; ++k) sum += tracer.light_of(k, {});
  }
  EXPECT_GT(sum.x, 0);
}

void expect_no_allocation(scene::Scene const& scene) {
  auto const plan = plan::make_plan(scene, {});
  ASSERT_TRUE(plan);
  Stage const stage = compile(scene, *plan);
  Tracer tracer(stage);
  take_samples(tracer); // scratch memory grows to what it needs
  std::size_t const before = taken;
  take_samples(tracer);
  EXPECT_EQ(taken, before);
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
