// SPDX-License-Identifier: MIT
#include "simd/math.hpp"
#include "texture/warps/warps.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace abbe::texture {
namespace {

constexpr double pi = std::numbers::pi;

/// Share of a turn of the angle from +x towards +z, 0 .. 1.
double around(double x, double z) {
  double const turn = simd::atan2(z, x) / (2 * pi);
  return turn < 0 ? turn + 1 : turn;
}

/// Unrolls a body onto the plane of x and y, with the distance from it along z. Then it is turned
/// so that z lies along the orientation.
struct Unrolled final : Warp {
  enum class Body : std::uint8_t { Cylinder, Sphere, Torus } body = Body::Cylinder;
  int axis = 2;
  double exponent = 0, major_radius = 1;

  Vec3 apply(Vec3 const& p) const override {
    double const across = std::sqrt(p.x * p.x + p.z * p.z);
    double u = around(p.x, p.z), v = p.y, distance = across;
    if (body == Body::Sphere) {
      distance = glm::length(p);
      v = distance == 0 ? 0.5 : 0.5 + simd::asin(std::clamp(p.y / distance, -1.0, 1.0)) / pi;
    } else if (body == Body::Torus) {
      double const beyond = across - major_radius;
      distance = std::sqrt(beyond * beyond + p.y * p.y);
      v = (simd::atan2(p.y, beyond) + pi) / (2 * pi);
    }
    if (exponent != 0) {
      double const scale = exponent == 1 ? distance : simd::pow(distance, exponent);
      u *= scale;
      if (body != Body::Cylinder) v *= scale;
    }
    if (axis == 0) return {distance, v, -u};
    if (axis == 1) return {u, -distance, v};
    return {u, v, distance};
  }
};

struct Planar final : Warp {
  int axis = 2;
  double distance = 0;
  Vec3 apply(Vec3 const& p) const override {
    if (axis == 0) return {distance, p.y, -p.x};
    if (axis == 1) return {p.x, -distance, p.y};
    return {p.x, p.y, distance};
  }
};

/// The net of a cube in the unit square: four faces side by side, one above and one below.
struct Cubic final : Warp {
  Vec3 apply(Vec3 const& p) const override {
    Vec3 const size = glm::abs(p);
    double const most = std::max(size.x, std::max(size.y, size.z));
    if (most == 0) return p;
    Vec3 const q = (p / most + 1.0) / 2.0;
    constexpr double third = 1.0 / 3;
    if (size.x == most) return {p.x > 0 ? 0.75 - q.z / 4 : q.z / 4, third + q.y / 3, most};
    if (size.y == most) return {0.25 + q.x / 4, p.y > 0 ? 1 - q.z / 3 : q.z / 3, most};
    return {p.z > 0 ? 0.25 + q.x / 4 : 1 - q.x / 4, third + q.y / 3, most};
  }
};

/// The axis that an orientation lies along.
int read_axis(Parameters& in, std::string_view name) {
  Span const at = in.next_span();
  Vec3 const v = in.vec3(name);
  for (int axis = 0; axis < 3; ++axis)
    if (v[axis] != 0 && v[(axis + 1) % 3] == 0 && v[(axis + 2) % 3] == 0) return axis;
  in.report(Severity::Error, "E0385", std::string(name) + " must lie along x, y or z", at);
  return 2;
}

std::shared_ptr<Warp const> read_unrolled(Parameters& in, Unrolled::Body body) {
  auto warp = std::make_shared<Unrolled>();
  warp->body = body;
  while (!in.at_end()) {
    if (in.accept("orientation"))
      warp->axis = read_axis(in, "orientation");
    else if (in.accept("dist_exp"))
      warp->exponent = in.number("dist_exp");
    else if (body == Unrolled::Body::Torus && in.accept("major_radius"))
      warp->major_radius = in.number("major_radius");
    else
      break;
  }
  return warp;
}

} // namespace

std::shared_ptr<Warp const> read_planar_warp(Parameters& in) {
  auto warp = std::make_shared<Planar>();
  if (in.has_value()) {
    warp->axis = read_axis(in, "the direction of a planar warp");
    warp->distance = in.optional_number("distance").value_or(0);
  }
  return warp;
}
std::shared_ptr<Warp const> read_cubic_warp(Parameters&) {
  return std::make_shared<Cubic>();
}
std::shared_ptr<Warp const> read_cylindrical_warp(Parameters& in) {
  return read_unrolled(in, Unrolled::Body::Cylinder);
}
std::shared_ptr<Warp const> read_spherical_warp(Parameters& in) {
  return read_unrolled(in, Unrolled::Body::Sphere);
}
std::shared_ptr<Warp const> read_toroidal_warp(Parameters& in) {
  return read_unrolled(in, Unrolled::Body::Torus);
}

} // namespace abbe::texture
