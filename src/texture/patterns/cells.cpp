// SPDX-License-Identifier: MIT
#include "texture/patterns/cells.hpp"

#include "texture/lattice.hpp"
#include "texture/noise_tables.hpp"
#include "texture/patterns/formula.hpp"

namespace abbe::texture {
namespace {

double cells(Vec3 const& p, PatternModifiers const&) {
  int const hash = noise_tables().cell_hash(wrapped_floor(p.x + cell_tolerance, 4095),
                                            wrapped_floor(p.y + cell_tolerance, 4095),
                                            wrapped_floor(p.z + cell_tolerance, 4095));
  return cell_randoms().value[hash];
}

} // namespace

std::shared_ptr<Pattern const> read_cells(Parameters&) {
  return make_formula({.raw = cells});
}

} // namespace abbe::texture
