// SPDX-License-Identifier: MIT
#pragma once

#include "lang/reader.hpp"
#include "scene/scene.hpp"

#include <string_view>
#include <vector>

/// Blocks that are read whole and checked while what they ask for is not rendered yet. A scene is
/// told so once a word (E0903, Interpreter::tell_not_rendered), where it calls for it.
namespace abbe::lang {

/// The scene calls for what `word` says, which is not rendered yet.
void note_not_rendered(Reader&, std::string_view word, Span at);

/// `radiosity { ... }` and `subsurface { ... }` in global_settings, which turn these on, and
/// `photons { ... }` and `caustics { ... }` (thrown_light.cpp). @return false: none of them is next
bool read_global_light(Reader&, scene::Settings&);
/// `photons { ... }`, `caustics { ... }` and `radiosity { ... }` of objects. The first and the last
/// are without effect where the global ones are not given, as in POV-Ray.
bool read_object_light(Reader&, scene::Object&);
/// `photons { ... }` of a light.
bool read_light_photons(Reader&, scene::LampThrows&);
/// `radiosity { importance f }` of objects and of `#default`.
bool read_importance(Reader&);
/// `subsurface { ... }` of a finish: without effect unless the global one is given, as in POV-Ray.
bool read_subsurface(Reader&);

// thrown_light.cpp
/// @return false: neither `photons` nor `caustics` is next
bool read_global_thrown(Reader&, scene::Settings&);
bool read_object_thrown(Reader&, scene::Throws&);

// media.cpp
/// The content of `media { ... }`.
void read_media(Reader&);
/// The content of `density { ... }`: a pigment with words of its own.
scene::Pigment read_density(Reader&);
/// The content of `density_map { ... }`.
std::vector<scene::Pigment::Entry> read_density_map(Reader&);

} // namespace abbe::lang
