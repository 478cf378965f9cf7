// SPDX-License-Identifier: MIT
#pragma once

#include "texture/lattice.hpp"
#include "texture/noise_tables.hpp"

namespace abbe::texture {

/// Where in the unit cube with this corner its random point lies, 0..1 each.
inline Vec3 cell_point(NoiseTables const& tables, CellRandoms const& randoms, Vec3 const& corner) {
  int const hash = tables.cell_hash(wrapped_floor(corner.x, 4095), wrapped_floor(corner.y, 4095),
                                    wrapped_floor(corner.z, 4095));
  return {randoms.value[hash], randoms.value[hash + 1], randoms.value[hash + 2]};
}

} // namespace abbe::texture
