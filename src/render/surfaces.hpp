// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/world.hpp"
#include "scene/scene.hpp"

#include <cstdint>
#include <vector>

namespace abbe::render {

/// Everything about the surface of a primitive.
struct Surface {
  std::vector<int> layers;          ///< from the bottom to the top
  std::vector<int> interior_layers; ///< seen from inside, when the scene gives them
  std::vector<std::vector<int>> face_layers;
  bool double_illuminate = false;
  /// Nothing but the change of media: clear glass.
  bool bare() const { return layers.empty() && interior_layers.empty() && face_layers.empty(); }
};

/// The surfaces of all primitives. Those of one layer and nothing else, which is most, are one for
/// all that have that layer, and so are the bare ones.
class Surfaces {
public:
  Surface const& operator[](geometry::PrimitiveId primitive) const {
    return distinct_[number_[primitive]];
  }
  /// The object that a primitive is made from.
  scene::Object const& object(geometry::PrimitiveId primitive) const {
    return *objects_[primitive];
  }
  void reserve(std::size_t primitives);
  /// Of the next primitive. @param object must live as long as this
  void add(Surface surface, scene::Object const& object);

private:
  std::vector<Surface> distinct_;
  std::vector<std::uint32_t> number_;
  std::vector<scene::Object const*> objects_;
  /// By layer and one, 0 being none: the number of the surface that has just that, and one.
  std::vector<std::uint32_t> plain_;
};

} // namespace abbe::render
