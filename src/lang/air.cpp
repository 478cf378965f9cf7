// SPDX-License-Identifier: MIT
#include "lang/blocks.hpp"

#include <fmt/format.h>

namespace abbe::lang {

namespace {

using scene::Fog, scene::Rainbow;

/// A number whose sign matters; wrong ones are reported, and `otherwise` taken.
double read_checked(Reader& in, std::string_view name, bool (*good)(double), std::string_view wants,
                    double otherwise) {
  Span const at = in.next_span();
  double const value = in.number(name);
  if (good(value)) return value;
  in.report(Severity::Error, "E0353", fmt::format("{} must {}, not {}", name, wants, value), at);
  return otherwise;
}
double read_distance(Reader& in) {
  return read_checked(
      in, "distance", [](double d) { return d >= 0; }, "not be negative", 1);
}

texture::Turbulence& eddies(Fog& fog) {
  if (!fog.turbulence) fog.turbulence.emplace();
  return *fog.turbulence;
}

bool read_fog_turbulence(Reader& in, Fog& fog) {
  texture::PatternModifiers modifiers;
  modifiers.turbulence = fog.turbulence;
  if (in.accept("turbulence")) {
    eddies(fog).amount = in.vec3("turbulence");
  } else if (in.accept("turb_depth")) {
    fog.turbulence_depth = in.number("turb_depth");
  } else if (texture::read_turbulence_item(in, modifiers)) {
    fog.turbulence = modifiers.turbulence;
  } else {
    return false;
  }
  return true;
}

void read_up(Reader& in, Vec3& up) {
  Span const at = in.next_span();
  Vec3 const read = in.vec3("up");
  double const length = glm::length(read);
  if (length > 0)
    up = read / length;
  else
    in.report(Severity::Error, "E0353", "up must have a direction, it is 0", at);
}

bool read_fog_item(Reader& in, Fog& fog) {
  geometry::Transform transform;
  if (in.accept("fog_type")) {
    fog.ground = in.integer("fog_type", 1, 2) == 2;
  } else if (in.accept("distance")) {
    fog.distance = read_distance(in);
  } else if (in.accept("fog_offset")) {
    fog.offset = in.number("fog_offset");
  } else if (in.accept("fog_alt")) {
    fog.alt = read_checked(
        in, "fog_alt", [](double alt) { return alt >= 0; }, "not be negative", 1);
  } else if (in.accept("up")) {
    read_up(in, fog.up);
  } else if (read_transform(in, transform)) {
    Vec3 const up = transform.linear * fog.up;
    fog.up = up / glm::length(up); // heights stay where they are, as in POV-Ray
  } else if (read_fog_turbulence(in, fog)) {
    return true;
  } else if (starts_colour(in)) {
    fog.colour = read_colour(in, "the fog");
  } else {
    return false;
  }
  return true;
}

bool read_rainbow_item(Reader& in, Rainbow& rainbow) {
  if (in.accept("direction")) {
    rainbow.direction = in.vec3("direction");
  } else if (in.accept("up")) {
    rainbow.up = in.vec3("up");
  } else if (in.accept("angle")) {
    rainbow.angle_deg = in.number("angle");
  } else if (in.accept("width")) {
    rainbow.width_deg = in.number("width");
  } else if (in.accept("distance")) {
    rainbow.distance = read_distance(in);
  } else if (in.accept("jitter")) {
    rainbow.jitter = in.number("jitter");
  } else if (in.accept("arc_angle")) {
    rainbow.arc_deg = read_checked(
        in, "arc_angle", [](double d) { return d > 0 && d <= 360; }, "be above 0 and at most 360",
        360);
  } else if (in.accept("falloff_angle")) {
    rainbow.falloff_deg = read_checked(
        in, "falloff_angle", [](double d) { return d >= 0 && d <= 360; }, "lie in 0 .. 360", 360);
  } else if (in.open("color_map") || in.open("colour_map")) {
    rainbow.entries.clear();
    for (auto const& entry : read_color_map(in))
      rainbow.entries.push_back({entry.value, entry.pigment->colour});
    in.close();
  } else {
    return false;
  }
  return true;
}

void check(Reader& in, Rainbow& rainbow) {
  auto const wrong = [&](std::string_view message) {
    in.report(Severity::Error, "E0353", message, rainbow.span);
    rainbow.direction = {0, 0, 1};
    rainbow.up = {0, 1, 0};
  };
  if (!(glm::length(rainbow.direction) > 0))
    wrong("a rainbow needs a direction: that of the light which it comes from");
  else if (!(glm::length(glm::cross(rainbow.direction, rainbow.up))
             > 1e-9 * glm::length(rainbow.direction) * glm::length(rainbow.up)))
    wrong("the rainbow's up and direction are one line: expected another up");
  if (rainbow.falloff_deg && rainbow.falloff_deg > rainbow.arc_deg.value_or(360))
    in.report(Severity::Error, "E0353",
              fmt::format("falloff_angle must not be above arc_angle, {}: it is {}",
                          rainbow.arc_deg.value_or(360), *rainbow.falloff_deg),
              rainbow.span);
  std::string_view const missing = rainbow.entries.empty()    ? "a color_map"
                                   : !(rainbow.width_deg > 0) ? "a width"
                                   : !(rainbow.distance > 0)  ? "a distance"
                                                              : "";
  if (!missing.empty())
    in.report(Severity::Warning, "E0257",
              fmt::format("a rainbow without {} is not to be seen", missing), rainbow.span);
}

} // namespace

scene::Fog read_fog(Reader& in) {
  Fog fog;
  for (bool first = true; !in.at_end(); first = false)
    if (auto named = in.accept_copied<Fog>(first, "fog"))
      fog = *named;
    else if (!read_fog_item(in, fog))
      reject(in, "a fog item");
  fog.span = in.block_span();
  if (fog.distance == 0)
    in.report(Severity::Warning, "E0257", "a fog without a distance is not to be seen", fog.span);
  else if (fog.ground && !(fog.alt > 0))
    in.report(Severity::Error, "E0353",
              "ground fog needs a fog_alt above 0: how far above fog_offset it has a half of its "
              "density",
              fog.span);
  return fog;
}

scene::Rainbow read_rainbow(Reader& in) {
  Rainbow rainbow;
  for (bool first = true; !in.at_end(); first = false)
    if (auto named = in.accept_copied<Rainbow>(first, "rainbow"))
      rainbow = *named;
    else if (!read_rainbow_item(in, rainbow))
      reject(in, "a rainbow item");
  rainbow.span = in.block_span();
  check(in, rainbow);
  return rainbow;
}

} // namespace abbe::lang
