// SPDX-License-Identifier: MIT
#include "render/definitions.hpp"

namespace abbe::render {

using geometry::Definition;

int Definitions::texture(scene::SharedLayers const& layers) {
  auto const [at, fresh] =
      numbers_.try_emplace(layers.held().get(), static_cast<int>(textures_.size()));
  if (fresh) textures_.push_back(layers);
  return at->second;
}

void Definitions::add(scene::Object const& object, std::vector<Definition::Leaf>& leaves,
                      std::vector<Definition::Part>& parts) {
  if (object.instance)
    parts.push_back({make(object.instance), object.placement});
  else if (object.shape)
    leaves.push_back({object.shape, object.placement, texture(object.texture)});
  for (scene::Object const& child : object.children) add(child, leaves, parts);
}

std::shared_ptr<Definition const>
Definitions::make(std::shared_ptr<scene::Object const> const& instance) {
  if (auto const known = known_.find(instance.get()); known != known_.end())
    return known->second.definition;
  std::vector<Definition::Leaf> leaves;
  std::vector<Definition::Part> parts;
  add(*instance, leaves, parts);
  auto made = std::make_shared<Definition const>(std::move(leaves), std::move(parts));
  known_[instance.get()] = {instance, made};
  return made;
}

Definitions::Made Definitions::of(std::shared_ptr<scene::Object const> const& instance) {
  auto definition = make(instance);
  return {std::move(definition), textures_};
}

} // namespace abbe::render
