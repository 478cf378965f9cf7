// SPDX-License-Identifier: MIT
#include "texture/patterns/average.hpp"

namespace abbe::texture {
namespace {

class Average final : public Pattern {
public:
  double raw(Vec3 const&, PatternModifiers const&) const override { return 0; }
  bool averages() const override { return true; }
};

} // namespace

std::shared_ptr<Pattern const> read_average(Parameters&) {
  return std::make_shared<Average>();
}

} // namespace abbe::texture
