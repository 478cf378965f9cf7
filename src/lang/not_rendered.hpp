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

/// `radiosity { ... }`, `photons { ... }` and `subsurface { ... }` in global_settings, which turn
/// these on. @return false: none of them is next
bool read_global_light(Reader&);
/// `photons { ... }` and `radiosity { ... }` of objects: without effect where the global ones are
/// not given, as in POV-Ray.
bool read_object_light(Reader&);
/// `photons { ... }` of a light.
bool read_light_photons(Reader&);
/// `radiosity { importance f }` of objects and of `#default`.
bool read_importance(Reader&);
/// `subsurface { ... }` of a finish: without effect unless the global one is given, as in POV-Ray.
bool read_subsurface(Reader&);

// media.cpp
/// The content of `media { ... }`.
void read_media(Reader&);
/// The content of `density { ... }`: a pigment with words of its own.
scene::Pigment read_density(Reader&);
/// The content of `density_map { ... }`.
std::vector<scene::Pigment::Entry> read_density_map(Reader&);

} // namespace abbe::lang
