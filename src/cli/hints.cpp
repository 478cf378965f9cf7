// SPDX-License-Identifier: MIT
#include "cli/hints.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <set>

namespace abbe::cli {
namespace {

/// Options of POV-Ray that have a counterpart, with a value of theirs behind the letter.
std::string counterpart(std::string_view option) {
  std::string_view const value = option.substr(std::min<std::size_t>(2, option.size()));
  switch (option.size() > 1 ? option[1] : '\0') {
  case 'W':
    if (value.starts_with('T')) return fmt::format("-j {}", value.substr(1));
    return fmt::format("-W {}", value);
  case 'H':
    return fmt::format("-H {}", value);
  case 'I':
    return fmt::format("abbe render {}", value);
  case 'O':
    return fmt::format("-o {}", value);
  case 'L':
    return fmt::format("-I {}", value);
  default:
    return {};
  }
}

bool has_light(scene::Colour const& colour) {
  return colour.spectrum || colour.rgb != Vec3(0);
}

bool glows(scene::Layers const& layers, scene::Settings const& settings) {
  return std::any_of(layers.begin(), layers.end(), [&](scene::Texture const& layer) {
    return has_light(layer.finish->emission)
           || (has_light(layer.finish->ambient) && has_light(settings.ambient_light));
  });
}

/// @param seen instances that were looked at
bool glows(scene::Object const& object, scene::Settings const& settings,
           std::set<scene::Object const*>& seen) {
  auto const layers_glow = [&](scene::Layers const& layers) { return glows(layers, settings); };
  auto const object_glows = [&](scene::Object const& part) { return glows(part, settings, seen); };
  if (object.instance && seen.insert(object.instance.get()).second
      && object_glows(*object.instance))
    return true;
  return layers_glow(*object.texture) || layers_glow(*object.interior_texture)
         || std::any_of(object.face_textures.begin(), object.face_textures.end(), layers_glow)
         || std::any_of(object.clipped_by.begin(), object.clipped_by.end(), object_glows)
         || std::any_of(object.children.begin(), object.children.end(), object_glows);
}

} // namespace

std::string hint_of_command(std::string_view word) {
  if (auto const hint = hint_of_word(word); !hint.empty()) return "; " + hint;
  std::error_code failed;
  auto const extension = std::filesystem::path(word).extension();
  if (extension == ".scn" || extension == ".pov" || std::filesystem::is_regular_file(word, failed))
    return fmt::format("; to render a scene: abbe render {}", word);
  return {};
}

std::string hint_of_word(std::string_view word) {
  if (word.ends_with(".ini") || word.ends_with(".INI"))
    return fmt::format("'{}' is an ini file of POV-Ray: abbe povray {}", word, word);
  if (!word.starts_with('+') || word.size() < 2) return {};
  std::string const known = counterpart(word);
  if (known.empty()) return fmt::format("'{}' is an option of POV-Ray: abbe povray takes it", word);
  return fmt::format("'{}' is an option of POV-Ray: abbe povray takes it, here it is {}", word,
                     known);
}

std::string hint_of_scene(std::string const& path) {
  if (auto hint = hint_of_word(path); !hint.empty()) return hint;
  std::error_code failed;
  for (char const* extension : {".scn", ".pov"})
    if (std::filesystem::is_regular_file(path + extension, failed))
      return fmt::format("did you mean '{}{}'?", path, extension);
  return {};
}

std::string nothing_to_see(scene::Scene const& scene) {
  if (scene.sky_sphere || has_light(scene.background) || !scene.fogs.empty()) return {};
  if (scene.objects.empty()) return "the scene has no objects, no sky and no background";
  std::set<scene::Object const*> seen;
  bool const glow =
      std::any_of(scene.objects.begin(), scene.objects.end(),
                  [&](scene::Object const& object) { return glows(object, scene.settings, seen); });
  if (!scene.lights.empty() || glow) return {};
  return "nothing gives light: the scene has no light_source, no ambient or emission, no sky and "
         "no "
         "background";
}

} // namespace abbe::cli
