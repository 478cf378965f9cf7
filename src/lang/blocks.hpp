// SPDX-License-Identifier: MIT
#pragma once

#include "lang/reader.hpp"

#include <span>
#include <string_view>

/// Readers of blocks: what the words of the language mean. Each takes the content of an opened block
/// up to its end (the caller closes it).
namespace abbe::lang {

/// The current `#default` values, the scene that grows, and what the command line set.
struct SceneState {
  scene::Scene scene;
  scene::Texture default_texture;
  double effective_version = 3.62;
  int default_noise_generator = 2;
};

/// A kind of block that may stand at the top level or be declared; one line each in block_table.cpp.
struct BlockKind {
  std::string_view head;
  /// Reads the block's content into a value (for #declare, macro arguments, operands).
  Value (*read)(Reader&);
  /// Puts the value into the scene when the block stands at the top level; null: not allowed there.
  void (*place)(Value&&, Reader&);
};
std::span<BlockKind const> block_kinds();
BlockKind const* find_block_kind(std::string_view head);

// object.cpp
scene::Object read_object(Reader&, std::string_view head);
/// Takes one object modifier (translate, texture, hollow ...) when one is next.
bool read_object_modifier(Reader&, scene::Object&);
// transform.cpp
/// Takes translate, rotate, scale, matrix, transform when one is next.
bool read_transform(Reader&, geometry::Transform&);
// colour.cpp
/// A colour in a slot that can only be one: color/rgb.../red..., identifiers, bare numbers, spectrum.
scene::Colour read_colour(Reader&, std::string_view name);
/// A colour where a bare vector is not allowed: nullopt when no colour word or colour name is next.
std::optional<scene::Colour> accept_colour(Reader&);
// pigment.cpp, finish.cpp, texture.cpp, interior.cpp, spectrum.cpp, glass.cpp
void read_pigment(Reader&, scene::Pigment&);
void read_finish(Reader&, scene::Finish&);
void read_texture(Reader&, scene::Layers&);
void read_interior(Reader&, scene::Interior&);
std::shared_ptr<optics::Spectrum const> read_spectrum(Reader&);
std::shared_ptr<optics::Glass const> read_glass(Reader&);
scene::DispersionMode read_dispersion_mode(Reader&);
MaterialValue read_material(Reader&);
// light.cpp, camera.cpp, settings.cpp, sky.cpp
scene::Light read_light(Reader&);
scene::Camera read_camera(Reader&);
void read_global_settings(Reader&, scene::Settings&);
scene::SkySphere read_sky_sphere(Reader&);

} // namespace abbe::lang
