// SPDX-License-Identifier: MIT
#pragma once

#include "base/result.hpp"
#include "lang/instances.hpp"
#include "lang/reader.hpp"
#include "optics/data_library.hpp"

#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace abbe::optics {
class Bands;
}

/// Readers of blocks: what the words of the language mean. Each takes the content of an opened
/// block up to its end; the caller opens and closes it.
namespace abbe::lang {

class Fonts;

/// A `#default` texture's parts and the scene that grows: what all block readers share.
struct SceneState {
  scene::Scene scene;
  scene::Texture default_texture; ///< to be read through default_texture()
  scene::Camera default_camera;
  Few<Diagnostic> deferred_of_texture, deferred_of_camera; ///< what of these is not supported yet
  int defaults_read = 0;                                   ///< `#default`s so far
  Instances instances;                                     ///< what is stored once
  PlainTextures plain_textures;
  double effective_version = 3.62;
  int default_noise_generator = 2;
  int number_of_waves = 10; ///< sources of ripples and waves
  bool gamma_given = false; ///< a second assumed_gamma is ignored
  /// What the scene calls for and is not rendered yet, by message: see not_rendered.hpp.
  std::map<std::string, Diagnostic> not_rendered;
  int cameras = 0; ///< seen at the top level, for the warning about a second one
  /// Glasses of AGF files (`glass_catalog`), in the order read.
  std::vector<std::shared_ptr<optics::Glass const>> file_glasses;
  /// Glasses that a file names and that could not be made, with the reason.
  struct LostGlass {
    std::string maker, name, reason;
  };
  std::vector<LostGlass> lost_glasses;
  /// Entries of the catalogue that were named, so that each is parsed once.
  std::map<std::string, std::shared_ptr<optics::Glass const>, std::less<>> named_glasses;
  std::optional<optics::DataLibrary> glass_library, spectra_library; ///< once something is named
  std::shared_ptr<Fonts> fonts;                                      ///< once a text names one
};

// ------------------------------------------------- what block readers ask of the interpreter
// (implemented with the interpreter)

SceneState& scene_state(Interpreter&);
std::filesystem::path const& stdlib_dir(Interpreter&);
/// The text of a file named in the scene, found as #include finds it. @error E05xx
Result<std::string> load_file(Interpreter&, std::string_view path_as_written);
/// Parses `text` (which the interpreter keeps under `name` for messages) and lets `read` take its
/// items: for entries of catalogues.
void read_text(Interpreter&, std::string name, std::string text,
               std::function<void(Reader&)> const& read);

// --------------------------------------------------- what the interpreter asks of this folder

/// A kind of block that may stand at the top level or be declared; one line each in
/// block_table.cpp.
struct BlockKind {
  std::string_view head;
  /// Reads the opened block's content into a value (for #declare, macro arguments, operands).
  Value (*read)(Reader&, std::string_view head);
  /// Puts the value into the scene when the block stands at the top level; null: not allowed there.
  void (*place)(Value&&, Reader&);
};
/// Ordered by head.
std::span<BlockKind const> block_kinds();
BlockKind const* find_block_kind(std::string_view head);

/// Reads one statement of the top level: a block that is placed into the scene, the name of an
/// object, `glass_catalog "file"`, `max_trace_level n`; reports anything else. Directives never get
/// here.
void read_statement(Reader&);
// default.cpp
/// The content of `#default { ... }`.
void read_default(Reader&);
/// What `#default` says, for a use at `at`.
scene::Texture const& default_texture(Reader&, Span at);
scene::Camera const& default_camera(Reader&, Span at);
/// Once, after the last statement: moves what was found into Scene::settings and checks what can
/// only be checked now (every glass against the range of bands, E0412).
void finish_scene(Reader&);

// ------------------------------------------------------------------------------ block readers

// object.cpp, csg.cpp, object_modifier.cpp
scene::Object read_object(Reader&, std::string_view head);
bool is_object_head(std::string_view head);
/// An object where one is next (a block, or the name of an object), else nullopt and nothing taken.
std::optional<scene::Object> accept_object(Reader&);
/// Takes one object modifier (translate, texture, hollow ...) when one is next.
bool read_object_modifier(Reader&, scene::Object&);
/// Height fields in what becomes part of a combination: what is below their box counts, too.
void deepen(scene::Object&);
/// Applies a transform to an object with all that is attached to it so far.
void transform_object(scene::Object&, geometry::Transform const&);
/// transform_object() of an object that nothing is given to any more: layers that look alike
/// everywhere stay where they are, and stay shared.
void transform_settled(scene::Object&, geometry::Transform const&);
/// Inserts a copy of the object into the scene: see scene::Object for what that settles.
void place_object(scene::Object, Reader&);
// transform.cpp
/// Takes translate, rotate, scale, matrix, transform when one is next and appends it.
bool read_transform(Reader&, geometry::Transform&);
/// Products of factors that are fine one by one can leave the range of numbers, or vanish: reported
/// at the span, and taken as no transformation.
void check_range(Reader&, geometry::Transform&, Span);
/// The content of `transform { ... }`.
geometry::Transform read_transform_block(Reader&);
// colour.cpp
/// A colour in a slot that can only be one: color/rgb.../red..., identifiers, bare numbers,
/// spectrum.
scene::Colour read_colour(Reader&, std::string_view name);
/// The same where only rgb counts: filter and transmit are dropped.
scene::Colour read_rgb(Reader&, std::string_view name);
/// A colour where a bare vector is not allowed: nullopt when no colour word or name is next.
/// A number that is no colour is reported and read as one.
std::optional<scene::Colour> accept_colour(Reader&);
/// Is a colour next (a colour word, a number, a spectrum or its name)?
bool starts_colour(Reader&);
/// The `filter e`, `red e` ... that may follow the start of a colour.
scene::Colour read_colour_parts(Reader&, scene::Colour start);
// pigment.cpp, color_map.cpp, finish.cpp, texture.cpp, material.cpp
void read_pigment(Reader&, scene::Pigment&);
void transform_pigment(scene::Pigment&, geometry::Transform const&);
/// What pigments, and densities, which are read alike, call themselves and their maps.
struct PigmentWords {
  std::string_view block = "pigment", map = "pigment_map";
};
/// An entry of such a map, or an item of a list.
std::shared_ptr<scene::Pigment const> read_pigment_item(Reader&, PigmentWords const&);
/// Reads on in a pigment that stands in a texture. A plain colour was moved by `moved`, which shows
/// when it is given a pattern.
void read_pigment_of_texture(Reader&, scene::Pigment&, geometry::Transform const& moved,
                             PigmentWords const& = {});
/// `color_map`, `pigment_map` (the opened block's content).
std::vector<scene::Pigment::Entry> read_color_map(Reader&);
std::vector<scene::Pigment::Entry> read_pigment_map(Reader&, PigmentWords const& = {});
/// normal.cpp. @param moved what a block without a pattern was moved by, for one that it gets
void read_normal(Reader&, scene::Normal&, geometry::Transform const& moved);
void transform_normal(std::shared_ptr<scene::Normal const>&, geometry::Transform const&);
std::vector<scene::Normal::Entry> read_normal_map(Reader&);
std::vector<scene::Normal::Slope> read_slope_map(Reader&);
/// texture_map.cpp
std::vector<scene::TextureMap::Entry> read_texture_map(Reader&);
void read_finish(Reader&, scene::Finish&);
/// A bare name shares what it stands for.
scene::SharedLayers read_texture(Reader&);
MaterialValue read_material(Reader&);
// interior.cpp, dispersion.cpp, spectrum.cpp, glass.cpp
void read_interior(Reader&, scene::Interior&);
scene::DispersionMode read_dispersion_mode(Reader&);
std::shared_ptr<optics::Spectrum const> read_spectrum(Reader&);
std::shared_ptr<optics::Glass const> read_glass(Reader&);
/// `"N-BK7"`, `"SCHOTT/N-BK7"`: out of the AGF files read and the catalogue. Reports unknown names
/// (E0410, with the nearest) and ambiguous ones (E0411, with the makers) and returns null.
std::shared_ptr<optics::Glass const> named_glass(Reader&, std::string const& name, Span);
/// When a name of the catalogue without quotes is next (`N-BK7`): reports and skips it.
bool reject_unquoted_glass(Reader&);
/// What follows `glass_catalog`: reads an AGF file and makes its glasses nameable.
void read_glass_catalog(Reader&);
// light.cpp, camera.cpp, settings.cpp, sky.cpp
scene::Light read_light(Reader&);
/// Puts a light into the scene, and what it looks like.
void place_light(scene::Light, Reader&);
/// air.cpp
scene::Fog read_fog(Reader&);
scene::Rainbow read_rainbow(Reader&);
void transform_light(scene::Light&, geometry::Transform const&);
scene::Camera read_camera(Reader&);
void read_global_settings(Reader&, scene::Settings&);
/// effects.cpp: the content of `effects { ... }`.
void read_effects(Reader&, scene::EffectSettings&);
/// The bands that a `spectral` block asks for. @error E0416
Result<optics::Bands> make_bands(scene::SpectralSettings const&);
scene::SkySphere read_sky_sphere(Reader&);

// unsupported.cpp
/// When the next word is one of POV-Ray's that abbe does not support yet (unsupported.def): reports
/// E0901 there, skips it with what belongs to it, and returns true.
bool skip_unsupported(Reader&);
/// Ends a block reader's loop round: skip_unsupported, or else Reader::unexpected.
void reject(Reader&, std::string_view where);

} // namespace abbe::lang
