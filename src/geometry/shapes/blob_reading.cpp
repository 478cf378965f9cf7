// SPDX-License-Identifier: MIT
#include "geometry/line.hpp"
#include "geometry/shapes/blob.hpp"
#include "geometry/shapes/reading.hpp"
#include "geometry/transform.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::geometry {

namespace {

struct Raw {
  Vec3 base{0}, end{0};
  double radius = 0, strength = 0;
  bool cylinder = false;
  int texture = -1;
  Transform place;
};

/// In the coordinates of the scene.
std::optional<Blob::Component> component_of(Raw const& raw) {
  if (!finite(raw.base) || !finite(raw.end) || !usable_size(raw.radius)
      || !std::isfinite(raw.strength))
    return std::nullopt;
  double const radius = std::fabs(raw.radius);
  Blob::Component c;
  Vec3 const axis = raw.end - raw.base;
  double const length = raw.cylinder ? vector_length(axis) : 0;
  // Rows: the directions of unit space. The order of y_to's axes is free: a body of revolution.
  Mat3 turn(1);
  if (length > 0) {
    Mat3 const to = y_to(axis).inverse_linear; // takes the axis to y
    turn = Mat3(0);
    for (int k = 0; k < 3; ++k) turn[k] = Vec3(to[k].x, to[k].z, to[k].y);
  }
  c.length = length / radius;
  c.to_unit = (turn * raw.place.inverse_linear) * (1 / radius);
  c.centre = raw.place.point(raw.base);
  c.strength = raw.strength;
  c.texture = raw.texture;
  Vec3 const far = raw.place.point(raw.base + (length > 0 ? axis : Vec3(0)));
  Mat3 const rows = glm::transpose(raw.place.linear);
  Vec3 const reach(radius * vector_length(rows[0]), radius * vector_length(rows[1]),
                   radius * vector_length(rows[2]));
  c.low = glm::min(c.centre, far) - reach;
  c.high = glm::max(c.centre, far) + reach;
  if (!finite(c.low) || !finite(c.high)) return std::nullopt;
  return c;
}

std::optional<Raw> read_ball_or_cylinder(Parameters& parameters) {
  Raw raw;
  if (parameters.open("sphere")) {
    raw.base = raw.end = parameters.vec3("centre");
  } else if (parameters.open("cylinder")) {
    raw.cylinder = true;
    raw.base = parameters.vec3("first end");
    raw.end = parameters.vec3("second end");
  } else {
    return std::nullopt;
  }
  raw.radius = parameters.number("radius");
  (void)parameters.accept("strength");
  raw.strength = parameters.number("strength");
  std::vector<AffineMap> steps;
  while (parameters.part_modifier(steps, raw.texture)) {
  }
  for (AffineMap const& m : steps) {
    raw.place =
        raw.place.then({m.linear, m.offset, m.inverse_linear, m.inverse_offset, m.linear_error,
                        m.offset_error, m.inverse_linear_error, m.inverse_offset_error});
  }
  parameters.close();
  return raw;
}

} // namespace

std::optional<PlacedShape> make_blob(std::vector<Blob::Component> components, double threshold) {
  if (components.empty() || !std::isfinite(threshold) || !(threshold > 0)) return std::nullopt;
  Vec3 low(infinity), high(-infinity);
  for (Blob::Component const& c : components) {
    low = glm::min(low, c.low);
    high = glm::max(high, c.high);
  }
  Vec3 const middle = low * 0.5 + high * 0.5, half = (high - low) * 0.5;
  double const largest = std::max(half.x, std::max(half.y, half.z));
  if (!usable_size(largest)) return std::nullopt;
  double const unit = std::exp2(std::ilogb(largest));
  for (Blob::Component& c : components) {
    c.centre = (c.centre - middle) / unit;
    c.low = (c.low - middle) / unit;
    c.high = (c.high - middle) / unit;
    Vec3 const wide = gamma_bound(16) * (glm::abs(c.low) + glm::abs(c.high));
    c.low -= wide;
    c.high += wide;
    c.to_unit *= unit;
    c.middle = 0.5 * (c.low + c.high);
    c.reach = vector_length(c.high - c.middle) * (1 + gamma_bound(16));
  }
  Transform const placement = Transform::scaling(Vec3(unit)).then(Transform::translation(middle));
  return PlacedShape{std::make_shared<Blob>(std::move(components), threshold), placement};
}

std::optional<PlacedShape> read_blob(Parameters& parameters) {
  double threshold = 1;
  std::vector<Blob::Component> components;
  bool good = true;
  int nothing = 0;
  for (;;) {
    Span const at = parameters.next_span();
    std::optional<Raw> raw;
    if (parameters.accept("threshold")) {
      threshold = parameters.number("threshold");
      continue;
    }
    if (parameters.flag("hierarchy") || parameters.flag("sturm")) continue;
    if (parameters.accept("component")) {
      raw.emplace();
      raw->strength = parameters.number("strength");
      raw->radius = parameters.number("radius");
      raw->base = raw->end = parameters.vec3("centre");
    } else {
      raw = read_ball_or_cylinder(parameters);
      if (!raw) break;
    }
    if (raw->radius == 0) {
      parameters.report(Severity::Warning, "E0619",
                        "a component of radius 0 adds nothing to a blob", at);
      ++nothing;
    } else if (auto component = component_of(*raw)) {
      components.push_back(*component);
    } else {
      good = false;
      parameters.report(Severity::Error, "E0619",
                        "a component of a blob needs finite places and a finite radius", at);
    }
  }
  if (!good) return std::nullopt;
  if ((components.empty() && nothing > 0) || threshold < 0)
    return left_out(parameters, "E0620",
                    threshold < 0 ? "a blob with a threshold below 0 is everywhere: it is not drawn"
                                  : "a blob of components of radius 0 is not drawn");
  return or_report(make_blob(std::move(components), threshold), parameters, "E0620",
                   "a blob needs a component, and a threshold above zero");
}

} // namespace abbe::geometry
