// SPDX-License-Identifier: MIT
#include "transport/tilt.hpp"

#include "surface/normal.hpp"
#include "surface/pigment.hpp"

#include <algorithm>

namespace abbe::transport {
namespace {

surface::CompiledLayer const& layer_of(Stage const& stage, int number) {
  return stage.textures.layers[static_cast<std::size_t>(number)];
}

/// The normal of the surface itself.
Vec3 untilted(Chunk const& chunk, std::size_t r) {
  return chunk.tilts ? chunk.untilted.get(r) : chunk.normal.get(r);
}

struct Tilted {
  Vec3 normal, mirrored;
  double cos_i;
};

Tilted tilted(Stage const& stage, Chunk const& chunk, std::size_t r, int number,
              LayerSpot const& spot) {
  surface::CompiledLayer const& layer = layer_of(stage, number);
  Vec3 const straight = untilted(chunk, r), d = chunk.direction.get(r);
  Vec3 n = straight;
  if (layer.normal >= 0) {
    auto meeting = meeting_of(stage, chunk, r, spot);
    meeting.sight.normal = straight;
    bool const placed = spot.part != nullptr && spot.part->placed;
    auto const at = surface::spot_of(stage.textures, layer,
                                     placed ? spot.part->point : meeting.point, meeting.sight);
    Mat3 const way = placed ? spot.part->linear : Mat3(1);
    Vec3 const inner =
        placed ? glm::normalize(glm::transpose(glm::inverse(way)) * straight) : straight;
    n = surface::tilted_normal(stage.textures, layer.normal, at.point, inner, meeting.sight);
    if (placed) n = glm::normalize(glm::transpose(way) * n);
  }
  double const along = glm::dot(d, n);
  // Where it leans away from the viewer the surface's own mirrors, as in POV-Ray.
  Vec3 m = along < 0 ? d - 2 * along * n : d - 2 * glm::dot(d, straight) * straight;
  // A tilted normal must not send it through the surface.
  Vec3 const g = chunk.geometric.get(r);
  double const below = glm::dot(m, g);
  if (below < 0) m = glm::normalize(m - 2 * below * g);
  return {n, m, std::clamp(-along, 0.0, 1.0)};
}

} // namespace

surface::Reader::Meeting meeting_of(Stage const& stage, Chunk const& chunk, std::size_t r,
                                    LayerSpot const& spot) {
  geometry::RayHit const& hit = chunk.hit[r];
  surface::Reader::Meeting out{{hit.solid, hit.primitive, hit.face, 0, hit.entering, hit.toggles},
                               hit.was_entering != hit.entering,
                               chunk.point.get(r),
                               {chunk.normal.get(r), chunk.direction.get(r), Vec2(0)}};
  if (spot.crossing != nullptr) {
    out.crossing = *spot.crossing;
    out.inverse = surface::Reader::inverse(*chunk.group, *spot.crossing);
  }
  if (stage.textures.uses_uv)
    out.sight.uv = stage.world->uv(out.crossing.primitive, out.crossing.face, out.point);
  return out;
}

surface::Reader::Meeting straight_meeting_of(Stage const& stage, Chunk const& chunk, std::size_t r,
                                             LayerSpot const& spot) {
  auto out = meeting_of(stage, chunk, r, spot);
  out.sight.normal = untilted(chunk, r);
  return out;
}

bool tilts(Stage const& stage, geometry::PrimitiveId primitive) {
  surface::Textures const& textures = stage.textures;
  surface::Surface const surface = textures.surfaces[primitive];
  auto const any = [&](auto const& self, std::span<int const> layers) -> bool {
    return std::any_of(layers.begin(), layers.end(), [&](int number) {
      surface::CompiledLayer const& layer = layer_of(stage, number);
      if (layer.map < 0) return layer.normal >= 0;
      auto const& entries = textures.maps[static_cast<std::size_t>(layer.map)].entries;
      return std::any_of(entries.begin(), entries.end(),
                         [&](auto const& entry) { return self(self, entry); });
    });
  };
  return any(any, surface.layers) || any(any, surface.interior_layers)
         || std::any_of(surface.face_layers.begin(), surface.face_layers.end(),
                        [&](auto const& face) { return any(any, face); });
}

void tilt_top(Stage const& stage, Arena& arena, Chunk& chunk) {
  surface::Reader const reader = stage.reader();
  surface::SeenLayers::Part const* part[chunk_width];
  bool any = false;
  for (std::size_t r = 0; r < chunk.count; ++r) {
    auto const parts = reader.at(meeting_of(stage, chunk, r), arena).parts;
    part[r] = &*std::max_element(parts.begin(), parts.end(),
                                 [](auto const& a, auto const& b) { return a.share < b.share; });
    int const top = part[r]->layers.empty() ? -1 : part[r]->layers.back();
    chunk.tilted[r] = top >= 0 && layer_of(stage, top).normal >= 0 ? top : -1;
    any = any || chunk.tilted[r] >= 0;
  }
  if (!any) return;
  chunk.untilted = chunk.normal;
  chunk.tilts = true;
  for (std::size_t r = 0; r < chunk.count; ++r) {
    if (chunk.tilted[r] < 0) continue;
    Tilted const own = tilted(stage, chunk, r, chunk.tilted[r], {part[r], nullptr});
    chunk.normal.set(r, own.normal);
    chunk.mirrored.set(r, own.mirrored);
    chunk.cos_i[r] = own.cos_i;
  }
  for (std::size_t r = chunk.count; r % 8 != 0; ++r) {
    chunk.normal.set(r, chunk.normal.get(chunk.count - 1));
    chunk.cos_i[r] = chunk.cos_i[chunk.count - 1];
  }
}

void face_layer(Stage const& stage, Chunk const& chunk, std::size_t r, int layer,
                LayerSpot const& spot, LayerFace& out) {
  Tilted const own = tilted(stage, chunk, r, layer, spot);
  out.normal.set(r, own.normal);
  out.mirrored.set(r, own.mirrored);
  out.cos_i[r] = own.cos_i;
}

void tilt_camera_rays(Stage const& stage, PicturePoints const& points, std::size_t each,
                      Rays& rays) {
  for (std::size_t k = 0; k < points.count; ++k) {
    Vec2 const place =
        stage.camera->place(points.x[k] / points.width - 0.5, 0.5 - points.y[k] / points.height);
    for (std::size_t i = k * each; i < (k + 1) * each; ++i) {
      Vec3 const straight = rays.direction.get(i);
      if (straight == Vec3(0)) continue; // shows nothing
      texture::Sight const sight{straight, straight, place};
      rays.direction.set(i, surface::tilted_normal(stage.textures, stage.camera_normal,
                                                   {place.x, place.y, 0}, straight, sight));
    }
  }
}

} // namespace abbe::transport
