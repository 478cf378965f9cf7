// SPDX-License-Identifier: MIT
#pragma once

#include "scene/scene.hpp"

#include <functional>
#include <unordered_map>

namespace abbe::plan {

/// Changes the materials of a finished scene. What objects share is changed once, and stays shared.
class MaterialChange {
public:
  /// Of every plain layer, wherever it stands: in maps too. @param bottom is it the first of its
  /// texture?
  std::function<void(scene::Texture&, bool bottom)> layer;
  /// Of every object, after its materials.
  std::function<void(scene::Object&)> object;

  void apply(scene::Scene& scene);

private:
  void change(scene::Object& object);
  void change(scene::Layers& layers);
  void change(scene::SharedLayers& layers);
  std::shared_ptr<scene::Object const>
  changed(std::shared_ptr<scene::Object const> const& instance);
  std::shared_ptr<scene::TextureMap const> changed(scene::TextureMap const& map);

  /// Changed layers by what they were, which is kept so that its address stays its own.
  struct Done {
    std::shared_ptr<scene::Layers const> before;
    scene::SharedLayers after;
  };
  std::unordered_map<scene::Layers const*, Done> done_;
  struct DoneInstance {
    std::shared_ptr<scene::Object const> before, after;
  };
  std::unordered_map<scene::Object const*, DoneInstance> instances_;
};

/// Changes a pigment, after what is in its map or list.
void change_pigment(scene::Pigment& pigment, std::function<void(scene::Pigment&)> const& change);

} // namespace abbe::plan
