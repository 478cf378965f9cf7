// SPDX-License-Identifier: MIT
#pragma once

#include "base/diagnostic.hpp"
#include "lang/evaluate.hpp"
#include "plan/plan.hpp"
#include "render/render.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <numbers>
#include <string>
#include <utility>

/// Pictures of scenes that are written as text, for comparing single pixels with formulas.
namespace abbe::physics {

/// Of a value; pixels are floats, of 6e-8.
inline constexpr double tolerance = 2e-7;

inline double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

/// "<1, 0.5, -3>", all digits.
inline std::string text(Vec3 const& v) {
  return fmt::format("<{:.17g}, {:.17g}, {:.17g}>", v.x, v.y, v.z);
}

/// The picture of a scene that must be read without a word. It holds linear light.
/// @param spectral with its bands
inline image::Image picture(std::string const& body, int width = 1, int height = 1,
                            bool spectral = false) {
  lang::EvaluateOptions reading;
  reading.stdlib_dir = ABBE_STDLIB_DIR;
  std::string const head = "#version 3.7; global_settings { assumed_gamma 1 }\n";
  auto const evaluated = lang::evaluate_text("test.scn", head + body, reading);
  for (Diagnostic const& d : evaluated.diagnostics) ADD_FAILURE() << format(d);
  auto const plan = plan::make_plan(evaluated.scene, {});
  ABBE_ASSERT(plan);
  render::RenderOptions options;
  options.width = width;
  options.height = height;
  options.spectral_output = spectral;
  return render::render(evaluated.scene, *plan, options).image;
}

inline Vec3 pixel(image::Image const& image, int x, int y) {
  auto const at = 3 * (static_cast<std::size_t>(y) * image.width + x);
  return Vec3(image.rgb[at], image.rgb[at + 1], image.rgb[at + 2]);
}

/// Of cameras all of whose rays see the same: neighbours of each other, and yet one pixel.
inline constexpr char const* narrow = "right 1e-9*x up 1e-9*y";

/// What a narrow camera sees, alone and as one of many rays.
inline void expect_light(std::string const& body, Vec3 const& expected) {
  for (auto const& [width, height] : {std::pair(1, 1), {16, 3}}) {
    auto const image = picture(body, width, height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(pixel(image, x, y)[c], expected[c], tolerance * std::abs(expected[c]) + 1e-12)
              << "channel " << c << " of pixel " << x << ", " << y << " of\n"
              << body;
  }
}

/// A narrow camera that looks from `eye` to the origin.
inline std::string look(Vec3 const& eye) {
  return fmt::format("camera {{ location {} direction {} {} }}\n", text(eye), text(-eye), narrow);
}

/// Most scenes look at the origin of a plane z = 0 that faces -z.
inline constexpr Vec3 normal(0, 0, -1);
/// @param texture pigment, finish, textures, interior: anything that may stand in an object
inline std::string plane(std::string const& texture) {
  return fmt::format("plane {{ -z, 0 {} }}\n", texture);
}
/// Where a ray along `way` goes when the plane mirrors it.
inline Vec3 mirrored(Vec3 const& way) {
  return way - 2 * glm::dot(way, normal) * normal;
}

/// A place `distance` from the origin whose direction makes an angle with the plane's normal.
/// @param turn_deg about the normal
inline Vec3 place(double angle_deg, double turn_deg = 0, double distance = 5) {
  double const a = radians(angle_deg), t = radians(turn_deg);
  return distance * Vec3(std::sin(a) * std::cos(t), std::sin(a) * std::sin(t), -std::cos(a));
}

inline std::string lamp(Vec3 const& at, Vec3 const& colour = Vec3(1),
                        std::string const& more = "") {
  return fmt::format("light_source {{ {}, rgb {} {} }}\n", text(at), text(colour), more);
}

/// The tint of metallic surfaces, POV-Ray's imitation of Fresnel's law: colour at `cosine` of the
/// angle of incidence where `amount` is that of the metal and `colour` that of its pigment.
inline Vec3 metallic(double amount, double cosine, Vec3 const& colour) {
  double const x = std::acos(cosine) / (std::numbers::pi / 2) - 1.12;
  double const f = std::clamp(0.014567225 / (x * x) - 0.011612903, 0.0, 1.0);
  return Vec3(1) + amount * (1 - f) * (colour - Vec3(1));
}

} // namespace abbe::physics
