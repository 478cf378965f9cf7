// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/shapes/instances.hpp"
#include "scene/scene.hpp"

#include <map>
#include <memory>
#include <vector>

namespace abbe::render {

/// Objects that are stored once (scene::Object::instance), made into definitions, each once.
class Definitions {
public:
  struct Made {
    std::shared_ptr<geometry::Definition const> definition;
    /// By the numbers of Definition::Leaf; all that this definition and those in it have.
    std::vector<scene::SharedLayers> textures;
  };
  /// @param instance of an object, whose textures are numbered
  Made of(std::shared_ptr<scene::Object const> const& instance);

private:
  std::shared_ptr<geometry::Definition const>
  make(std::shared_ptr<scene::Object const> const& instance);
  void add(scene::Object const& object, std::vector<geometry::Definition::Leaf>& leaves,
           std::vector<geometry::Definition::Part>& parts);
  int texture(scene::SharedLayers const& layers);

  std::vector<scene::SharedLayers> textures_; ///< of all definitions
  std::map<scene::Layers const*, int> numbers_;
  struct Known {
    std::shared_ptr<scene::Object const> of; ///< kept, so that its address stays its own
    std::shared_ptr<geometry::Definition const> definition;
  };
  std::map<scene::Object const*, Known> known_;
};

} // namespace abbe::render
