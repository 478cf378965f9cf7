// SPDX-License-Identifier: MIT
#include "texture/patterns/agate.hpp"
#include "texture/patterns/average.hpp"
#include "texture/patterns/bozo.hpp"
#include "texture/patterns/brick.hpp"
#include "texture/patterns/cells.hpp"
#include "texture/patterns/checker.hpp"
#include "texture/patterns/crackle.hpp"
#include "texture/patterns/dents.hpp"
#include "texture/patterns/distance.hpp"
#include "texture/patterns/fractals.hpp"
#include "texture/patterns/gradient.hpp"
#include "texture/patterns/granite.hpp"
#include "texture/patterns/leopard.hpp"
#include "texture/patterns/marble.hpp"
#include "texture/patterns/quilted.hpp"
#include "texture/patterns/radial.hpp"
#include "texture/patterns/ripples.hpp"
#include "texture/patterns/slope.hpp"
#include "texture/patterns/spiral.hpp"
#include "texture/patterns/tiling.hpp"
#include "texture/patterns/tilings.hpp"
#include "texture/patterns/wood.hpp"
#include "texture/patterns/wrinkles.hpp"

namespace abbe::texture {

std::span<PatternKind const> pattern_kinds() {
  // clang-format off
  static constexpr PatternKind kinds[] = {
      {"agate", read_agate},
      {"aoi", read_aoi},
      {"average", read_average},
      {"boxed", read_boxed},
      {"bozo", read_bozo},
      {"brick", read_brick},
      {"bumps", read_bumps},
      {"cells", read_cells},
      {"checker", read_checker},
      {"crackle", read_crackle},
      {"cubic", read_cubic},
      {"cylindrical", read_cylindrical},
      {"dents", read_dents},
      {"facets", read_facets},
      {"gradient", read_gradient},
      {"granite", read_granite},
      {"hexagon", read_hexagon},
      {"julia", read_julia},
      {"leopard", read_leopard},
      {"magnet", read_magnet},
      {"mandel", read_mandel},
      {"marble", read_marble},
      {"onion", read_onion},
      {"planar", read_planar},
      {"quilted", read_quilted},
      {"radial", read_radial},
      {"ripples", read_ripples},
      {"slope", read_slope},
      {"spherical", read_spherical},
      {"spiral1", read_spiral1},
      {"spiral2", read_spiral2},
      {"spotted", read_spotted},
      {"square", read_square},
      {"tiling", read_tiling},
      {"triangular", read_triangular},
      {"waves", read_waves},
      {"wood", read_wood},
      {"wrinkles", read_wrinkles},
  };
  // clang-format on
  return kinds;
}

} // namespace abbe::texture
