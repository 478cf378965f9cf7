// SPDX-License-Identifier: MIT
#include "surface/reader.hpp"

#include "simd/math.hpp"
#include "surface/pigment.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::surface {

using geometry::HitGroup, geometry::Side, geometry::SurfaceCrossing;

std::optional<std::span<int const>> Reader::same(SurfaceCrossing const& crossing) const {
  Surface const surface = textures_.surfaces[crossing.primitive];
  if (!surface.interior_layers.empty()) {
    if (world_.shape(crossing.primitive).side() != Side::Crossing) return std::nullopt;
    if (!crossing.entering) return surface.interior_layers;
  }
  if (surface.face_layers.empty()) return surface.layers;
  return std::nullopt;
}

bool Reader::inverse(HitGroup const& hit, SurfaceCrossing const& crossing) {
  auto const member =
      std::find_if(hit.members.begin(), hit.members.end(), [&](auto const& candidate) {
        return candidate.primitive == crossing.primitive && candidate.face == crossing.face;
      });
  return member != hit.members.end() && member->was_entering != crossing.entering;
}

bool Reader::from_inside(SurfaceCrossing const& crossing, bool inverse, Vec3 const& point,
                         Vec3 const& direction) const {
  if (world_.shape(crossing.primitive).side() == Side::Crossing) return !crossing.entering;
  bool const along =
      glm::dot(direction, world_.facing(crossing.primitive, crossing.face, point)) > 0;
  return along != inverse;
}

SeenLayers Reader::at(SurfaceCrossing const& crossing, bool inverse, Vec3 const& point,
                      Vec3 const& direction) const {
  Surface const surface = textures_.surfaces[crossing.primitive];
  SeenLayers out;
  if (!surface.interior_layers.empty() && from_inside(crossing, inverse, point, direction)) {
    out.part[0].layers = surface.interior_layers;
    return out;
  }
  auto const of_face = [&](int number) -> std::span<int const> {
    if (number < 0) return surface.layers;
    return surface.face_layers[static_cast<std::size_t>(number)];
  };
  if (surface.face_layers.empty()) {
    out.part[0].layers = surface.layers;
  } else if (auto const blend = world_.face_blend(crossing.primitive, crossing.face, point)) {
    out.count = blend->count;
    for (std::size_t i = 0; i < blend->count; ++i)
      out.part[i] = {of_face(blend->texture[i]), blend->share[i]};
  } else {
    out.part[0].layers = of_face(world_.shape(crossing.primitive).face_texture(crossing.face));
  }
  return out;
}

void Reader::tint_by(std::span<int const> layers, double focus, Passing const& light,
                     Arena& arena) const {
  Arena::Scope const scope(arena);
  auto const& [point, direction, channel, lanes, left] = light;
  PigmentValue pigment{arena.take<double>(static_cast<std::size_t>(lanes))};
  for (int const number : layers) {
    CompiledLayer const& layer = textures_.layers[static_cast<std::size_t>(number)];
    Vec3 const inner = textures_.to_texture(layer, point);
    if (lanes == 1)
      evaluate_pigment<1>(textures_, layer.pigment, inner, channel, lanes, pigment, arena);
    else if (lanes == 3)
      evaluate_pigment<3>(textures_, layer.pigment, inner, channel, lanes, pigment, arena);
    else
      evaluate_pigment<0>(textures_, layer.pigment, inner, channel, lanes, pigment, arena);
    for (int k = 0; k < lanes; ++k)
      left[k] *= pigment.filter * pigment.colour[k] + pigment.transmit;
    for (int k = 0; focus != 1 && k < lanes; ++k) left[k] *= focus;
  }
  for (int k = 0; layers.empty() && focus != 1 && k < lanes; ++k) left[k] *= focus;
}

void Reader::tint(SurfaceCrossing const& crossing, bool inverse, double caustics,
                  Passing const& light, Arena& arena) const {
  double focus = 1;
  if (caustics != 0) {
    // POV-Ray's imitation of light that curved glass gathers; each layer gathers it once more.
    Vec3 const normal = world_.facing(crossing.primitive, crossing.face, light.point);
    focus += simd::pow(std::abs(glm::dot(normal, light.direction)), 45 * caustics);
  }
  if (auto const layers = same(crossing)) return tint_by(*layers, focus, light, arena);
  SeenLayers const seen = at(crossing, inverse, light.point, light.direction);
  if (seen.count == 1) return tint_by(seen.part[0].layers, focus, light, arena);
  Arena::Scope const scope(arena);
  auto const lanes = static_cast<std::size_t>(light.lanes);
  auto* const sum = arena.take<double>(lanes);
  auto* const part = arena.take<double>(lanes);
  std::fill_n(sum, lanes, 0.0);
  for (std::size_t i = 0; i < seen.count; ++i) {
    for (std::size_t k = 0; k < lanes; ++k) part[k] = light.left[k] * seen.part[i].share;
    Passing of_part = light;
    of_part.left = part;
    tint_by(seen.part[i].layers, focus, of_part, arena);
    for (std::size_t k = 0; k < lanes; ++k) sum[k] += part[k];
  }
  std::copy_n(sum, lanes, light.left);
}

} // namespace abbe::surface
