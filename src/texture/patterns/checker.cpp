// SPDX-License-Identifier: MIT
#include "texture/patterns/checker.hpp"

#include "texture/lattice.hpp"

namespace abbe::texture {
namespace {

class Checker final : public Pattern {
public:
  double raw(Vec3 const& p, PatternModifiers const&) const override {
    return (wrapped_floor(p.x + cell_tolerance, 1) + wrapped_floor(p.y + cell_tolerance, 1)
            + wrapped_floor(p.z + cell_tolerance, 1))
           & 1;
  }
  int list_size() const override { return 2; }
  double default_frequency() const override { return 0; }
  std::span<DefaultEntry const> default_map() const override {
    static DefaultEntry const blue_green[] = {{0, Vec3(0, 0, 1)}, {1, Vec3(0, 1, 0)}};
    return blue_green;
  }
};

} // namespace

std::shared_ptr<Pattern const> read_checker(Parameters&) {
  return std::make_shared<Checker>();
}

} // namespace abbe::texture
