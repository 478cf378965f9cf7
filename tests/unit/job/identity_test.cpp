// SPDX-License-Identifier: MIT
#include "job/identity.hpp"

#include <gtest/gtest.h>
#include <set>

namespace abbe::job {
namespace {

TEST(Identity, IsOfAllThatPixelsDependOn) {
  render::RenderOptions const plain;
  std::set<std::uint64_t> seen{picture_identity(1, plain), picture_identity(2, plain)};
  auto const with = [&](auto const& change) {
    render::RenderOptions options;
    change(options);
    seen.insert(picture_identity(1, options));
  };
  with([](auto& o) { o.width = 641; });
  with([](auto& o) { o.height = 481; });
  with([](auto& o) { o.region = render::Region{0, 0, 640, 479}; });
  with([](auto& o) { o.tile_size = 32; });
  with([](auto& o) { o.anti_aliasing.method = 1; });
  with([](auto& o) { o.anti_aliasing.method = 2; });
  with([](auto& o) { o.anti_aliasing.method = 3; });
  with([](auto& o) { o.anti_aliasing.samples.least = 2; });
  with([](auto& o) { o.anti_aliasing.samples.most = 2; });
  with([](auto& o) { o.anti_aliasing.samples.error = 0.25; });
  with([](auto& o) { o.anti_aliasing.depth = 4; });
  with([](auto& o) { o.anti_aliasing.threshold = 0.30000000000000004; });
  with([](auto& o) { o.anti_aliasing.jitter = 1; });
  with([](auto& o) { o.passes = 2; });
  with([](auto& o) { o.seed = 1; });
  with([](auto& o) { o.spectral_output = true; });
  with([](auto& o) { o.check_finite = !o.check_finite; });
  with([](auto& o) { o.max_trace_level = 5; });
  EXPECT_EQ(seen.size(), 20u);
}

TEST(Identity, IsTheSameForAnyThreads) {
  render::RenderOptions options;
  auto const one = picture_identity(1, options);
  options.threads = 7;
  EXPECT_EQ(picture_identity(1, options), one);
  options.region = render::Region{0, 0, 640, 480}; // all of it
  EXPECT_EQ(picture_identity(1, options), one);
}

} // namespace
} // namespace abbe::job
