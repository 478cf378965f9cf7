// SPDX-License-Identifier: MIT
#include "lang/blocks.hpp"
#include "lang/not_rendered.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace abbe::lang {

namespace {

using scene::Light;

scene::Colour const black{Vec3(0), 0, 0, nullptr};

/// A light while its block is read.
struct Draft {
  Light& light;
  bool parallel = false; ///< was `parallel` said, of any kind?
  bool spot = false;     ///< was `spotlight`?
};

/// `spotlight`, `cylinder`, `parallel`. A parallel spotlight shines everywhere, as in POV-Ray.
bool read_kind(Reader& in, Draft& draft) {
  Light& light = draft.light;
  Light::Kind kind = light.kind;
  if (in.accept("spotlight")) {
    kind = Light::Kind::Spot;
    draft.spot = true;
  } else if (in.next() == Next::Word && in.accept("cylinder")) {
    kind = Light::Kind::Cylinder;
  } else if (in.accept("parallel")) {
    draft.parallel = true;
  } else {
    return false;
  }
  light.kind = draft.parallel && kind != Light::Kind::Cylinder ? Light::Kind::Parallel : kind;
  return true;
}

int read_size(Reader& in) {
  return in.integer("number of lights", 1, 10000);
}

bool at_area_option(Reader& in) {
  constexpr std::string_view options[] = {"adaptive", "jitter", "circular", "orient",
                                          "area_illumination"};
  return std::ranges::find(options, in.next_word()) != std::end(options);
}

bool read_area_option(Reader& in, scene::AreaGrid& area) {
  Span const at = in.next_span();
  if (in.accept("adaptive")) {
    area.adaptive = in.integer("adaptive", 0, 100);
  } else if (in.accept("jitter")) {
    area.jitter = true;
  } else if (in.accept("circular")) {
    area.circular = area.size1 > 1 && area.size2 > 1;
    if (!area.circular)
      in.report(Severity::Error, "E0353",
                fmt::format("a circular area light needs two lights each way at least, it has {} "
                            "by {}",
                            area.size1, area.size2),
                at);
  } else if (in.accept("orient")) {
    area.orient = true;
  } else if (in.accept("area_illumination")) {
    area.illumination = in.boolean_or(true);
  } else {
    return false;
  }
  return true;
}

/// `area_light` and what acts on it. Without it these do nothing, as in POV-Ray.
bool read_area(Reader& in, Light& light) {
  if (in.accept("area_light")) {
    light.area.emplace();
    light.area->axis1 = in.vec3("first edge of the area");
    light.area->axis2 = in.vec3("second edge of the area");
    light.area->size1 = read_size(in);
    light.area->size2 = read_size(in);
    return true;
  }
  if (light.area) return read_area_option(in, *light.area);
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

/// Of a cylinder.
double read_radius(Reader& in, std::string_view name) {
  Span const at = in.next_span();
  double const radius = in.number(name);
  if (radius >= 0) return radius;
  in.report(Severity::Error, "E0353",
            fmt::format("a cylinder's {} must not be negative, it is {}", name, radius), at);
  return 1;
}

/// `point_at` and the like before or without the word that gives them a meaning.
bool reject_aim(Reader& in) {
  for (std::string_view word : {"point_at", "radius", "falloff", "tightness"}) {
    Span const at = in.next_span();
    if (!in.accept(word)) continue;
    in.report(Severity::Error, "E0252",
              fmt::format("'{}' belongs behind 'spotlight' or 'cylinder'{}", word,
                          word == "point_at" ? " or 'parallel'" : ""),
              at);
    if (in.has_value()) in.vec3(word);
    return true;
  }
  return false;
}

bool read_aim(Reader& in, Draft& draft) {
  Light& light = draft.light;
  bool const cylinder = light.kind == Light::Kind::Cylinder;
  if (light.kind == Light::Kind::Point) return reject_aim(in);
  if (in.accept("point_at")) {
    light.point_at = in.vec3("point_at");
    return true;
  }
  if (!draft.spot && !cylinder) return reject_aim(in);
  if (in.accept("radius"))
    (cylinder ? light.radius : light.radius_deg) =
        cylinder ? read_radius(in, "radius") : read_angle(in, "radius");
  else if (in.accept("falloff"))
    (cylinder ? light.falloff : light.falloff_deg) =
        cylinder ? read_radius(in, "falloff") : read_angle(in, "falloff");
  else if (in.accept("tightness"))
    light.tightness = in.number("tightness");
  else
    return false;
  return true;
}

std::shared_ptr<scene::Object const> read_inner(Reader& in, std::string_view word) {
  auto object = accept_object(in);
  if (!object)
    in.report(Severity::Error, "E0250", fmt::format("{} {{}} must hold an object", word),
              in.block_span());
  while (!in.at_end()) reject(in, fmt::format("the end of {}", word));
  in.close();
  return object ? std::make_shared<scene::Object const>(std::move(*object)) : nullptr;
}

bool read_objects(Reader& in, Light& light) {
  if (in.open("projected_through")) {
    light.projected_through = read_inner(in, "projected_through");
  } else if (in.open("looks_like")) {
    auto const body = read_inner(in, "looks_like");
    if (!body) return true;
    auto placed = std::make_shared<scene::Object>(*body);
    transform_object(*placed, geometry::Transform::translation(light.position));
    light.looks_like = std::move(placed);
  } else {
    return false;
  }
  return true;
}

bool read_item(Reader& in, Draft& draft) {
  Light& light = draft.light;
  geometry::Transform transform;
  if (read_transform(in, transform))
    transform_light(light, transform);
  else if (in.accept("shadowless"))
    light.shadowless = true;
  else if (in.accept("fade_distance"))
    light.fade_distance = in.number("fade_distance");
  else if (in.accept("fade_power"))
    light.fade_power = in.number("fade_power");
  else if (in.accept("media_interaction"))
    light.media_interaction = in.boolean_or(true);
  else if (in.accept("media_attenuation"))
    light.media_attenuation = in.boolean_or(true);
  else
    return read_light_photons(in, light.throws) || read_objects(in, light) || read_area(in, light)
           || read_kind(in, draft) || read_aim(in, draft);
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

/// What is attached to a light moves with it.
void transform_shared(std::shared_ptr<scene::Object const>& object,
                      geometry::Transform const& transform) {
  if (!object) return;
  auto moved = std::make_shared<scene::Object>(*object);
  transform_object(*moved, transform);
  object = std::move(moved);
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
  Draft draft{light, light.kind == Light::Kind::Parallel, light.kind == Light::Kind::Spot};
  while (!in.at_end())
    if (!read_item(in, draft)) reject(in, "a light_source item");
  check(in, light);
  return light;
}

void transform_light(Light& light, geometry::Transform const& transform) {
  light.position = transform.point(light.position);
  light.point_at = transform.point(light.point_at);
  if (light.area) {
    light.area->axis1 = transform.linear * light.area->axis1;
    light.area->axis2 = transform.linear * light.area->axis2;
  }
  transform_shared(light.projected_through, transform);
  transform_shared(light.looks_like, transform);
}

void place_light(scene::Light light, Reader& in) {
  auto const body = std::exchange(light.looks_like, nullptr);
  scene_state(in.interpreter()).scene.lights.push_back(std::move(light));
  if (!body) return;
  scene::Object visible = *body;
  visible.no_shadow = true;
  place_object(std::move(visible), in);
}

} // namespace abbe::lang
