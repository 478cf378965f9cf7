// SPDX-License-Identifier: MIT
#include "plan/materials.hpp"

namespace abbe::plan {

void MaterialChange::apply(scene::Scene& scene) {
  for (auto& each : scene.objects) change(each);
}

void MaterialChange::change(scene::Object& each) {
  change(each.texture);
  change(each.interior_texture);
  for (auto& layers : each.face_textures) change(layers);
  for (auto& child : each.children) change(child);
  if (each.instance) each.instance = changed(each.instance);
  if (object) object(each);
}

std::shared_ptr<scene::Object const>
MaterialChange::changed(std::shared_ptr<scene::Object const> const& instance) {
  if (auto const known = instances_.find(instance.get()); known != instances_.end())
    return known->second.after;
  scene::Object now = *instance;
  change(now);
  auto after = std::make_shared<scene::Object const>(std::move(now));
  instances_[instance.get()] = {instance, after};
  return after;
}

void MaterialChange::change(scene::SharedLayers& layers) {
  if (!layers) return;
  auto before = layers.held();
  auto const [at, fresh] = done_.try_emplace(before.get());
  if (fresh) {
    scene::Layers now = *before;
    change(now);
    at->second = {std::move(before), scene::SharedLayers(std::move(now))};
  }
  layers = at->second.after;
}

void MaterialChange::change(scene::Layers& layers) {
  for (auto& each : layers)
    if (each.map)
      each.map = changed(*each.map);
    else if (layer)
      layer(each, &each == &layers.front());
}

std::shared_ptr<scene::TextureMap const> MaterialChange::changed(scene::TextureMap const& map) {
  auto now = std::make_shared<scene::TextureMap>(map);
  for (auto& entry : now->entries) change(entry.layers);
  return now;
}

void change_pigment(scene::Pigment& pigment, std::function<void(scene::Pigment&)> const& change) {
  for (auto& entry : pigment.entries) {
    auto now = std::make_shared<scene::Pigment>(*entry.pigment);
    change_pigment(*now, change);
    entry.pigment = std::move(now);
  }
  change(pigment);
}

} // namespace abbe::plan
