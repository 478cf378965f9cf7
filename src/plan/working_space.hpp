// SPDX-License-Identifier: MIT
#pragma once

#include "base/vec.hpp"
#include "scene/scene.hpp"

#include <span>

namespace abbe::plan {

/// The space that the numbers of a scene's colours are in (`assumed_gamma`), as a map to linear
/// light. In r g b abbe calculates in that space, as POV-Ray does, and maps the finished picture;
/// in bands it maps the scene's colours, because light of many wavelengths can only be added up as
/// it is.
/// @source language notes, section 17: no `assumed_gamma` and a version below 3.7 means that
/// finished
///         values are display values
class WorkingSpace {
public:
  explicit WorkingSpace(scene::Settings const& settings);
  bool is_linear() const { return kind_ == Kind::Linear; }
  double to_linear(double value) const;
  /// The value as a display shows it: the sRGB code of its light, within 0 and 1.
  double shown(double value) const;
  /// Each of them.
  void to_linear(std::span<float> values) const;
  Vec3 to_linear(Vec3 const& rgb) const {
    return {to_linear(rgb.x), to_linear(rgb.y), to_linear(rgb.z)};
  }

private:
  enum class Kind { Linear, Power, Srgb } kind_ = Kind::Linear;
  double gamma_ = 1;
};

} // namespace abbe::plan
