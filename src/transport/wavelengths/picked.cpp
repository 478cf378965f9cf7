// SPDX-License-Identifier: MIT
#include "transport/wavelengths/picked.hpp"

namespace abbe::transport {

void SplitPicked::split(SplitTools const& tools, SplitRays const& rays) const {
  Arena::Scope const scope(tools.arena);
  Chunk const& chunk = rays.chunk;
  auto const each = static_cast<int>(chunk.each);
  int const first_line = tools.waves.drawn_teeth(rays.comb);
  std::size_t const kept = 1 + static_cast<std::size_t>(each - first_line);
  Departing out = tools.emitter.room({1, rays.wave, chunk.kind.comb, true, chunk.kind.control},
                                     chunk.count * kept);
  out.counted = &RayCounts::monochromatic;
  auto const follow = [&](std::size_t r, int tooth, double weight, std::uint32_t slot) {
    std::size_t const i = out.count, k = r * chunk.each + static_cast<std::size_t>(tooth);
    if (rays.light[k] == 0) return;
    ++out.count;
    out.ray[i] = static_cast<std::uint32_t>(r);
    out.x[i] = rays.ways.x[k];
    out.y[i] = rays.ways.y[k];
    out.z[i] = rays.ways.z[k];
    out.level[i] = static_cast<std::uint16_t>(chunk.level[r] + 1);
    out.slot[i] = slot;
    out.channel[i] = chunk.channels[k];
    out.tooth[i] = static_cast<std::uint16_t>(tooth);
    out.light[i] = rays.light[k] * weight;
  };
  for (std::size_t r = 0; r < chunk.count; ++r) {
    auto const pick = tools.waves.pick(rays.comb, chunk.sample[r]);
    auto const block = tools.film.block_of(chunk.slot[r]);
    follow(r, pick.tooth, pick.weight, tools.film.picked_slot(block, rays.comb, pick.tooth));
    for (int tooth = first_line; tooth < each; ++tooth)
      follow(r, tooth, 1, chunk.slot[r] + static_cast<std::uint32_t>(tooth));
  }
  tools.emitter.send(chunk, out);
}

} // namespace abbe::transport
