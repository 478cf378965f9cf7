// SPDX-License-Identifier: MIT
#include "surface/surfaces.hpp"

#include <algorithm>
#include <utility>

namespace abbe::surface {

void Surfaces::reserve(std::size_t primitives) {
  number_.reserve(primitives);
  places_.reserve(primitives);
}

Surfaces::Origin Surfaces::origin(geometry::PrimitiveId primitive) const {
  Place const& place = places_[primitive];
  Kind const& kind = kinds_[place.kind];
  return {{kind.source, place.begin, place.end}, kind.keyword};
}

std::uint32_t Surfaces::kind_of(scene::Object const& object) {
  // The latest few: a scene has few sources and keywords, and lists of each of them.
  constexpr std::size_t looked_through = 32;
  std::size_t const oldest = kinds_.size() - std::min(kinds_.size(), looked_through);
  for (std::size_t i = kinds_.size(); i-- > oldest;)
    if (kinds_[i].source == object.span.source && kinds_[i].keyword == object.keyword)
      return static_cast<std::uint32_t>(i);
  kinds_.push_back({object.span.source, object.keyword});
  return static_cast<std::uint32_t>(kinds_.size() - 1);
}

void Surfaces::add(SurfaceLayers surface, scene::Object const& object) {
  places_.push_back({object.span.begin, object.span.end, kind_of(object)});
  bool const plain = surface.layers.size() < 2 && surface.interior_layers.empty()
                     && surface.face_layers.empty() && !surface.double_illuminate
                     && !surface.mapped;
  if (plain && !surface.layers.empty()) {
    number_.push_back(surface.layers.front());
    return;
  }
  if (plain && bare_ != 0) {
    number_.push_back(bare_);
    return;
  }
  number_.push_back(~static_cast<int>(others_.size()));
  if (plain) bare_ = number_.back();
  others_.push_back(std::move(surface));
}

} // namespace abbe::surface
