// SPDX-License-Identifier: MIT
#include "lang/attach.hpp"

namespace abbe::lang {

void read_default(Reader& in) {
  SceneState& state = scene_state(in.interpreter());
  while (!in.at_end()) {
    if (in.open("texture")) {
      scene::SharedLayers const layers = read_texture(in);
      in.close();
      if (layers->size() > 1)
        in.report(Severity::Error, "E0252", "the default texture must have a single layer",
                  layers->front().span);
      else
        state.default_texture = layers->front();
    } else if (read_texture_part(in, state.default_texture)) {
      continue;
    } else if (in.open("camera")) {
      state.default_camera = read_camera(in);
      in.close();
    } else {
      reject(in, "a texture, pigment, finish or camera");
    }
  }
}

} // namespace abbe::lang
