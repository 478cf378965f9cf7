// SPDX-License-Identifier: MIT
#include "render/surfaces.hpp"

#include <utility>

namespace abbe::render {

void Surfaces::reserve(std::size_t primitives) {
  number_.reserve(primitives);
  objects_.reserve(primitives);
}

void Surfaces::add(Surface surface, scene::Object const& object) {
  objects_.push_back(&object);
  auto number = static_cast<std::uint32_t>(distinct_.size());
  bool const plain = surface.layers.size() < 2 && surface.interior_layers.empty()
                     && surface.face_layers.empty() && !surface.double_illuminate;
  if (plain) {
    auto const at = static_cast<std::size_t>(surface.layers.empty() ? 0 : surface.layers[0] + 1);
    if (at >= plain_.size()) plain_.resize(at + 1, 0);
    if (plain_[at] != 0) {
      number_.push_back(plain_[at] - 1);
      return;
    }
    plain_[at] = number + 1;
  }
  number_.push_back(number);
  distinct_.push_back(std::move(surface));
}

} // namespace abbe::render
