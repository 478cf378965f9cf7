// SPDX-License-Identifier: MIT
#include "lang/blocks.hpp"
#include "lang/not_rendered.hpp"
#include "lang/unsupported.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace abbe::lang {

namespace {

using scene::Light;

scene::Colour const black{Vec3(0), 0, 0, nullptr};

/// `spotlight`, `parallel` and how they combine.
bool read_kind(Reader& in, Light& light) {
  Span const at = in.next_span();
  Light::Kind kind = Light::Kind::Point;
  if (in.accept("spotlight")) {
    kind = Light::Kind::Spot;
  } else if (in.accept("parallel")) {
    kind = Light::Kind::Parallel;
  } else if (in.next_word() == "cylinder") {
    in.report(Severity::Error, "E0901", "'cylinder' in a light_source is not supported yet", at);
    skip_rest(in);
    return true;
  } else {
    return false;
  }
  if (light.kind != Light::Kind::Point && light.kind != kind)
    in.report(Severity::Error, "E0901", "'spotlight' with 'parallel' is not supported yet", at);
  light.kind = kind;
  return true;
}

bool at_area_option(Reader& in) {
  constexpr std::string_view options[] = {"adaptive", "jitter", "circular", "orient",
                                          "area_illumination"};
  return std::ranges::find(options, in.next_word()) != std::end(options);
}

/// The options of an area light are part of it: one message is enough. Without it they do nothing,
/// as in POV-Ray.
bool reject_area(Reader& in) {
  if (in.next_word() == "area_light") {
    skip_unsupported(in);
    while (at_area_option(in)) in.skip();
    return true;
  }
  if (!at_area_option(in)) return false;
  in.report(Severity::Warning, "E0257",
            fmt::format("'{}' acts on area lights only", in.next_word()), in.next_span());
  in.skip();
  return true;
}

double read_angle(Reader& in, std::string_view name) {
  Span const at = in.next_span();
  double const degrees = in.number(name);
  if (degrees >= -360 && degrees <= 360) return degrees;
  in.report(Severity::Error, "E0353",
            fmt::format("a spotlight's {} must be within 360 degrees, not {}", name, degrees), at);
  return 45;
}

/// `point_at` and the like before or without the word that gives them a meaning.
bool reject_aim(Reader& in) {
  for (std::string_view word : {"point_at", "radius", "falloff", "tightness"}) {
    Span const at = in.next_span();
    if (!in.accept(word)) continue;
    in.report(Severity::Error, "E0252",
              fmt::format("'{}' belongs behind 'spotlight'{}", word,
                          word == "point_at" ? " or 'parallel'" : ""),
              at);
    if (in.has_value()) in.vec3(word);
    return true;
  }
  return false;
}

bool read_aim(Reader& in, Light& light) {
  if (light.kind == Light::Kind::Point) return reject_aim(in);
  if (in.accept("point_at")) {
    light.point_at = in.vec3("point_at");
    return true;
  }
  if (light.kind != Light::Kind::Spot) return reject_aim(in);
  if (in.accept("radius"))
    light.radius_deg = read_angle(in, "radius");
  else if (in.accept("falloff"))
    light.falloff_deg = read_angle(in, "falloff");
  else if (in.accept("tightness"))
    light.tightness = in.number("tightness");
  else
    return false;
  return true;
}

bool read_item(Reader& in, Light& light) {
  geometry::Transform transform;
  if (read_transform(in, transform))
    transform_light(light, transform);
  else if (in.accept("shadowless"))
    light.shadowless = true;
  else if (in.accept("fade_distance"))
    light.fade_distance = in.number("fade_distance");
  else if (in.accept("fade_power"))
    light.fade_power = in.number("fade_power");
  else
    return read_light_photons(in) || reject_area(in) || read_kind(in, light) || read_aim(in, light);
  return true;
}

void check(Reader& in, Light& light) {
  if (light.fade_distance != 0 && light.fade_power < 0)
    in.report(Severity::Warning, "E0353",
              fmt::format("fade_power {} has no effect: it must be positive", light.fade_power),
              light.span);
  if (light.kind == Light::Kind::Point || light.point_at != light.position) return;
  in.report(Severity::Warning, "E0353",
            "this light points at its own place: it has no direction and gives no light",
            light.span);
  light.kind = Light::Kind::Point;
  light.colour = black;
}

} // namespace

scene::Light read_light(Reader& in) {
  Light light;
  if (auto named = in.accept_value<Light>()) {
    light = *named;
  } else {
    light.position = in.vec3("position");
    if (starts_colour(in)) {
      light.colour = read_rgb(in, "the light");
    } else {
      light.colour = black;
      in.report(
          Severity::Warning, "E0250",
          "this light has no colour and is black, as in POV-Ray: expected 'rgb 1' or the like",
          in.block_span());
    }
  }
  light.span = in.block_span();
  while (!in.at_end())
    if (!read_item(in, light)) reject(in, "a light_source item");
  check(in, light);
  return light;
}

void transform_light(Light& light, geometry::Transform const& transform) {
  light.position = transform.point(light.position);
  light.point_at = transform.point(light.point_at);
}

} // namespace abbe::lang
