// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/world.hpp"
#include "scene/scene.hpp"

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace abbe::surface {

/// Everything about the surface of a primitive: numbers of layers, which Surfaces keep.
struct Surface {
  std::span<int const> layers;          ///< from the bottom to the top
  std::span<int const> interior_layers; ///< seen from inside, when the scene gives them
  std::span<std::vector<int> const> face_layers;
  bool double_illuminate = false;
  bool mapped = false; ///< some texture is chosen by a pattern
  /// Nothing but the change of media: clear glass.
  bool bare() const { return layers.empty() && interior_layers.empty() && face_layers.empty(); }
};

/// What a Surface looks into.
struct SurfaceLayers {
  std::vector<int> layers, interior_layers;
  std::vector<std::vector<int>> face_layers;
  bool double_illuminate = false;
  bool mapped = false;
};

/// The surfaces of all primitives. Of those with one layer and nothing else, which is most, only
/// that layer's number is kept; the bare ones share one.
class Surfaces {
public:
  Surface operator[](geometry::PrimitiveId primitive) const {
    int const& number = number_[primitive];
    if (number >= 0) return {{&number, 1}, {}, {}, false, false};
    SurfaceLayers const& own = others_[static_cast<std::size_t>(~number)];
    return {own.layers, own.interior_layers, own.face_layers, own.double_illuminate, own.mapped};
  }
  /// Is it one layer, and nothing else?
  bool single_layer(geometry::PrimitiveId primitive) const { return number_[primitive] >= 0; }
  /// The layer's number where it is one; else below zero, and the same for the same Surface.
  int number(geometry::PrimitiveId primitive) const { return number_[primitive]; }
  /// Where the object stands that a primitive is made from, and what it was called.
  struct Origin {
    Span span;
    std::string_view keyword;
  };
  Origin origin(geometry::PrimitiveId primitive) const;
  void reserve(std::size_t primitives);
  /// Of the next primitive.
  void add(SurfaceLayers surface, scene::Object const& object);

private:
  std::vector<int> number_; ///< of the one layer; or ~ of the place in others_
  std::vector<SurfaceLayers> others_;
  int bare_ = 0; ///< number of the bare ones, once there is one
  /// Origins, kept small.
  struct Place {
    std::uint32_t begin, end;
    std::uint32_t kind; ///< in kinds_
  };
  struct Kind {
    SourceFile const* source;
    std::string_view keyword;
  };
  std::uint32_t kind_of(scene::Object const& object);
  std::vector<Place> places_;
  std::vector<Kind> kinds_;
};

} // namespace abbe::surface
