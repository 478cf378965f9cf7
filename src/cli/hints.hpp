// SPDX-License-Identifier: MIT
#pragma once

#include "scene/scene.hpp"

#include <string>
#include <string_view>

/// Suggests what may be meant by first attempts that cannot work.
namespace abbe::cli {

/// "; abbe render scene.scn renders it" for a word in the place of a command that names a scene or
/// is an option of POV-Ray, else "".
std::string hint_of_command(std::string_view word);

/// A line about a word of the command line that POV-Ray would understand (`+W320`, `-D`,
/// `scene.ini`) or that stands for standard input (`-`), else "".
std::string hint_of_word(std::string_view word);

/// A line about a scene file that cannot be read: hint_of_word, or the same name with an extension
/// when there is such a file; else "".
std::string hint_of_scene(std::string const& path);

/// What makes a picture of this scene empty or black: no objects, or nothing that gives light. "":
/// nothing does.
std::string nothing_to_see(scene::Scene const&);

} // namespace abbe::cli
