// SPDX-License-Identifier: MIT
#include "texture/patterns/quilted.hpp"

#include <cmath>

namespace abbe::texture {
namespace {

class Quilted final : public Pattern {
public:
  double raw(Vec3 const& p, PatternModifiers const&) const override {
    Vec3 const q = from_middle(p);
    return padding(q) * (std::abs(q.x) + std::abs(q.y) + std::abs(q.z)) / 3;
  }
  bool tilt(Vec3 const& p, PatternModifiers const&, double amount, Vec3& normal) const override {
    Vec3 const q = from_middle(p);
    normal += amount * padding(q) * q;
    return true;
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
  static Vec3 from_middle(Vec3 const& p) { return p - glm::floor(p) - 0.5; }
  double padding(Vec3 const& q) const {
    double const s = glm::length(q);
    double const r = 1 - s;
    return 1.154700538 * s * (s * s + 3 * s * r * control1_ + 3 * r * r * control0_);
  }

  double control0_ = 1;
  double control1_ = 1;
};

} // namespace

std::shared_ptr<Pattern const> read_quilted(Parameters&) {
  return std::make_shared<Quilted>();
}

} // namespace abbe::texture
