// SPDX-License-Identifier: MIT
#pragma once

#define GLM_FORCE_SILENT_WARNINGS
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace abbe {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;
using Vec4 = glm::dvec4;
using Mat3 = glm::dmat3;

/// Unit roundoff of double, 2^-53.
inline constexpr double unit_roundoff = 0x1p-53;
/// Bound for n rounding errors, n u / (1 - n u) (Higham; pbrt 6.8.1).
constexpr double gamma_bound(int n) {
  return (n * unit_roundoff) / (1 - n * unit_roundoff);
}

} // namespace abbe
