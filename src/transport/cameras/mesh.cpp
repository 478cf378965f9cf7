// SPDX-License-Identifier: MIT
#include "transport/cameras/projections.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace abbe::transport {
namespace {

using Face = scene::MeshCamera::Face;

/// Which face of a mesh has a point of its uv square: a grid of lists.
class UvGrid {
public:
  explicit UvGrid(std::vector<Face> const& faces) : faces_(faces) {
    side_ = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(faces.size()))), 1, 1024);
    cells_.resize(static_cast<std::size_t>(side_ * side_));
    for (std::uint32_t i = 0; i < faces.size(); ++i) {
      auto const& uv = faces[i].uv;
      Vec2 const low = glm::min(uv[0], glm::min(uv[1], uv[2]));
      Vec2 const high = glm::max(uv[0], glm::max(uv[1], uv[2]));
      for (int y = cell(low.y); y <= cell(high.y); ++y)
        for (int x = cell(low.x); x <= cell(high.x); ++x)
          cells_[static_cast<std::size_t>(y * side_ + x)].push_back(i);
    }
  }

  struct Found {
    Face const* face = nullptr; ///< none
    Vec3 weights{0};            ///< of its corners
  };
  /// The first in the order of the file.
  Found find(Vec2 const& at) const {
    for (auto const i : cells_[static_cast<std::size_t>(cell(at.y) * side_ + cell(at.x))]) {
      auto const& uv = faces_[i].uv;
      Vec2 const ab = uv[1] - uv[0], ac = uv[2] - uv[0], ap = at - uv[0];
      double const area = ab.x * ac.y - ab.y * ac.x;
      if (area == 0) continue;
      double const b = (ap.x * ac.y - ap.y * ac.x) / area, c = (ab.x * ap.y - ab.y * ap.x) / area;
      if (b >= 0 && c >= 0 && b + c <= 1) return {&faces_[i], {1 - b - c, b, c}};
    }
    return {};
  }

private:
  int cell(double at) const {
    return std::clamp(static_cast<int>(std::floor(at * side_)), 0, side_ - 1);
  }
  std::vector<Face> const& faces_;
  int side_;
  std::vector<std::vector<std::uint32_t>> cells_;
};

/// A ray for each face of meshes: from its centre (or from the point that the picture's uv says),
/// along its normal.
/// @source POV-Ray's pictures. A flat face's normal is that of corners which run clockwise; rows
///         are those of the point half a pixel above a pixel's middle, columns of half a pixel to
///         the left; of meshes side by side, columns are counted on from one to the next
class MeshCamera final : public Camera {
public:
  explicit MeshCamera(scene::Camera const& camera)
      : Camera(camera.location),
        mesh_(camera.mesh),
        eye_(camera.location),
        ahead_(camera.direction.z < 0 ? -1 : 1) {
    if (mesh_->distribution == 3)
      for (auto const& faces : mesh_->meshes) grids_.emplace_back(faces);
  }
  bool has_one_point() const override { return false; }
  bool sees_all() const override { return false; }
  int rays_of_point() const override { return mesh_->rays_per_pixel; }

  void rays(PicturePoints const& points, geometry::VectorArrays const& origins,
            geometry::VectorArrays const& directions) const override {
    auto const each = static_cast<std::size_t>(mesh_->rays_per_pixel);
    for (std::size_t k = 0; k < points.count; ++k)
      for (std::size_t i = 0; i < each; ++i) {
        Ray const ray = ray_of(points, k, i);
        origins.set(k * each + i, ray.origin);
        directions.set(k * each + i, ray.direction);
      }
  }
  double longest() const override {
    return mesh_->longest > 0 ? mesh_->longest : Camera::longest();
  }
  Vec2 place(double, double) const override { return Vec2(0); }
  Footprint footprint(int width, int height) const override {
    return {0, 1.0 / std::max(width, height)};
  }

private:
  struct Ray {
    Vec3 origin{0}, direction{0};
  };

  Ray ray_of(PicturePoints const& points, std::size_t k, std::size_t number) const {
    auto const& meshes = mesh_->meshes;
    double const width = points.width, height = points.height;
    double const column = std::clamp(points.x[k] - 0.5, 0.0, width - 0.5);
    double const row = std::clamp(points.y[k] - 1, 0.0, height - 0.5);
    auto const x = static_cast<std::size_t>(column), y = static_cast<std::size_t>(row);
    auto const across = static_cast<std::size_t>(points.width);
    switch (mesh_->distribution) {
    case 0:
      return number < meshes.size() ? centre_of(meshes[number], y * across + x) : Ray{};
    case 1: {
      std::size_t at = across * static_cast<std::size_t>(points.height) * number + y * across + x;
      for (auto const& faces : meshes) {
        if (at < faces.size()) return centre_of(faces, at);
        at -= faces.size();
      }
      return {};
    }
    case 2: {
      std::size_t const block = std::max<std::size_t>(1, across / meshes.size());
      std::size_t const mesh = x / block;
      return mesh < meshes.size() ? centre_of(meshes[mesh], y * block + x) : Ray{};
    }
    default: {
      Vec2 const uv(column / width, 1 - (row + 0.5) / height);
      for (auto const& grid : grids_)
        if (auto const found = grid.find(uv); found.face != nullptr)
          return ray_at(*found.face, found.weights, mesh_->smooth && found.face->smooth);
      return {};
    }
    }
  }
  Ray centre_of(std::vector<Face> const& faces, std::size_t number) const {
    return number < faces.size() ? ray_at(faces[number], Vec3(1.0 / 3), false) : Ray{};
  }
  Ray ray_at(Face const& face, Vec3 const& w, bool smooth) const {
    auto const& p = face.corners;
    Vec3 const point = w.x * p[0] + w.y * p[1] + w.z * p[2];
    auto const& n = face.normals;
    Vec3 const normal = glm::normalize(smooth ? w.x * n[0] + w.y * n[1] + w.z * n[2] : face.normal);
    return {point - eye_ + eye_.z * normal, ahead_ * normal};
  }

  std::shared_ptr<scene::MeshCamera const> mesh_;
  Vec3 eye_;
  double ahead_;
  std::vector<UvGrid> grids_;
};

} // namespace

std::unique_ptr<Camera const> make_mesh_camera(scene::Camera const& camera) {
  return std::make_unique<MeshCamera>(camera);
}

} // namespace abbe::transport
