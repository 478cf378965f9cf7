// SPDX-License-Identifier: MIT
#include "geometry/shapes/isosurface.hpp"

#include "base/sampled_field.hpp"
#include "geometry/field_roots.hpp"
#include "geometry/kernels.hpp"
#include "geometry/shapes/reading.hpp"
#include "geometry/shapes/start.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::geometry {

namespace {

Vec3 vec3(lane::Vec<double> const& v) {
  return {v.x, v.y, v.z};
}
constexpr std::uint32_t ball_face = 7;

} // namespace

Isosurface::Isosurface(std::shared_ptr<ScalarField const> field, Container const& container,
                       double threshold, double accuracy, bool open)
    : field_(std::move(field)),
      container_(container),
      threshold_(threshold),
      accuracy_(accuracy),
      open_(open) {}

double Isosurface::ball_radius() const {
  return container_.ball
             ? container_.radius * (1 + gamma_bound(8))
             : vector_length(container_.high - container_.low) / 2 * (1 + gamma_bound(8));
}

/// Where the line enters and leaves the container. @return false when it misses it
bool Isosurface::contained(Ray const& ray, Crossing& in, Crossing& out) const {
  Line<double> line = line_of(ray);
  in.t = -infinity;
  out.t = infinity;
  in.entering = true;
  in.visible = out.visible = !open_;
  if (container_.ball) {
    Vec3 const from = ray.origin - container_.centre;
    double const a = glm::dot(ray.direction, ray.direction);
    double const middle = -glm::dot(from, ray.direction) / a;
    Vec3 const at = from + middle * ray.direction;
    double const distance = vector_length(at), radius = container_.radius;
    double const room = (radius - distance) * (radius + distance);
    if (!(room > 0)) return false;
    double const root = std::sqrt(room * a);
    for (Crossing* c : {&in, &out}) {
      c->t = c == &in ? middle - root / a : middle + root / a;
      Vec3 const moved = ray.origin_rounding + std::fabs(c->t) * ray.direction_rounding
                         + gamma_bound(8)
                               * (glm::abs(ray.origin) + glm::abs(container_.centre)
                                  + std::fabs(c->t) * glm::abs(ray.direction));
      c->error = root_motion(radius * (moved.x + moved.y + moved.z), root, a)
                 + gamma_bound(4) * (std::fabs(c->t) + std::fabs(middle));
      c->slack = root_motion(
          radius * (ray.origin_error.x + ray.origin_error.y + ray.origin_error.z), root, a);
      c->face = ball_face;
    }
    return true;
  }
  for (int axis = 0; axis < 3; ++axis) {
    double const o = ray.origin[axis], d = ray.direction[axis];
    if (d == 0) {
      if (o < container_.low[axis] || o > container_.high[axis]) return false;
      continue;
    }
    for (int upper = 0; upper < 2; ++upper) {
      double const height = upper != 0 ? container_.high[axis] : container_.low[axis];
      Crossing c;
      c.t = (height - o) / d;
      c.error =
          (vec3(line.origin_rounding)[axis] + std::fabs(c.t) * vec3(line.direction_rounding)[axis]
           + gamma_bound(4) * (std::fabs(height) + std::fabs(o)))
              / std::fabs(d)
          + gamma_bound(2) * std::fabs(c.t);
      c.slack = vec3(line.slack)[axis] / std::fabs(d);
      c.face = static_cast<std::uint32_t>(1 + 2 * axis + upper);
      c.visible = !open_;
      c.entering = (upper == 0) == (d > 0);
      if (c.entering && c.t > in.t) in = c;
      if (!c.entering && c.t < out.t) out = c;
    }
  }
  return in.t < out.t;
}

/// Crossings with from <= t <= until, up to the first that is beyond `enough`.
void Isosurface::between(Ray const& ray, double from, double until, double enough,
                         Crossings& out) const {
  Crossing enter, leave;
  if (!contained(ray, enter, leave)) return;
  double const begin = std::max(enter.t, from), end = std::min(leave.t, until);
  if (!(begin < end)) return;
  // From the middle of the container, where places have the most digits.
  Line<double> const line = line_of(ray);
  Approach<double> const near = approach(line, 0.5 * enter.t + 0.5 * leave.t);
  double const length = vector_length(ray.direction), unit = std::exp2(-std::ilogb(length));
  FieldLine const along{*field_,
                        vec3(near.point),
                        ray.direction * unit,
                        threshold_,
                        accuracy_ / (length * unit),
                        (enough - near.t) / unit};
  double const low = (begin - near.t) / unit, high = (end - near.t) / unit;
  if (begin == enter.t && along.side(low) < 0) out.push_back(enter);
  std::vector<FieldRoot> roots;
  field_roots(along, low, high, roots);
  for (FieldRoot const& root : roots) {
    double const step = root.at * unit;
    Vec3 const at = along.origin + root.at * along.direction;
    Vec3 const gradient = field_->gradient(at), size = glm::abs(gradient);
    double const slope = std::fabs(glm::dot(gradient, along.direction));
    Crossing c;
    c.t = near.t + step;
    Vec3 const moved = vec3(near.rounding) + std::fabs(step) * ray.direction_rounding;
    // Grazing: as if bent like the container.
    double const steep = vector_length(gradient);
    double const bend = steep / std::max(ball_radius(), 1e-300);
    c.error = unit * (root.error + root_motion(glm::dot(size, moved), slope, bend))
              + gamma_bound(4) * (std::fabs(c.t) + std::fabs(step));
    c.slack = unit * root_motion(glm::dot(size, ray.origin_error), slope, bend);
    c.entering = !root.rising;
    out.push_back(c);
  }
  bool const stopped = !roots.empty() && roots.back().at - roots.back().error > along.enough;
  if (!stopped && end == leave.t && along.side(high) < 0) out.push_back(leave);
}

void Isosurface::crossings(Ray const& ray, Start const* start, Crossings& out) const {
  std::size_t const first = out.size();
  between(ray, -infinity, infinity, infinity, out);
  if (start != nullptr) impose_start(*start, false, first, out);
}

void Isosurface::crossings_ahead(Ray const& ray, Start const* start, double until,
                                 Crossings& out) const {
  if (start == nullptr) return between(ray, 0, until, 0, out);
  // The known root is as near as the origin is known, unless the ray grazes: then all are looked
  // at.
  Vec3 const blur = ray.origin_error + ray.origin_rounding + 0x1p-50 * glm::abs(ray.origin);
  double const near = 16 * vector_length(blur) / vector_length(ray.direction);
  std::size_t const first = out.size();
  between(ray, -near, until, near, out);
  if (has_start(*start, near, first, out)) return impose_start(*start, false, first, out);
  out.resize(first);
  crossings(ray, start, out);
}

bool Isosurface::inside(Vec3 const& point) const {
  if (container_.ball) {
    if (vector_length(point - container_.centre) > container_.radius) return false;
  } else if (glm::any(glm::lessThan(point, container_.low))
             || glm::any(glm::greaterThan(point, container_.high))) {
    return false;
  }
  return field_->value(point) <= threshold_;
}

Vec3 Isosurface::normal(Vec3 const& point, std::uint32_t face) const {
  if (face == ball_face) return unit_vector(point - container_.centre);
  if (face != 0) {
    Vec3 out(0);
    out[static_cast<int>((face - 1) / 2)] = (face - 1) % 2 == 0 ? -1 : 1;
    return out;
  }
  Vec3 const slope = field_->gradient(point);
  return slope == Vec3(0) || !finite(slope) ? Vec3(0, 1, 0) : unit_vector(slope);
}

namespace {

/// @return false after an error
bool read_container(Parameters& parameters, Isosurface::Container& container) {
  bool good = false;
  if (parameters.open("box")) {
    Vec3 const a = parameters.vec3("corner"), b = parameters.vec3("corner");
    container.low = glm::min(a, b);
    container.high = glm::max(a, b);
    good = finite(container.high - container.low)
           && glm::all(glm::lessThan(container.low, container.high));
    parameters.close();
  } else if (parameters.open("sphere")) {
    container.ball = true;
    container.centre = parameters.vec3("centre");
    container.radius = std::fabs(parameters.number("radius"));
    container.low = container.centre - container.radius;
    container.high = container.centre + container.radius;
    good = finite(container.high) && finite(container.low) && usable_size(container.radius);
    parameters.close();
  }
  if (!good)
    parameters.report(Severity::Error, "E0628",
                      "contained_by holds a box that is not flat, or a sphere");
  return good;
}

} // namespace

std::optional<PlacedShape> read_isosurface(Parameters& parameters) {
  auto field = parameters.field();
  bool good = field != nullptr;
  Isosurface::Container container;
  double threshold = 0, accuracy = 0.001, max_gradient = 1.1;
  bool open = false;
  for (;;) {
    if (parameters.open("contained_by")) {
      good = read_container(parameters, container) && good;
      parameters.close();
    } else if (parameters.accept("threshold")) {
      threshold = parameters.number("threshold");
    } else if (parameters.accept("accuracy")) {
      Span const at = parameters.next_span();
      accuracy = parameters.number("accuracy");
      if (accuracy > 0) continue;
      good = false;
      parameters.report(Severity::Error, "E0630", "accuracy must be above zero", at);
    } else if (parameters.accept("max_gradient")) {
      max_gradient = parameters.number("max_gradient");
    } else if (parameters.accept("evaluate")) {
      for (int i = 0; i < 3; ++i) (void)parameters.number("evaluate");
    } else if (parameters.accept("max_trace")) {
      (void)parameters.number("max_trace");
    } else if (auto const flag = parameters.flag("open")) {
      open = *flag;
    } else if (!parameters.flag("all_intersections")) {
      break;
    }
  }
  if (!good) return std::nullopt;
  if (auto const* sampled = dynamic_cast<SampledField const*>(field.get()))
    if (auto bounded = sampled->with_slope(max_gradient)) field = std::move(bounded);
  return PlacedShape{
      std::make_shared<Isosurface>(std::move(field), container, threshold, accuracy, open), {}};
}

} // namespace abbe::geometry
