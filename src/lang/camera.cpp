// SPDX-License-Identifier: MIT
#include "lang/blocks.hpp"
#include "lang/unsupported.hpp"
#include "simd/math.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

namespace abbe::lang {

namespace {

using scene::Camera;

/// What a camera block says; POV-Ray 3.5 on works it in after the whole block is read, so that the
/// order of the items does not matter.
struct Draft {
  Camera camera;
  Vec3 sky{0, 1, 0};
  std::optional<Vec3> look_at;
  std::optional<double> angle_deg; ///< 0 leaves the direction as it is
  bool frame_given = false;        ///< right or up is written
  bool failed = false;             ///< reported as degenerate
  geometry::Transform transform;
};

double read_angle(Reader& in) {
  Span const at = in.next_span();
  double const angle = in.number("angle");
  if (angle >= 0 && angle < 180) return angle;
  in.report(
      Severity::Error, "E0353",
      fmt::format("the camera's angle must be at least 0 and below 180 degrees, not {}", angle),
      at);
  return 60;
}

/// Of these the other items mean something else.
bool is_projection(std::string_view word) {
  constexpr std::string_view words[] = {"fisheye",   "mesh_camera", "omnimax",
                                        "panoramic", "spherical",   "ultra_wide_angle"};
  return std::ranges::find(words, word) != std::end(words);
}

bool read_kind(Reader& in, Camera& camera) {
  if (in.accept("perspective")) {
    camera.kind = Camera::Kind::Perspective;
  } else if (in.accept("orthographic")) {
    camera.kind = Camera::Kind::Orthographic;
  } else if (in.next_word() == "cylinder") {
    in.report(Severity::Error, "E0901", "'cylinder' in a camera is not supported yet",
              in.next_span());
    skip_rest(in);
  } else {
    return false;
  }
  return true;
}

bool read_vectors(Reader& in, Draft& draft) {
  if (in.accept("location"))
    draft.camera.location = in.vec3("location");
  else if (in.accept("look_at"))
    draft.look_at = in.vec3("look_at");
  else if (in.accept("direction"))
    draft.camera.direction = in.vec3("direction");
  else if (in.accept("sky"))
    draft.sky = in.vec3("sky");
  else if (in.accept("right")) {
    draft.camera.right = in.vec3("right");
    draft.frame_given = true;
  } else if (in.accept("up")) {
    draft.camera.up = in.vec3("up");
    draft.frame_given = true;
  } else {
    return false;
  }
  return true;
}

void fail(Reader& in, Draft& draft, std::string_view why) {
  if (std::exchange(draft.failed, true)) return;
  in.report(Severity::Error, "E0352", why, draft.camera.span);
}

/// A view this near to 'sky' is along it. POV-Ray's bound, which decides what a picture shows.
constexpr double along_sky = 1e-10;

/// Turns the camera to `look_at` and keeps the lengths of its vectors. Left-handed is what is so
/// clearly: vectors in one plane, as `up z` with the default direction, count as right-handed.
void aim(Reader& in, Draft& draft) {
  Camera& camera = draft.camera;
  Vec3 const towards = *draft.look_at - camera.location;
  double const distance = glm::length(towards);
  if (!(distance > 0)) return fail(in, draft, "the camera looks at its own location");
  bool const left_handed = glm::dot(camera.right, glm::cross(camera.up, camera.direction)) > 0;
  Vec3 const ahead = towards / distance;
  Vec3 side = glm::cross(draft.sky, ahead);
  Vec3 const size = glm::abs(side);
  if (std::max({size.x, size.y, size.z}) < along_sky) {
    in.report(Severity::Warning, "E0352",
              "the camera looks along 'sky', which leaves open where up is: 'right' tells",
              camera.span);
    side = camera.right;
  }
  Vec3 const right = side / glm::length(side);
  camera.direction = ahead * glm::length(camera.direction);
  camera.up = glm::cross(ahead, right) * glm::length(camera.up);
  camera.right = right * ((left_handed ? 1 : -1) * glm::length(camera.right));
}

void work_in(Reader& in, Draft& draft) {
  Camera& camera = draft.camera;
  double const right = glm::length(camera.right);
  double const direction = glm::length(camera.direction);
  if (!(right > 0) || !(direction > 0) || !(glm::length(camera.up) > 0))
    return fail(in, draft, "the camera's right, up and direction must not be zero");
  if (draft.angle_deg.value_or(0) > 0) {
    double const half_rad = *draft.angle_deg / 2 * (std::numbers::pi / 180);
    camera.direction *= right / (2 * simd::tan(half_rad)) / direction;
  }
  if (draft.look_at) aim(in, draft);
  if (camera.kind == Camera::Kind::Orthographic && (!draft.frame_given || draft.angle_deg)) {
    double const distance = glm::length(draft.look_at.value_or(Vec3(0, 0, 1)) - camera.location);
    double const size = distance / glm::length(camera.direction);
    if (size > 0) {
      camera.right *= size;
      camera.up *= size;
    }
  }
}

void transform_camera(Camera& camera, geometry::Transform const& transform) {
  camera.location = transform.point(camera.location);
  camera.direction = transform.vector(camera.direction);
  camera.up = transform.vector(camera.up);
  camera.right = transform.vector(camera.right);
}

/// Half of the picture and a little more: samples may lie beside it by a part of a pixel.
constexpr double edge = 0.7;

/// Has a point of the picture a ray without a direction? @param c its vectors lie in one plane
bool has_lost_ray(Camera const& c) {
  if (c.kind == Camera::Kind::Orthographic) return false;
  Vec3 const axis = glm::cross(c.right, c.up);
  double const area2 = glm::dot(axis, axis);
  double const right = glm::length(c.right), up = glm::length(c.up);
  if (std::sqrt(area2) > gamma_bound(8) * right * up) {
    double const a = glm::dot(glm::cross(c.direction, c.up), axis) / area2;
    double const b = glm::dot(glm::cross(c.right, c.direction), axis) / area2;
    return std::abs(a) <= edge && std::abs(b) <= edge;
  }
  double const ahead = glm::length(c.direction);
  Vec3 const across = right > up ? c.right : c.up;
  return ahead <= edge * (right + up)
         && glm::length(glm::cross(across, c.direction))
                <= gamma_bound(8) * glm::length(across) * ahead;
}

/// Three directions in one plane show what lies in it.
void check(Reader& in, Draft& draft) {
  Camera const& c = draft.camera;
  double const volume = std::abs(glm::dot(c.right, glm::cross(c.up, c.direction)));
  double const scale = glm::length(c.right) * glm::length(c.up) * glm::length(c.direction);
  if (volume > gamma_bound(8) * scale || draft.failed) return;
  if (has_lost_ray(c))
    return fail(in, draft, "the camera's right, up and direction lie in one plane and cancel out");
  in.report(Severity::Warning, "E0352",
            "the camera's right, up and direction lie in one plane: nothing else is seen", c.span);
}

} // namespace

scene::Camera read_camera(Reader& in) {
  Draft draft;
  draft.camera = default_camera(in, in.block_span());
  draft.camera.span = in.block_span();
  if (auto named = in.accept_value<Camera>()) {
    draft.camera = *named;
    draft.camera.span = in.block_span();
    while (!in.at_end())
      if (!read_transform(in, draft.transform))
        reject(in, "a transform (a copied camera takes nothing else)");
  } else {
    while (!in.at_end()) {
      if (in.accept("angle"))
        draft.angle_deg = read_angle(in);
      else if (is_projection(in.next_word())) {
        skip_rest_if_unsupported(in);
      } else if (!read_kind(in, draft.camera) && !read_vectors(in, draft)
                 && !read_transform(in, draft.transform))
        reject(in, "a camera item");
    }
    work_in(in, draft);
  }
  transform_camera(draft.camera, draft.transform);
  check(in, draft);
  return draft.camera;
}

} // namespace abbe::lang
