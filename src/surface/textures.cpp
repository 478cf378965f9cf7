// SPDX-License-Identifier: MIT
#include "surface/textures.hpp"

#include <algorithm>

namespace abbe::surface {

bool Textures::mirrors(Surface const& surface) const {
  auto const any = [&](std::span<int const> numbers) {
    return std::any_of(numbers.begin(), numbers.end(), [&](int number) {
      return finish(layers[static_cast<std::size_t>(number)]).reflection.has_value();
    });
  };
  return any(surface.layers) || any(surface.interior_layers)
         || std::any_of(surface.face_layers.begin(), surface.face_layers.end(), any);
}

} // namespace abbe::surface
