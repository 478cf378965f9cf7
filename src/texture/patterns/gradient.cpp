// SPDX-License-Identifier: MIT
#include "texture/patterns/gradient.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::texture {
namespace {

class Gradient final : public Pattern {
public:
  explicit Gradient(Vec3 const& unit_direction) : direction_(unit_direction) {}

  double raw(Vec3 const& p, PatternModifiers const&) const override {
    double const r = glm::dot(direction_, p);
    return r > 1 ? std::fmod(r, 1.0) : r;
  }

private:
  Vec3 direction_;
};

} // namespace

std::shared_ptr<Pattern const> read_gradient(Parameters& in) {
  Span const span = in.next_span();
  Vec3 const direction = in.vec3("gradient direction");
  double const largest =
      std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
  if (!(largest > 0)) {
    in.report(Severity::Error, "E0381", "the direction of a gradient must not be the zero vector",
              span);
    return std::make_shared<Gradient>(Vec3(1, 0, 0));
  }
  return std::make_shared<Gradient>(glm::normalize(direction / largest));
}

} // namespace abbe::texture
