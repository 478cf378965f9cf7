// SPDX-License-Identifier: MIT
#include "transport/wavelengths/doubled.hpp"

namespace abbe::transport {

void SplitDoubled::split(SplitTools const& tools, SplitRays const& rays) const {
  Arena::Scope const scope(tools.arena);
  Chunk const& chunk = rays.chunk;
  std::size_t const lanes = chunk.lanes();
  if (chunk.kind.comb != no_comb) { // the second refraction
    auto* const all = tools.arena.take<std::uint32_t>(lanes);
    for (std::size_t k = 0; k < lanes; ++k) all[k] = static_cast<std::uint32_t>(k);
    return send_apart(tools, rays, all, lanes);
  }
  Departing out = tools.emitter.room({2, rays.wave, rays.comb, false, chunk.kind.control}, lanes);
  out.counted = &RayCounts::monochromatic;
  for (std::size_t r = 0, k = 0; r < chunk.count; ++r) {
    auto const spreads = tools.waves.spreads(rays.wave, chunk.sample[r]);
    auto const block = tools.film.block_of(chunk.slot[r]);
    for (std::size_t c = 0; c < chunk.each; ++c, ++k) {
      // What carries too little is not worth its two halves.
      if (!(rays.light[k] > tools.stage.adc_bailout)) {
        tools.emitter.cut(chunk.slot[r] + static_cast<std::uint32_t>(c), rays.light + k, 1);
        continue;
      }
      std::size_t const i = out.count++;
      int const band = chunk.channels[k];
      auto const& spread = spreads[static_cast<std::size_t>(band)];
      out.ray[i] = static_cast<std::uint32_t>(r);
      out.x[i] = rays.ways.x[k];
      out.y[i] = rays.ways.y[k];
      out.z[i] = rays.ways.z[k];
      out.level[i] = static_cast<std::uint16_t>(chunk.level[r] + 1);
      out.slot[i] = tools.film.doubled_slot(block, rays.comb, band);
      out.channel[i] = out.channels[2 * i] = static_cast<std::uint16_t>(spread.first);
      out.channels[2 * i + 1] = static_cast<std::uint16_t>(spread.second);
      out.tooth[i] = static_cast<std::uint16_t>(band);
      out.light[2 * i] = rays.light[k] * spread.first_weight;
      out.light[2 * i + 1] = rays.light[k] * spread.second_weight;
    }
  }
  tools.emitter.send(chunk, out);
}

} // namespace abbe::transport
