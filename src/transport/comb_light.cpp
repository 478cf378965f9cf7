// SPDX-License-Identifier: MIT
#include "transport/comb_light.hpp"

namespace abbe::transport {

ChunkLight CombLight::teeth(Chunk const& chunk, int comb) const {
  ChunkLight out;
  int const teeth = waves_.teeth(comb);
  out.kind = {teeth, polychromatic, comb, chunk.kind.locked, chunk.kind.control};
  out.each = out.kind.size();
  std::size_t const lanes = chunk.count * out.each;
  out.channels = arena_.take<std::uint16_t>(lanes);
  out.light = arena_.take<double>(lanes + 8);
  bool const apart = film_.has_control(comb);
  for (std::size_t r = 0, k = 0; r < chunk.count; ++r) {
    auto const block = film_.block_of(chunk.slot[r]);
    out.slot[r] = apart ? film_.tooth_slot(block, comb, 0) : film_.channel_slot(block, 0);
    out.tooth[r] = 0;
    for (std::uint16_t const channel : waves_.channels(waves_.first_draw(comb), chunk.sample[r])) {
      out.channels[k] = channel;
      out.light[k++] = chunk.light[r * chunk.each + channel];
    }
  }
  return out;
}

ChunkLight CombLight::doubled(Chunk const& chunk, double const* light, int comb) const {
  ChunkLight out;
  out.kind = {2 * chunk.kind.lanes, polychromatic, comb, false, chunk.kind.control};
  out.each = out.kind.size();
  out.doubles = true;
  out.channels = arena_.take<std::uint16_t>(chunk.count * out.each);
  out.light = arena_.take<double>(chunk.count * out.each + 8);
  for (std::size_t r = 0, k = 0; r < chunk.count; ++r) {
    auto const spreads = waves_.spreads(waves_.first_draw(comb), chunk.sample[r]);
    out.slot[r] = film_.doubled_slot(film_.block_of(chunk.slot[r]), comb, 0);
    out.tooth[r] = 0;
    for (std::size_t c = 0; c < chunk.each; ++c, k += 2) {
      auto const& spread = spreads[c];
      out.channels[k] = static_cast<std::uint16_t>(spread.first);
      out.channels[k + 1] = static_cast<std::uint16_t>(spread.second);
      out.light[k] = light[r * chunk.each + c] * spread.first_weight;
      out.light[k + 1] = light[r * chunk.each + c] * spread.second_weight;
    }
  }
  return out;
}

ChunkLight CombLight::control(Chunk const& chunk, int comb) const {
  ChunkLight out = chunk;
  out.kind.comb = comb;
  out.kind.control = true;
  for (std::size_t r = 0; r < chunk.count; ++r)
    out.slot[r] = film_.control_slot(film_.block_of(chunk.slot[r]), comb, 0);
  return out;
}

} // namespace abbe::transport
