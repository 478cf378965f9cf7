// SPDX-License-Identifier: MIT
#include "geometry/shapes/mesh.hpp"
#include "lang/blocks.hpp"
#include "lang/scene_patterns.hpp"
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
  std::optional<double> vertical_angle_deg;
  Span angle_span;
  std::optional<Vec3> focal_point;
  bool frame_given = false; ///< right or up is written
  bool failed = false;      ///< reported as degenerate
  geometry::Transform transform;
};

using Kind = Camera::Kind;

/// `angle a`, of a spherical camera `angle across, down`.
void read_angle(Reader& in, Draft& draft) {
  draft.angle_span = in.next_span();
  draft.angle_deg = in.number("angle");
  if (in.next() == Next::Numeric) draft.vertical_angle_deg = in.number("the angle down");
}

void check_angle(Reader& in, Draft& draft) {
  if (!draft.angle_deg) return;
  bool const flat = draft.camera.kind <= Kind::Orthographic;
  double const most = flat ? 180 : 360;
  auto const wrong = [&](double angle) {
    return !(angle >= 0) || angle > most || (flat && angle == most);
  };
  double const given =
      wrong(*draft.angle_deg) ? *draft.angle_deg : draft.vertical_angle_deg.value_or(0);
  if (wrong(given)) {
    in.report(Severity::Error, "E0353",
              fmt::format("the camera's angle must be at least 0 and {} {} degrees, not {}",
                          flat ? "below" : "at most", most, given),
              draft.angle_span);
    draft.angle_deg = 60;
  }
  if (draft.vertical_angle_deg && draft.camera.kind != Kind::Spherical)
    in.report(Severity::Error, "E0353", "only a spherical camera takes a second angle",
              draft.angle_span);
  if (draft.camera.kind == Kind::Omnimax || draft.camera.kind == Kind::Panoramic)
    in.report(Severity::Warning, "E0257",
              fmt::format("'angle' has no effect on a camera that is {}: its angle is fixed",
                          scene::camera_words[static_cast<std::size_t>(draft.camera.kind)]),
              draft.angle_span);
}

int whole(Reader& in, std::string_view name, int least, int most) {
  Span const at = in.next_span();
  double const value = in.number(name);
  if (value >= least && value <= most) return static_cast<int>(value);
  in.report(Severity::Error, "E0353",
            fmt::format("{} must be from {} to {}, not {}", name, least, most, value), at);
  return least;
}

/// The faces of a mesh in the space of the scene.
std::vector<scene::MeshCamera::Face> faces_of(geometry::Mesh const& mesh,
                                              geometry::Transform const& placement) {
  std::vector<scene::MeshCamera::Face> faces;
  for (auto const& own : mesh.faces_of_file()) {
    scene::MeshCamera::Face face;
    for (std::size_t k = 0; k < 3; ++k) {
      face.corners[k] = placement.point(own.corners[k]);
      if (own.smooth) face.normals[k] = glm::normalize(placement.normal(own.normals[k]));
    }
    auto const& p = face.corners;
    // Seen from the side that it points to, the corners run clockwise.
    face.normal = glm::normalize(glm::cross(p[2] - p[0], p[1] - p[0]));
    face.uv = own.uv;
    face.smooth = own.smooth;
    faces.push_back(face);
  }
  return faces;
}

/// `mesh_camera { rays a pixel, distribution [, distance] meshes [smooth] }`.
std::shared_ptr<scene::MeshCamera const> read_mesh_camera(Reader& in) {
  auto camera = std::make_shared<scene::MeshCamera>();
  Span const span = in.block_span();
  camera->rays_per_pixel = whole(in, "the rays of a pixel", 1, 100000);
  camera->distribution = whole(in, "the distribution of a mesh_camera", 0, 3);
  if (in.next() == Next::Numeric) camera->longest = in.number("the longest way");
  while (!in.at_end()) {
    Span const at = in.next_span();
    if (in.accept("smooth")) {
      camera->smooth = true;
    } else if (auto object = accept_object(in)) {
      auto const* const mesh = dynamic_cast<geometry::Mesh const*>(object->shape.get());
      if (mesh != nullptr)
        camera->meshes.push_back(faces_of(*mesh, object->placement));
      else
        in.report(Severity::Error, "E0250", "a mesh_camera is made of meshes", at);
    } else {
      reject(in, "a mesh");
    }
  }
  if (camera->meshes.empty()) {
    in.report(Severity::Error, "E0250", "a mesh_camera needs at least one mesh", span);
    camera->meshes.emplace_back();
  }
  return camera;
}

bool read_kind(Reader& in, Camera& camera) {
  for (std::size_t i = 0; i < std::size(scene::camera_words); ++i) {
    auto const kind = static_cast<Kind>(i);
    if (kind == Kind::Mesh ? !in.open(scene::camera_words[i]) : !in.accept(scene::camera_words[i]))
      continue;
    camera.kind = kind;
    if (kind == Kind::Mesh) {
      camera.mesh = read_mesh_camera(in);
      in.close();
      return true;
    }
    if (camera.kind != Kind::Cylinder) return true;
    Span const at = in.next_span();
    double const type = in.number("the type of cylinder");
    if (type == 1 || type == 2 || type == 3 || type == 4)
      camera.cylinder_type = static_cast<std::uint8_t>(type);
    else
      in.report(Severity::Error, "E0353",
                fmt::format("the type of a cylinder camera is 1, 2, 3 or 4, not {}", type), at);
    return true;
  }
  return false;
}

/// `bokeh { pigment { } }`.
void read_bokeh(Reader& in, Draft& draft) {
  scene::Pigment pigment = default_texture(in, in.block_span()).pigment;
  while (!in.at_end()) {
    if (in.open("pigment")) {
      read_pigment(in, pigment);
      in.close();
    } else {
      reject(in, "a pigment");
    }
  }
  in.close();
  draft.camera.bokeh = make_pigment_pattern(std::move(pigment));
}

/// The lens of focal blur.
bool read_lens(Reader& in, Draft& draft) {
  auto const positive = [&](std::string_view name) {
    Span const at = in.next_span();
    double const value = in.number(name);
    if (value >= 0) return value;
    in.report(Severity::Error, "E0353", fmt::format("'{}' must not be negative", name), at);
    return 0.0;
  };
  if (in.accept("aperture")) {
    draft.camera.aperture = positive("aperture");
  } else if (in.accept("blur_samples")) {
    double most = positive("blur_samples");
    if (in.next() == Next::Numeric) most = positive("blur_samples");
    draft.camera.blur_samples = static_cast<int>(std::min(most, 1e6));
  } else if (in.accept("focal_point")) {
    draft.focal_point = in.vec3("focal_point");
  } else if (in.open("bokeh")) {
    read_bokeh(in, draft);
  } else if (in.accept("confidence")) {
    draft.camera.blur_confidence = positive("confidence");
  } else if (in.accept("variance")) {
    draft.camera.blur_variance = positive("variance");
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

void work_in_lens(Reader& in, Draft& draft) {
  Camera& camera = draft.camera;
  if (camera.bokeh && !(camera.aperture > 0))
    in.report(Severity::Warning, "E0257", "'bokeh' has no effect without 'aperture'", camera.span);
  if (camera.aperture > 0 && camera.blur_samples <= 0) {
    in.report(Severity::Warning, "E0257", "'aperture' has no effect without 'blur_samples'",
              camera.span);
    camera.aperture = 0;
  }
  if (!(camera.aperture > 0)) return;
  if (camera.kind > Kind::Orthographic) {
    in.report(Severity::Error, "E0901",
              "focal blur of a camera that is neither perspective nor orthographic is not "
              "supported yet",
              camera.span);
    camera.aperture = 0;
    return;
  }
  camera.focal_distance = 1; // POV-Ray's, where no focal_point is given
  if (!draft.focal_point) return;
  camera.focal_distance = glm::length(*draft.focal_point - camera.location);
  if (!(camera.focal_distance > 0)) fail(in, draft, "the camera's focal_point is its location");
}

void work_in(Reader& in, Draft& draft) {
  Camera& camera = draft.camera;
  double const right = glm::length(camera.right);
  double const direction = glm::length(camera.direction);
  if (!(right > 0) || !(direction > 0) || !(glm::length(camera.up) > 0))
    return fail(in, draft, "the camera's right, up and direction must not be zero");
  check_angle(in, draft);
  bool const flat = camera.kind <= Kind::Orthographic;
  if (flat && draft.angle_deg.value_or(0) > 0) {
    double const half_rad = *draft.angle_deg / 2 * (std::numbers::pi / 180);
    camera.direction *= right / (2 * simd::tan(half_rad)) / direction;
  }
  if (!flat) {
    bool const spherical = camera.kind == Kind::Spherical;
    camera.angle_deg = draft.angle_deg.value_or(spherical ? 360 : 90);
    camera.vertical_angle_deg = draft.vertical_angle_deg.value_or(camera.angle_deg / 2);
  }
  if (draft.look_at) aim(in, draft);
  work_in_lens(in, draft);
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
  if (c.kind != Camera::Kind::Perspective) return false;
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

/// `normal { }`, which stays where it is when the camera is moved.
void read_camera_normal(Reader& in, Camera& camera) {
  scene::Normal normal;
  read_normal(in, normal, {});
  in.close();
  if (normal.pattern) camera.normal = std::make_shared<scene::Normal const>(std::move(normal));
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
        read_angle(in, draft);
      else if (in.open("normal"))
        read_camera_normal(in, draft.camera);
      else if (!read_kind(in, draft.camera) && !read_vectors(in, draft) && !read_lens(in, draft)
               && !read_transform(in, draft.transform) && !skip_rest_if_unsupported(in))
        reject(in, "a camera item");
    }
    work_in(in, draft);
  }
  transform_camera(draft.camera, draft.transform);
  check(in, draft);
  return draft.camera;
}

} // namespace abbe::lang
