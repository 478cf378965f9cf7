// SPDX-License-Identifier: MIT
#include "transport/wavelengths/apart.hpp"

namespace abbe::transport {

void send_apart(SplitTools const& tools, SplitRays const& rays, std::uint32_t const* lanes,
                std::size_t count) {
  Chunk const& chunk = rays.chunk;
  LightKind const& kind = chunk.kind;
  Departing out = tools.emitter.room({1, rays.wave, kind.comb, true, kind.control}, count);
  out.counted = &RayCounts::monochromatic;
  out.count = count;
  auto const each = static_cast<std::uint32_t>(chunk.each);
  for (std::size_t i = 0; i < count; ++i) {
    std::uint32_t const k = lanes[i], r = k / each, c = k % each;
    out.ray[i] = r;
    out.x[i] = rays.ways.x[k];
    out.y[i] = rays.ways.y[k];
    out.z[i] = rays.ways.z[k];
    out.level[i] = static_cast<std::uint16_t>(chunk.level[r] + 1);
    out.slot[i] = chunk.slot[r] + c;
    out.channel[i] = chunk.channels[k];
    out.tooth[i] = static_cast<std::uint16_t>(chunk.tooth_of(r, c));
    out.light[i] = rays.light[k];
  }
  tools.emitter.send(chunk, out);
}

void SplitApart::split(SplitTools const& tools, SplitRays const& rays) const {
  Arena::Scope const scope(tools.arena);
  std::size_t const lanes = rays.chunk.lanes();
  auto* const all = tools.arena.take<std::uint32_t>(lanes);
  std::size_t count = 0;
  for (std::size_t k = 0; k < lanes; ++k)
    if (rays.light[k] != 0) all[count++] = static_cast<std::uint32_t>(k);
  send_apart(tools, rays, all, count);
}

} // namespace abbe::transport
