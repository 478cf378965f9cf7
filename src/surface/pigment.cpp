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

/// A colour that a pattern has by itself.
static void own_colour(Textures const& textures, texture::PatternColour const& colour,
                       std::uint16_t const* channel, int lanes, PigmentValue& out) {
  out.filter = colour.filter;
  out.transmit = colour.transmit;
  int const side = textures.colour_grid_side;
  if (side == 0) {
    for (int k = 0; k < lanes; ++k) out.colour[k] = colour.rgb[channel[k]];
    return;
  }
  // Between the eight colours of the grid that are next to it; beyond 1, in proportion.
  double const most = std::max({1.0, colour.rgb.x, colour.rgb.y, colour.rgb.z});
  int low[3];
  double share[3];
  for (int axis = 0; axis < 3; ++axis) {
    double const at = std::max(0.0, colour.rgb[axis] / most) * (side - 1);
    low[axis] = std::min(static_cast<int>(at), side - 2);
    share[axis] = at - low[axis];
  }
  for (int k = 0; k < lanes; ++k) {
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
      double weight = 1;
      int place = 0;
      for (int axis = 0; axis < 3; ++axis) {
        int const up = corner >> axis & 1;
        weight *= up != 0 ? share[axis] : 1 - share[axis];
        place = place * side + low[axis] + up;
      }
      sum +=
          weight
          * textures.colour_grid[static_cast<std::size_t>(place * textures.channels) + channel[k]];
    }
    out.colour[k] = most * sum;
  }
}

/// All entries at once, by their weights.
template <int Lanes>
static void average(Textures const& textures, CompiledPattern const& map, PigmentSpot const& inner,
                    std::uint16_t const* channel, int lanes, PigmentValue& out, Arena& arena) {
  Arena::Scope const scope(arena);
  PigmentValue other{arena.take<double>(static_cast<std::size_t>(lanes))};
  double sum = 0;
  for (std::size_t i = 0; i < map.entries.size(); ++i) {
    PigmentValue& own = i == 0 ? out : other;
    evaluate_pigment<Lanes>(textures, map.entries[i], inner, channel, lanes, own, arena);
    sum += map.values[i];
    // The mean of those so far and this one.
    if (i > 0 && sum != 0) blend(out, other, map.values[i] / sum, Lanes > 0 ? Lanes : lanes);
  }
}

template <int Lanes>
void evaluate_pigment(Textures const& textures, int pigment, PigmentSpot const& spot,
                      std::uint16_t const* channel, int lanes, PigmentValue& out, Arena& arena) {
  CompiledPigment const& p = textures.pigments[static_cast<std::size_t>(pigment)];
  if (p.pattern < 0) return plain_pigment<Lanes>(textures, p, channel, lanes, out);
  CompiledPattern const& map = textures.patterns[static_cast<std::size_t>(p.pattern)];
  // The entries see the point after the parent's own warps and transforms.
  PigmentSpot const inner{map.pattern->place(spot.point, spot.sight), spot.sight};
  if (map.pattern->pattern->has_colours())
    return own_colour(textures, map.pattern->pattern->colour_at(inner.point), channel,
                      Lanes > 0 ? Lanes : lanes, out);
  if (map.pattern->pattern->averages())
    return average<Lanes>(textures, map, inner, channel, lanes, out, arena);
  // The items of a list stand at 0, 1 ..: a written frequency or wave blends them, as in POV-Ray.
  texture::MapPosition const position =
      texture::look_up(map.values, map.pattern->value(inner.point, inner.sight));
  auto const entry = [&](int i) { return map.entries[static_cast<std::size_t>(i)]; };
  evaluate_pigment<Lanes>(textures, entry(position.first), inner, channel, lanes, out, arena);
  if (position.weight == 0) return;
  Arena::Scope const scope(arena);
  PigmentValue other{arena.take<double>(static_cast<std::size_t>(lanes))};
  evaluate_pigment<Lanes>(textures, entry(position.second), inner, channel, lanes, other, arena);
  blend(out, other, position.weight, Lanes > 0 ? Lanes : lanes);
}

template void evaluate_pigment<0>(Textures const&, int, PigmentSpot const&, std::uint16_t const*,
                                  int, PigmentValue&, Arena&);
template void evaluate_pigment<1>(Textures const&, int, PigmentSpot const&, std::uint16_t const*,
                                  int, PigmentValue&, Arena&);
template void evaluate_pigment<3>(Textures const&, int, PigmentSpot const&, std::uint16_t const*,
                                  int, PigmentValue&, Arena&);

} // namespace abbe::surface
