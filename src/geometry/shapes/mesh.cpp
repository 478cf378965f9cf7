// SPDX-License-Identifier: MIT
#include "geometry/shapes/mesh.hpp"

#include "geometry/shapes/reading.hpp"
#include "geometry/shapes/start.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace abbe::geometry {

namespace {

/// Slack of the hierarchy's boxes against the rounding of the shear, in the mesh's own space, where
/// everything that can be hit is within 4 of the origin: far above 100 roundings of 2^-51, far
/// below the precision of the boxes' floats.
constexpr double box_slack = 0x1p-40;

} // namespace

template <class T>
void Mesh::permute(std::vector<T>& items, std::vector<std::uint32_t> const& order) {
  if (items.empty()) return;
  std::vector<T> sorted;
  sorted.reserve(items.size());
  for (std::uint32_t const item : order) sorted.push_back(items[item]);
  items = std::move(sorted);
}

Mesh::Mesh(MeshData data) : data_(std::move(data)) {
  BvhSpaceFinder finder;
  for (Corners const& face : data_.faces) {
    auto const [low, high] = extent(face);
    finder.add(low, high);
  }
  bounds_ = finder.hull();
  space_ = finder.space();
}

Mesh::Extent Mesh::extent(Corners const& face) const {
  Vec3 const &a = data_.vertices[face[0]], &b = data_.vertices[face[1]],
             &c = data_.vertices[face[2]];
  return {glm::min(a, glm::min(b, c)) - box_slack, glm::max(a, glm::max(b, c)) + box_slack};
}

std::vector<Mesh::FileFace> Mesh::faces_of_file() const {
  hierarchy(); // now the faces stand as they will stay
  std::vector<FileFace> faces(data_.faces.size());
  for (std::uint32_t i = 0; i < data_.faces.size(); ++i) {
    FileFace& face = faces[hierarchy_.order[i]];
    Corners const& normals = normals_of(i);
    Corners const& uv = data_.uv_corners.empty() ? data_.faces[i] : data_.uv_corners[i];
    face.smooth = smoothed() && normals[0] != MeshData::flat;
    for (std::size_t k = 0; k < 3; ++k) {
      face.corners[k] = data_.vertices[data_.faces[i][k]];
      face.normals[k] = face.smooth ? data_.normals[normals[k]] : Vec3(0);
      face.uv[k] = data_.uv.empty() ? Vec2(0) : data_.uv[uv[k]];
    }
  }
  return faces;
}

Bvh const& Mesh::hierarchy() const {
  if (!hierarchy_.there.load(std::memory_order_acquire)) {
    std::call_once(hierarchy_.once, [this] {
      build();
      hierarchy_.there.store(true, std::memory_order_release);
    });
  }
  return hierarchy_.bvh;
}

void Mesh::build() const {
  std::vector<BvhBox> boxes;
  boxes.reserve(data_.faces.size());
  for (Corners const& face : data_.faces) {
    auto const [low, high] = extent(face);
    boxes.push_back(space_.box(low, high, static_cast<std::uint32_t>(boxes.size())));
  }
  hierarchy_.bvh = Bvh(space_, std::move(boxes), 4);
  hierarchy_.order = hierarchy_.bvh.take_items();
  auto const& order = hierarchy_.order;
  permute(data_.faces, order);
  permute(data_.normal_corners, order);
  permute(data_.uv_corners, order);
  permute(data_.textures, order);
}

template <class Visit>
void Mesh::each_hit(ShearedLine const& line, double from, double const& to, Visit&& visit) const {
  Bvh const& bvh = hierarchy(); // sorts the faces
  TriangleWalk walk(bvh, line, data_.vertices.data(), data_.faces.data(), from);
  for (std::uint32_t face = 0; walk.next(to, face);) {
    Corners const& f = data_.faces[face];
    auto const hit =
        hit_triangle(line, data_.vertices[f[0]], data_.vertices[f[1]], data_.vertices[f[2]]);
    if (hit) visit(face, *hit);
  }
}

void Mesh::crossings(Ray const& ray, Start const* start, Crossings& out) const {
  std::size_t const first = out.size();
  bool const closed = solid();
  each_hit(ShearedLine(line_of(ray)), -infinity, infinity,
           [&](std::uint32_t face, TriangleHit const& hit) {
             if (start != nullptr && !closed) {
               // The face itself, and its neighbours across an edge at the start, are left behind.
               if (face == start->face || std::fabs(hit.t) <= hit.error + hit.slack) return;
             }
             out.push_back({hit.t, hit.error, hit.slack, face, hit.against_normal, closed, true});
           });
  if (!closed) return;
  std::sort(out.begin() + static_cast<std::ptrdiff_t>(first), out.end(),
            [](Crossing const& a, Crossing const& b) {
              return a.t != b.t ? a.t < b.t : a.face < b.face;
            });
  for (std::size_t i = first; i < out.size(); ++i) out[i].entering = (i - first) % 2 == 0;
  if (start != nullptr) impose_start(*start, true, first, out);
}

void Mesh::crossings_ahead(Ray const& ray, Start const* start, double until, Crossings& out) const {
  if (solid()) return crossings(ray, start, out); // which way they lead depends on all of them
  ShearedLine const line(line_of(ray));
  // The hierarchy counts from line.point. A step and what it is computed from are off by less than
  // this share of themselves, and steps to the mesh are at most 8 units long.
  double const off = 0x1p-40 * (std::fabs(line.t) + 8 / glm::length(line.direction));
  double to = until - line.t + off;
  each_hit(line, -line.t - off, to, [&](std::uint32_t face, TriangleHit const& hit) {
    bool const at_start = std::fabs(hit.t) <= hit.error + hit.slack;
    if (!(hit.t > 0) || (start != nullptr && (face == start->face || at_start))) return;
    out.push_back({hit.t, hit.error, hit.slack, face, hit.against_normal, false, true});
    // At a departure from elsewhere, what is at the start does not count; and room for others of
    // the same group.
    if (!at_start) to = std::min(to, hit.t + 16 * hit.error - line.t + off);
  });
}

bool Mesh::inside(Vec3 const& point) const {
  if (!solid()) return false;
  bool odd = false;
  ShearedLine const line(line_of({point, *data_.inside_vector, Vec3(0)}));
  each_hit(line, -infinity, infinity,
           [&](std::uint32_t, TriangleHit const& hit) { odd = odd != (hit.t > 0); });
  return odd;
}

Vec3 Mesh::weights(Vec3 const& point, std::uint32_t face) const {
  Corners const& f = data_.faces[face];
  return corner_weights(point, data_.vertices[f[0]], data_.vertices[f[1]], data_.vertices[f[2]]);
}

Vec3 Mesh::geometric_normal(Vec3 const&, std::uint32_t face) const {
  Corners const& f = data_.faces[face];
  Vec3 const& a = data_.vertices[f[0]];
  return unit_vector(glm::cross(data_.vertices[f[1]] - a, data_.vertices[f[2]] - a));
}

Vec3 Mesh::normal(Vec3 const& point, std::uint32_t face) const {
  Vec3 const flat = geometric_normal(point, face);
  if (data_.normals.empty()) return flat;
  Corners const& f = normals_of(face);
  if (f[0] == MeshData::flat) return flat;
  Vec3 const w = weights(point, face);
  Vec3 const smooth =
      w.x * data_.normals[f[0]] + w.y * data_.normals[f[1]] + w.z * data_.normals[f[2]];
  return finite(smooth) && smooth != Vec3(0) ? unit_vector(smooth) : flat;
}

Vec3 Mesh::facing(Vec3 const& point, std::uint32_t face) const {
  if (!data_.normals.empty()) {
    Corners const& f = normals_of(face);
    auto const normal_of = [&](std::size_t corner) { return data_.normals[f[corner]]; };
    bool const smoothed = f[0] != MeshData::flat;
    if (smoothed && (data_.lone || normal_of(0) != normal_of(1) || normal_of(0) != normal_of(2)))
      return normal(point, face);
  }
  return -geometric_normal(point, face);
}

int Mesh::face_texture(std::uint32_t face) const {
  return data_.textures.empty() ? -1 : data_.textures[face][0];
}

std::optional<FaceBlend> Mesh::face_blend(Vec3 const& point, std::uint32_t face) const {
  if (data_.textures.empty()) return std::nullopt;
  auto const& textures = data_.textures[face];
  if (textures[0] == textures[1] && textures[0] == textures[2]) return std::nullopt;
  Vec3 const share = weights(point, face);
  return FaceBlend{
      {textures[0], textures[1], textures[2]}, {share.x, share.y, share.z}, textures.size()};
}

std::optional<Vec2> Mesh::uv(Vec3 const& point, std::uint32_t face) const {
  if (data_.uv.empty()) return std::nullopt;
  Corners const& f = data_.uv_corners.empty() ? data_.faces[face] : data_.uv_corners[face];
  if (f[0] == MeshData::flat) return std::nullopt;
  Vec3 const w = weights(point, face);
  return w.x * data_.uv[f[0]] + w.y * data_.uv[f[1]] + w.z * data_.uv[f[2]];
}

bool Mesh::closed() const {
  std::vector<std::uint32_t> order(data_.vertices.size()), place(order.size());
  std::iota(order.begin(), order.end(), 0U);
  auto const before = [&](std::uint32_t a, std::uint32_t b) {
    Vec3 const &p = data_.vertices[a], &q = data_.vertices[b];
    return p.x != q.x ? p.x < q.x : (p.y != q.y ? p.y < q.y : p.z < q.z);
  };
  std::sort(order.begin(), order.end(), before);
  for (std::size_t i = 0; i < order.size(); ++i) {
    bool const same = i > 0 && !before(order[i - 1], order[i]);
    place[order[i]] = same ? place[order[i - 1]] : order[i];
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (Corners const& face : data_.faces) {
    for (std::size_t i = 0; i < 3; ++i) {
      edges.push_back(std::minmax({place[face[i]], place[face[(i + 1) % 3]]}));
    }
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i < edges.size();) {
    auto const last =
        std::upper_bound(edges.begin() + static_cast<std::ptrdiff_t>(i), edges.end(), edges[i]);
    auto const end = static_cast<std::size_t>(last - edges.begin());
    if ((end - i) % 2 != 0) return false;
    i = end;
  }
  return true;
}

bool leaks(Shape const& shape) {
  auto const* const mesh = dynamic_cast<Mesh const*>(&shape);
  return mesh != nullptr && mesh->solid() && !mesh->closed();
}

std::size_t Mesh::memory() const {
  auto const bytes = [](auto const& v) { return v.capacity() * sizeof(v[0]); };
  return sizeof(*this) + bytes(data_.vertices) + bytes(data_.faces) + bytes(data_.normals)
         + bytes(data_.normal_corners) + bytes(data_.uv) + bytes(data_.uv_corners)
         + bytes(data_.textures) + bytes(hierarchy_.bvh.nodes());
}

namespace {

/// Has the face an area, as far as its edges can be told apart?
bool has_area(MeshData const& data, Corners const& face) {
  Vec3 const& a = data.vertices[face[0]];
  Vec3 const normal = glm::cross(data.vertices[face[1]] - a, data.vertices[face[2]] - a);
  return normal != Vec3(0) && finite(normal);
}

template <class T>
void keep(std::vector<T>& items, std::vector<bool> const& kept) {
  if (items.empty()) return;
  std::size_t to = 0;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (kept[i]) items[to++] = items[i];
  }
  items.resize(to);
}

} // namespace

MeshResult make_mesh(MeshData data) {
  MeshResult result;
  Vec3 low(infinity), high(-infinity);
  for (Corners const& face : data.faces) {
    for (std::uint32_t const corner : face) {
      low = glm::min(low, data.vertices[corner]);
      high = glm::max(high, data.vertices[corner]);
    }
  }
  result.degenerate = data.faces.size();
  if (data.faces.empty()) return result;
  Vec3 const extent = high * 0.5 - low * 0.5, middle = low * 0.5 + high * 0.5;
  double const largest = std::fmax(extent.x, std::fmax(extent.y, extent.z));
  if (!usable_size(largest)) return result;
  double const scale = std::exp2(std::ilogb(largest));
  for (Vec3& vertex : data.vertices) vertex = (vertex - middle) / scale;
  std::vector<bool> kept(data.faces.size());
  for (std::size_t i = 0; i < kept.size(); ++i) kept[i] = has_area(data, data.faces[i]);
  result.degenerate = static_cast<std::size_t>(std::count(kept.begin(), kept.end(), false));
  if (result.degenerate == kept.size()) return result;
  if (result.degenerate > 0) {
    keep(data.faces, kept);
    keep(data.normal_corners, kept);
    keep(data.uv_corners, kept);
    keep(data.textures, kept);
  }
  Transform const placement = Transform::scaling(Vec3(scale)).then(Transform::translation(middle));
  result.shape = PlacedShape{std::make_shared<Mesh>(std::move(data)), placement};
  return result;
}

} // namespace abbe::geometry
