// SPDX-License-Identifier: MIT
#include "texture/warps/warps.hpp"

namespace abbe::texture {

std::span<WarpKind const> warp_kinds() {
  static constexpr WarpKind kinds[] = {
      {"black_hole", read_black_hole_warp},   {"cubic", read_cubic_warp},
      {"cylindrical", read_cylindrical_warp}, {"planar", read_planar_warp},
      {"repeat", read_repeat_warp},           {"spherical", read_spherical_warp},
      {"toroidal", read_toroidal_warp},       {"turbulence", read_turbulence_warp},
  };
  return kinds;
}

} // namespace abbe::texture
