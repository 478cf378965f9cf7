// SPDX-License-Identifier: MIT
#include "lang/attach.hpp"

#include <algorithm>
#include <utility>

namespace abbe::lang {

namespace {

bool patterned(scene::Layers const& layers) {
  return std::ranges::any_of(layers,
                             [](scene::Texture const& layer) { return layer.map != nullptr; });
}

void push_layers(Reader& in, Span at, scene::SharedLayers& onto,
                 scene::SharedLayers const& layers) {
  if (!onto)
    onto = layers;
  else if (patterned(*std::as_const(onto)) || patterned(*layers))
    in.report(Severity::Error, "E0252",
              "a texture with a pattern can be no layer over or under others", at);
  else
    onto->insert(onto->end(), layers->begin(), layers->end());
}

scene::SharedLayers read_layers(Reader& in) {
  scene::SharedLayers layers = read_texture(in);
  in.close();
  return layers;
}

/// `pigment {}`, `normal {}` or `finish {}` outside a texture block.
bool read_loose_part(Reader& in, scene::SharedLayers& texture) {
  std::string_view const word = in.next_word();
  if (in.next() != Next::Block || (word != "pigment" && word != "finish" && word != "normal"))
    return false;
  if (!texture) {
    texture = scene::Layers(1, default_texture(in, in.next_span()));
    texture->front().span = in.next_span();
  }
  return read_texture_part(in, texture->back());
}

void attach_material(Reader& in, MaterialValue const& material, Surface const& surface) {
  Span const at = in.block_span();
  if (material.texture) push_layers(in, at, surface.texture, material.texture);
  if (material.interior_texture)
    push_layers(in, at, surface.interior_texture, material.interior_texture);
  if (material.interior) surface.interior = material.interior;
}

} // namespace

bool read_surface(Reader& in, Surface const& surface) {
  Span const at = in.next_span();
  if (in.open("texture")) {
    push_layers(in, at, surface.texture, read_layers(in));
  } else if (read_loose_part(in, surface.texture)) {
    return true;
  } else if (in.open("interior_texture")) {
    push_layers(in, at, surface.interior_texture, read_layers(in));
  } else if (in.open("interior")) {
    auto interior = std::make_shared<scene::Interior>();
    read_interior(in, *interior);
    in.close();
    surface.interior = std::move(interior);
  } else if (in.open("material")) {
    attach_material(in, read_material(in), surface);
    in.close();
  } else {
    return false;
  }
  return true;
}

MaterialValue read_material(Reader& in) {
  MaterialValue material;
  Surface const surface{material.texture, material.interior_texture, material.interior};
  while (!in.at_end()) {
    geometry::Transform transform;
    if (read_surface(in, surface)) continue;
    if (auto named = in.accept_value<MaterialValue>()) {
      material = *named;
    } else if (read_transform(in, transform)) {
      if (material.texture) transform_layers(*material.texture, transform);
      if (material.interior_texture) transform_layers(*material.interior_texture, transform);
    } else {
      reject(in, "a material item");
    }
  }
  return material;
}

} // namespace abbe::lang
