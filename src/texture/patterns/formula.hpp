// SPDX-License-Identifier: MIT
#pragma once

#include "texture/pattern.hpp"

namespace abbe::texture {

/// What a pattern without items of its own consists of.
struct Formula {
  double (*raw)(Vec3 const&, PatternModifiers const&);
  double default_frequency = 1;
  Wave default_wave = Wave::Ramp;
  bool uses_turbulence_itself = false;
  std::span<Pattern::DefaultEntry const> map{}; ///< empty: black to white
  /// Its way of tilting normals; null: by the gradient.
  void (*tilt)(Vec3 const&, PatternModifiers const&, double amount, Vec3& normal) = nullptr;
};

/// A pattern that is nothing but a formula of the point (and the modifiers).
class FormulaPattern final : public Pattern {
public:
  explicit FormulaPattern(Formula const& formula) : formula_(formula) {}

  double raw(Vec3 const& point, PatternModifiers const& modifiers) const override {
    return formula_.raw(point, modifiers);
  }
  bool tilt(Vec3 const& point, PatternModifiers const& modifiers, double amount,
            Vec3& normal) const override {
    if (formula_.tilt != nullptr) formula_.tilt(point, modifiers, amount, normal);
    return formula_.tilt != nullptr;
  }
  double default_frequency() const override { return formula_.default_frequency; }
  Wave default_wave() const override { return formula_.default_wave; }
  bool uses_turbulence_itself() const override { return formula_.uses_turbulence_itself; }
  std::span<DefaultEntry const> default_map() const override {
    return formula_.map.empty() ? Pattern::default_map() : formula_.map;
  }

private:
  Formula formula_;
};

inline std::shared_ptr<Pattern const> make_formula(Formula const& formula) {
  return std::make_shared<FormulaPattern>(formula);
}

} // namespace abbe::texture
