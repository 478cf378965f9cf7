// SPDX-License-Identifier: MIT
#include "texture/patterns/quilted.hpp"

#include <cmath>

namespace abbe::texture {
namespace {

class Quilted final : public Pattern {
public:
  double raw(Vec3 const& p, PatternModifiers const&) const override {
    Vec3 const q = p - glm::floor(p) - 0.5;
    double const s = glm::length(q);
    double const r = 1 - s;
    double const t = 1.154700538 * s * (s * s + 3 * s * r * control1_ + 3 * r * r * control0_);
    return t * (std::abs(q.x) + std::abs(q.y) + std::abs(q.z)) / 3;
  }
  double default_frequency() const override { return 0; }
  std::shared_ptr<Pattern const> read_item(Parameters& in) const override {
    auto changed = std::make_shared<Quilted>(*this);
    if (in.accept("control0"))
      changed->control0_ = in.number("control0");
    else if (in.accept("control1"))
      changed->control1_ = in.number("control1");
    else
      return nullptr;
    return changed;
  }

private:
  double control0_ = 1;
  double control1_ = 1;
};

} // namespace

std::shared_ptr<Pattern const> read_quilted(Parameters&) {
  return std::make_shared<Quilted>();
}

} // namespace abbe::texture
