// SPDX-License-Identifier: MIT
#pragma once

#include "lang/blocks.hpp"

/// Textures, interiors and transforms as they are attached to objects.
namespace abbe::lang {

/// Do the layers look alike everywhere? Such have no place, and objects share them wherever they
/// stand.
bool is_plain(scene::SharedLayers const&);
void transform_layers(scene::Layers&, geometry::Transform const&);
/// Gives a layer another pigment, which stays where it is if the layer was moved before.
void set_pigment(scene::Texture& layer, scene::Pigment pigment);
/// Takes `pigment {}` or `finish {}`, which change what the layer has, when one is next.
bool read_texture_part(Reader&, scene::Texture& layer);

/// What an object or a material has on its surface and inside.
struct Surface {
  scene::SharedLayers& texture;
  scene::SharedLayers& interior_texture;
  std::shared_ptr<scene::Interior const>& interior;
};
/// Takes `texture`, `pigment`, `finish`, `interior_texture`, `interior` or `material` when one is
/// next and attaches it: a texture as a new top layer, a pigment or finish to the top layer (a copy
/// of the default when there is none).
bool read_surface(Reader&, Surface const&);

} // namespace abbe::lang
