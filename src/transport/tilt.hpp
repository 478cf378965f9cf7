// SPDX-License-Identifier: MIT
#pragma once

#include "transport/chunk.hpp"
#include "transport/stage.hpp"

namespace abbe::transport {

/// A surface as a layer with a normal of its own has it, a value a ray.
struct LayerFace {
  Vectors normal;
  Values cos_i;
  Vectors mirrored;
};

/// The part of a ray's surface that is shaded: its layers, where they are asked for, and which of
/// the surfaces that it is on.
struct LayerSpot {
  surface::SeenLayers::Part const* part = nullptr;     ///< null: the surface's own space
  geometry::SurfaceCrossing const* crossing = nullptr; ///< null: what the ray hit
};

/// Does any layer that the surface shows have a normal of its own?
bool tilts(Stage const& stage, geometry::PrimitiveId primitive);
/// Tilts the normals of a chunk as the layers on top have them, which is what bends and mirrors
/// light. The normals of the surfaces are kept beside them. @pre face_rays() has been called
void tilt_top(Stage const& stage, Arena& arena, Chunk& chunk);
/// The face that a ray's layer gives it, where that is not the chunk's.
/// @param layer its number
void face_layer(Stage const& stage, Chunk const& chunk, std::size_t r, int layer,
                LayerSpot const& spot, LayerFace& out);
/// What a reader of surfaces is told of a ray that met one.
surface::Reader::Meeting meeting_of(Stage const& stage, Chunk const& chunk, std::size_t r,
                                    LayerSpot const& spot = {});
/// The same before any normal is tilted: what chooses among textures sees that (slope, aoi).
surface::Reader::Meeting straight_meeting_of(Stage const& stage, Chunk const& chunk, std::size_t r,
                                             LayerSpot const& spot = {});

/// Tilts rays of the camera by its own normal. @param each rays of a point, which follow each other
/// @pre Stage::camera_normal
void tilt_camera_rays(Stage const& stage, PicturePoints const& points, std::size_t each,
                      Rays& rays);

} // namespace abbe::transport
