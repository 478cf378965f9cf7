// SPDX-License-Identifier: MIT
#include "texture/patterns/agate.hpp"

#include "simd/math.hpp"

#include <cmath>
#include <numbers>

namespace abbe::texture {
namespace {

class Agate final : public Pattern {
public:
  double raw(Vec3 const& p, PatternModifiers const& modifiers) const override {
    Turbulence const t = modifiers.turbulence.value_or(Turbulence{});
    double const shake = amount_ * turbulence(p, t, modifiers.noise_generator);
    double const band = 0.5 * (simd::sin(2 * std::numbers::pi * (1.3 * shake + 1.1 * p.z)) + 1);
    return simd::pow(band, 0.77);
  }
  std::span<DefaultEntry const> default_map() const override {
    static DefaultEntry const browns[] = {{0, Vec3(1)},
                                          {0.5, Vec3(0.95, 0.75, 0.5)},
                                          {0.5, Vec3(0.9, 0.7, 0.5)},
                                          {0.6, Vec3(0.9, 0.7, 0.4)},
                                          {0.6, Vec3(1, 0.7, 0.4)},
                                          {1, Vec3(0.6, 0.3, 0)}};
    return browns;
  }
  std::shared_ptr<Pattern const> read_item(Parameters& in) const override {
    if (!in.accept("agate_turb")) return nullptr;
    auto changed = std::make_shared<Agate>(*this);
    changed->amount_ = in.number("agate turbulence");
    return changed;
  }

private:
  double amount_ = 1;
};

} // namespace

std::shared_ptr<Pattern const> read_agate(Parameters&) {
  return std::make_shared<Agate>();
}

} // namespace abbe::texture
