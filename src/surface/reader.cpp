// SPDX-License-Identifier: MIT
#include "surface/reader.hpp"

#include "simd/math.hpp"
#include "surface/normal.hpp"
#include "surface/pigment.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::surface {

using geometry::HitGroup, geometry::Side, geometry::SurfaceCrossing;
using Part = SeenLayers::Part;

std::optional<std::span<int const>> Reader::same(SurfaceCrossing const& crossing) const {
  Surface const surface = textures_.surfaces[crossing.primitive];
  if (surface.mapped) return std::nullopt;
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

Vec2 Reader::uv(geometry::PrimitiveId primitive, std::uint32_t face, Vec3 const& point) const {
  return world_.uv(primitive, face, point);
}

Vec3 Reader::facing(SurfaceCrossing const& crossing, Vec3 const& point,
                    Vec3 const& direction) const {
  if (!textures_.sees) return Vec3(0);
  Vec3 const normal = glm::normalize(world_.facing(crossing.primitive, crossing.face, point));
  return glm::dot(normal, direction) > 0 ? -normal : normal;
}

bool Reader::from_inside(Meeting const& meeting) const {
  auto const& [crossing, inverse, point, sight] = meeting;
  if (world_.shape(crossing.primitive).side() == Side::Crossing) return !crossing.entering;
  bool const along =
      glm::dot(sight.direction, world_.facing(crossing.primitive, crossing.face, point)) > 0;
  return along != inverse;
}

void Reader::resolve(Part const& part, Meeting const& meeting, std::vector<Part>& out) const {
  CompiledLayer const* const layer =
      part.layers.empty() ? nullptr : &textures_.layers[static_cast<std::size_t>(part.layers[0])];
  if (layer == nullptr || layer->map < 0) {
    out.push_back(part);
    return;
  }
  CompiledTextureMap const& map = textures_.maps[static_cast<std::size_t>(layer->map)];
  texture::Sight sight = meeting.sight;
  if (layer->uv || map.pattern->uv)
    sight.uv = uv(meeting.crossing.primitive, meeting.crossing.face, meeting.point);
  Vec3 const from = layer->uv ? Vec3(sight.uv, 0.0) : part.placed ? part.point : meeting.point;
  Vec3 const placed = map.pattern->place(textures_.to_texture(*layer, from), &sight);
  auto const add = [&](std::size_t entry, double share) {
    if (share != 0)
      resolve({map.entries[entry], part.share * share, true, placed, map.linear * part.linear},
              meeting, out);
  };
  if (map.pattern->pattern->averages()) {
    double sum = 0;
    for (double const weight : map.values) sum += weight;
    for (std::size_t i = 0; i < map.values.size(); ++i) add(i, map.values[i] / sum);
    return;
  }
  auto const at = texture::look_up(map.values, map.pattern->value(placed, &sight));
  add(static_cast<std::size_t>(at.first), 1 - at.weight);
  add(static_cast<std::size_t>(at.second), at.weight);
}

SeenLayers Reader::at(Meeting const& meeting, Arena& arena) const {
  SurfaceCrossing const& crossing = meeting.crossing;
  Surface const surface = textures_.surfaces[crossing.primitive];
  std::vector<Part> parts;
  auto const of_face = [&](int number) -> std::span<int const> {
    if (number < 0) return surface.layers;
    return surface.face_layers[static_cast<std::size_t>(number)];
  };
  auto const add = [&](std::span<int const> layers, double share) {
    resolve({layers, share}, meeting, parts);
  };
  if (!surface.interior_layers.empty() && from_inside(meeting)) {
    add(surface.interior_layers, 1);
  } else if (surface.face_layers.empty()) {
    add(surface.layers, 1);
  } else if (auto const blend =
                 world_.face_blend(crossing.primitive, crossing.face, meeting.point)) {
    for (std::size_t i = 0; i < blend->count; ++i) add(of_face(blend->texture[i]), blend->share[i]);
  } else {
    add(of_face(world_.shape(crossing.primitive).face_texture(crossing.face)), 1);
  }
  auto* const kept = arena.take<Part>(parts.size());
  std::copy(parts.begin(), parts.end(), kept);
  return {{kept, parts.size()}};
}

void Reader::tint_by(Part const& part, Meeting const& meeting, double focus, Passing const& light,
                     Arena& arena) const {
  Arena::Scope const scope(arena);
  auto const& [channel, lanes, left] = light;
  PigmentValue pigment{arena.take<double>(static_cast<std::size_t>(lanes))};
  SurfaceCrossing const& crossing = meeting.crossing;
  Vec3 outward(0);
  if (focus != 0) {
    outward = glm::normalize(world_.facing(crossing.primitive, crossing.face, meeting.point));
    if (glm::dot(outward, meeting.sight.direction) > 0) outward = -outward;
  }
  // POV-Ray's imitation of light that curved glass gathers; each layer gathers it once more.
  auto const gather = [&](Vec3 const& normal) {
    double const more =
        1 + simd::pow(std::abs(glm::dot(normal, meeting.sight.direction)), 45 * focus);
    for (int k = 0; k < lanes; ++k) left[k] *= more;
  };
  for (int const number : part.layers) {
    CompiledLayer const& layer = textures_.layers[static_cast<std::size_t>(number)];
    texture::Sight sight = meeting.sight;
    if (textures_.uses_uv)
      sight.uv = uv(meeting.crossing.primitive, meeting.crossing.face, meeting.point);
    PigmentSpot const spot =
        spot_of(textures_, layer, part.placed ? part.point : meeting.point, sight);
    if (lanes == 1)
      evaluate_pigment<1>(textures_, layer.pigment, spot, channel, lanes, pigment, arena);
    else if (lanes == 3)
      evaluate_pigment<3>(textures_, layer.pigment, spot, channel, lanes, pigment, arena);
    else
      evaluate_pigment<0>(textures_, layer.pigment, spot, channel, lanes, pigment, arena);
    for (int k = 0; k < lanes; ++k)
      left[k] *= pigment.filter * pigment.colour[k] + pigment.transmit;
    if (focus != 0)
      gather(layer.normal >= 0 ? tilted_normal(textures_, layer.normal, spot.point, outward, sight)
                               : outward);
  }
  if (focus != 0 && part.layers.empty()) gather(outward);
}

void Reader::tint(Meeting const& meeting, double caustics, Passing const& light,
                  Arena& arena) const {
  SurfaceCrossing const& crossing = meeting.crossing;
  if (auto const layers = same(crossing))
    return tint_by({*layers}, meeting, caustics, light, arena);
  Arena::Scope const scope(arena);
  SeenLayers const seen = at(meeting, arena);
  if (seen.parts.size() == 1) return tint_by(seen.parts[0], meeting, caustics, light, arena);
  auto const lanes = static_cast<std::size_t>(light.lanes);
  auto* const sum = arena.take<double>(lanes);
  auto* const part = arena.take<double>(lanes);
  std::fill_n(sum, lanes, 0.0);
  for (Part const& own : seen.parts) {
    for (std::size_t k = 0; k < lanes; ++k) part[k] = light.left[k] * own.share;
    Passing of_part = light;
    of_part.left = part;
    tint_by(own, meeting, caustics, of_part, arena);
    for (std::size_t k = 0; k < lanes; ++k) sum[k] += part[k];
  }
  std::copy_n(sum, lanes, light.left);
}

} // namespace abbe::surface
