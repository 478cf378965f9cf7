// SPDX-License-Identifier: MIT
// Renders a scene that is a text into an array and draws it with letters.
//
//   find_package(abbe REQUIRED)
//   add_executable(render_to_memory render_to_memory.cpp)
//   target_link_libraries(render_to_memory PRIVATE abbe::abbe)
#include <abbe.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <string>

namespace {

char const* const scene = R"(
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 0, -5> look_at 0 right 4 * x up 2 * y }
light_source { <-5, 5, -5>, 1 parallel point_at 0 }
sphere { 0, 0.9 pigment { rgb SHADE } finish { ambient 0 diffuse 1 } }
)";

} // namespace

int main() {
  abbe::PictureOptions options;
  options.width = 64;
  options.height = 16;
  options.declarations = {{"SHADE", "0.9"}};
  abbe::Picture const picture = abbe::render_text(scene, options);
  for (auto const& message : picture.messages)
    std::fprintf(stderr, "%s:%d:%d: %s\n", message.file.c_str(), message.line, message.column,
                 message.text.c_str());
  if (!picture.ok()) return 1;
  std::string const shades = " .:-=+*#@";
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      auto const pixel = static_cast<std::size_t>(y * picture.width + x);
      float const green = std::clamp(picture.rgb[3 * pixel + 1], 0.F, 1.F);
      std::putchar(shades[static_cast<std::size_t>(green * 8)]);
    }
    std::putchar('\n');
  }
}
