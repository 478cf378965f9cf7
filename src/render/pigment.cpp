// SPDX-License-Identifier: MIT
#include "render/pigment.hpp"

#include <algorithm>

namespace abbe::render {
namespace {

void blend(PigmentValue& value, PigmentValue const& other, double weight, int lanes) {
  for (int k = 0; k < lanes; ++k) value.colour[k] += weight * (other.colour[k] - value.colour[k]);
  value.filter += weight * (other.filter - value.filter);
  value.transmit += weight * (other.transmit - value.transmit);
}

} // namespace

template <int Lanes>
void evaluate_pigment(Stage const& stage, int pigment, Vec3 const& point,
                      std::uint16_t const* channel, int lanes, PigmentValue& out, Arena& arena) {
  CompiledPigment const& p = stage.pigments[static_cast<std::size_t>(pigment)];
  if (!p.pattern) return plain_pigment<Lanes>(p, channel, lanes, out);
  // The items of a list stand at 0, 1 ..: a written frequency or wave blends them, as in POV-Ray.
  texture::MapPosition const position = texture::look_up(p.values, p.pattern->evaluate(point));
  auto const entry = [&](int i) { return p.entries[static_cast<std::size_t>(i)]; };
  // The entries see the point after the parent's own warps and transforms.
  Vec3 inner = point;
  for (auto m = p.pattern->mappings.rbegin(); m != p.pattern->mappings.rend(); ++m)
    inner = m->linear * inner + m->offset;
  evaluate_pigment<Lanes>(stage, entry(position.first), inner, channel, lanes, out, arena);
  if (position.weight == 0) return;
  Arena::Scope const scope(arena);
  PigmentValue other{arena.take<double>(static_cast<std::size_t>(lanes))};
  evaluate_pigment<Lanes>(stage, entry(position.second), inner, channel, lanes, other, arena);
  blend(out, other, position.weight, Lanes > 0 ? Lanes : lanes);
}

template void evaluate_pigment<0>(Stage const&, int, Vec3 const&, std::uint16_t const*, int,
                                  PigmentValue&, Arena&);
template void evaluate_pigment<1>(Stage const&, int, Vec3 const&, std::uint16_t const*, int,
                                  PigmentValue&, Arena&);
template void evaluate_pigment<3>(Stage const&, int, Vec3 const&, std::uint16_t const*, int,
                                  PigmentValue&, Arena&);

double opacity(Stage const& stage, PigmentValue const& value, int lanes) {
  if (stage.opacity_version >= 3.7) return 1 - value.filter - value.transmit;
  double brightest = 0;
  for (int k = 0; k < lanes; ++k) brightest = std::max(brightest, value.colour[k]);
  return 1 - (value.filter * brightest + value.transmit);
}

void tint(Stage const& stage, Surface const& surface, Vec3 const& point,
          std::uint16_t const* channel, int lanes, double* left, Arena& arena) {
  Arena::Scope const scope(arena);
  PigmentValue pigment{arena.take<double>(static_cast<std::size_t>(lanes))};
  for (int const number : surface.layers) {
    CompiledLayer const& layer = stage.layers[static_cast<std::size_t>(number)];
    Vec3 const inner = layer.to_texture_linear * point + layer.to_texture_offset;
    if (lanes == 1)
      evaluate_pigment<1>(stage, layer.pigment, inner, channel, lanes, pigment, arena);
    else if (lanes == 3)
      evaluate_pigment<3>(stage, layer.pigment, inner, channel, lanes, pigment, arena);
    else
      evaluate_pigment<0>(stage, layer.pigment, inner, channel, lanes, pigment, arena);
    for (int k = 0; k < lanes; ++k)
      left[k] *= pigment.filter * pigment.colour[k] + pigment.transmit;
  }
}

} // namespace abbe::render
