// SPDX-License-Identifier: MIT
#include "lang/attach.hpp"
#include "lang/interpreter.hpp"
#include "lang/not_rendered.hpp"

namespace abbe::lang {

namespace {

void read_default_texture(Reader& in, SceneState& state) {
  scene::SharedLayers const layers = read_texture(in);
  in.close();
  if (layers->size() > 1)
    in.report(Severity::Error, "E0252", "the default texture must have a single layer",
              layers->front().span);
  else
    state.default_texture = layers->front();
}

} // namespace

void read_default(Reader& in) {
  SceneState& state = scene_state(in.interpreter());
  ++state.defaults_read;
  while (!in.at_end()) {
    Deferral deferral(in.interpreter());
    if (in.open("texture")) {
      read_default_texture(in, state);
      state.deferred_of_texture = deferral.take();
    } else if (in.open("camera")) {
      state.default_camera = read_camera(in);
      in.close();
      state.deferred_of_camera = deferral.take();
    } else {
      if (!read_texture_part(in, state.default_texture) && !read_importance(in))
        reject(in, "a texture, pigment, finish or camera");
      state.deferred_of_texture.append(deferral.take());
    }
  }
}

scene::Texture const& default_texture(Reader& in, Span at) {
  SceneState const& state = scene_state(in.interpreter());
  in.interpreter().use(state.deferred_of_texture, at);
  return state.default_texture;
}

scene::Camera const& default_camera(Reader& in, Span at) {
  SceneState const& state = scene_state(in.interpreter());
  in.interpreter().use(state.deferred_of_camera, at);
  return state.default_camera;
}

} // namespace abbe::lang
