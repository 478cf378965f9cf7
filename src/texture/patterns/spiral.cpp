// SPDX-License-Identifier: MIT
#include "texture/patterns/spiral.hpp"

#include "simd/math.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace abbe::texture {
namespace {

constexpr double pi = std::numbers::pi;

double triangle(double v) {
  double const r = v - std::floor(v);
  return r < 0.5 ? 2 * r : 2 * (1 - r);
}

/// 0 at -y, growing by way of +x.
double angle(double x, double sine) {
  double const asin = simd::asin(std::clamp(sine, -1.0, 1.0));
  return x >= 0 ? pi / 2 + asin : 3 * pi / 2 - asin;
}

class Spiral final : public Pattern {
public:
  Spiral(int arms, bool crossed) : arms_(arms), crossed_(crossed) {}

  double raw(Vec3 const& p, PatternModifiers const& modifiers) const override {
    double const rho = std::sqrt(p.x * p.x + p.y * p.y);
    double const phi = rho > 0 ? angle(p.x, p.y / rho) : 0;
    double r = p.z + rho + arms_ * phi / (2 * pi);
    if (modifiers.turbulence && modifiers.turbulence->amount.x != 0)
      r += modifiers.turbulence->amount.x
           * turbulence(p, *modifiers.turbulence, modifiers.noise_generator);
    return crossed_ ? triangle(rho) + triangle(r) : r;
  }
  Wave default_wave() const override { return Wave::Triangle; }

private:
  int arms_;
  bool crossed_;
};

std::shared_ptr<Pattern const> read_spiral(Parameters& in, bool crossed) {
  int const arms = in.integer("number of arms", std::numeric_limits<int>::min(),
                              std::numeric_limits<int>::max());
  return std::make_shared<Spiral>(arms, crossed);
}

} // namespace

std::shared_ptr<Pattern const> read_spiral1(Parameters& in) {
  return read_spiral(in, false);
}

std::shared_ptr<Pattern const> read_spiral2(Parameters& in) {
  return read_spiral(in, true);
}

} // namespace abbe::texture
