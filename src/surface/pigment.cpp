// SPDX-License-Identifier: MIT
#include "surface/pigment.hpp"

#include <algorithm>

namespace abbe::surface {
namespace {

void blend(PigmentValue& value, PigmentValue const& other, double weight, int lanes) {
  for (int k = 0; k < lanes; ++k) value.colour[k] += weight * (other.colour[k] - value.colour[k]);
  value.filter += weight * (other.filter - value.filter);
  value.transmit += weight * (other.transmit - value.transmit);
}

} // namespace

template <int Lanes>
void evaluate_pigment(Textures const& textures, int pigment, Vec3 const& point,
                      std::uint16_t const* channel, int lanes, PigmentValue& out, Arena& arena) {
  CompiledPigment const& p = textures.pigments[static_cast<std::size_t>(pigment)];
  if (p.pattern < 0) return plain_pigment<Lanes>(textures, p, channel, lanes, out);
  CompiledPattern const& map = textures.patterns[static_cast<std::size_t>(p.pattern)];
  // The items of a list stand at 0, 1 ..: a written frequency or wave blends them, as in POV-Ray.
  texture::MapPosition const position = texture::look_up(map.values, map.pattern->evaluate(point));
  auto const entry = [&](int i) { return map.entries[static_cast<std::size_t>(i)]; };
  // The entries see the point after the parent's own warps and transforms.
  Vec3 inner = point;
  for (auto m = map.pattern->mappings.rbegin(); m != map.pattern->mappings.rend(); ++m)
    inner = m->linear * inner + m->offset;
  evaluate_pigment<Lanes>(textures, entry(position.first), inner, channel, lanes, out, arena);
  if (position.weight == 0) return;
  Arena::Scope const scope(arena);
  PigmentValue other{arena.take<double>(static_cast<std::size_t>(lanes))};
  evaluate_pigment<Lanes>(textures, entry(position.second), inner, channel, lanes, other, arena);
  blend(out, other, position.weight, Lanes > 0 ? Lanes : lanes);
}

template void evaluate_pigment<0>(Textures const&, int, Vec3 const&, std::uint16_t const*, int,
                                  PigmentValue&, Arena&);
template void evaluate_pigment<1>(Textures const&, int, Vec3 const&, std::uint16_t const*, int,
                                  PigmentValue&, Arena&);
template void evaluate_pigment<3>(Textures const&, int, Vec3 const&, std::uint16_t const*, int,
                                  PigmentValue&, Arena&);

} // namespace abbe::surface
