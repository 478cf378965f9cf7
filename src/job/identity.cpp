// SPDX-License-Identifier: MIT
#include "job/identity.hpp"

#include "base/word_hash.hpp"

#include <fmt/format.h>
#include <fstream>
#include <sstream>

namespace abbe::job {
namespace {

std::string program() {
  std::ifstream file("/proc/self/exe", std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  return std::move(bytes).str();
}

} // namespace

std::uint64_t picture_identity(std::uint64_t scene, render::RenderOptions const& options) {
  WordHash hash;
  hash.add(scene);
  render::Region const region = options.pixels();
  auto const& aa = options.anti_aliasing;
  hash.add_text(fmt::format("{} {} {} {} {} {} {} {} {} {:a} {:a} {} {} {} {} {} {} {} {:a}",
                            options.width, options.height, region.x0, region.y0, region.x1,
                            region.y1, options.tile_size, aa.method, aa.depth, aa.threshold,
                            aa.jitter, options.seed, options.spectral_output, options.check_finite,
                            options.max_trace_level.value_or(0), options.passes, aa.samples.least,
                            aa.samples.most, aa.samples.error));
  hash.add_text(program());
  return hash.value();
}

} // namespace abbe::job
