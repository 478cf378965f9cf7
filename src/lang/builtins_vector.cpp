// SPDX-License-Identifier: MIT
#include "lang/builtins.hpp"
#include "lang/interpreter.hpp"
#include "texture/pattern.hpp"

#include <cmath>

namespace abbe::lang {
namespace {

using Arguments = std::span<Argument const>;
Vec3 v(Arguments a, std::size_t i) {
  return a[i].number.vec3();
}
double f(Arguments a, std::size_t i) {
  return a[i].number.c[0];
}

Numeric dot(CallContext&, Arguments a) {
  return scalar_of(glm::dot(v(a, 0), v(a, 1)));
}

double length(Vec3 const& p) {
  // Scaled, so that no square overflows or vanishes.
  double const most = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  if (most == 0 || !std::isfinite(most)) return most;
  if (most > 1e-100 && most < 1e100) return std::sqrt(glm::dot(p, p));
  Vec3 const q = p / most;
  return most * std::sqrt(glm::dot(q, q));
}

Numeric vector_length(CallContext&, Arguments a) {
  return scalar_of(length(v(a, 0)));
}

Numeric cross(CallContext&, Arguments a) {
  return vector_of(glm::cross(v(a, 0), v(a, 1)));
}

Numeric normalize(CallContext& context, Arguments a) {
  double const size = length(v(a, 0));
  if (size == 0) {
    context.in.warning("vnormalize of a vector of no length", context.span);
    return vector_of(Vec3(0));
  }
  return vector_of(v(a, 0) / size);
}

Numeric rotate(CallContext&, Arguments a) {
  return vector_of(geometry::Transform::rotation(v(a, 1)).point(v(a, 0)));
}

Numeric rotate_about(CallContext& context, Arguments a) {
  if (length(v(a, 1)) == 0) return context.fail("the axis has no length");
  return vector_of(geometry::Transform::rotation_about(v(a, 1), f(a, 2)).point(v(a, 0)));
}

Numeric turbulence(CallContext& context, Arguments a) {
  double const octaves = std::trunc(f(a, 2));
  if (!(octaves >= 1 && octaves <= 10)) return context.fail("octaves must lie in 1 .. 10");
  texture::Turbulence how;
  how.lambda = f(a, 0);
  how.omega = f(a, 1);
  how.octaves = static_cast<int>(octaves);
  return vector_of(texture::vector_turbulence(v(a, 3), how));
}

constexpr Builtin table[] = {
    {"vdot", "vv", false, dot},
    {"vlength", "v", false, vector_length},
    {"vcross", "vv", false, cross},
    {"vnormalize", "v", false, normalize},
    {"vrotate", "vv", false, rotate},
    {"vaxis_rotate", "vvf", false, rotate_about},
    {"vturbulence", "fffv", false, turbulence},
};

} // namespace

std::span<Builtin const> vector_builtins() {
  return table;
}

} // namespace abbe::lang
