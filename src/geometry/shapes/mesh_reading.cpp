// SPDX-License-Identifier: MIT
#include "geometry/shapes/mesh_reading.hpp"

#include "geometry/line.hpp"
#include "geometry/shapes/mesh.hpp"
#include "geometry/shapes/reading.hpp"

#include <cstring>
#include <limits>
#include <string>
#include <unordered_map>

namespace abbe::geometry {

namespace {

constexpr int most = std::numeric_limits<int>::max();

/// The shape, or what was wrong with it.
std::optional<PlacedShape> finish(MeshData data, Parameters& parameters) {
  std::size_t const faces = data.faces.size();
  MeshResult result = make_mesh(std::move(data));
  if (result.degenerate > 0) {
    parameters.report(Severity::Warning, "E0610",
                      faces == 1
                          ? std::string("a triangle without area is not drawn")
                          : std::to_string(result.degenerate) + " of " + std::to_string(faces)
                                + " triangles have no area and are not drawn");
  }
  return std::move(result.shape);
}

/// Collects the triangles of `mesh`; equal corners become one.
class MeshCollector {
public:
  explicit MeshCollector(Parameters& parameters) : in_(parameters) {}

  /// Inside the block of a triangle.
  void triangle(bool smooth) {
    Vec3 corner[3]{}, normal[3]{}; // GLM leaves them undefined otherwise
    bool good = true;
    for (int i = 0; i < 3; ++i) {
      corner[i] = in_.vec3("corner");
      if (smooth) normal[i] = in_.vec3("normal");
      good = good && finite(corner[i]) && finite(normal[i]);
    }
    if (!good) {
      in_.report(Severity::Error, "E0611", "a triangle needs finite corners and normals");
      return;
    }
    Corners face{}, normals{MeshData::flat, MeshData::flat, MeshData::flat};
    for (std::size_t i = 0; i < 3; ++i) {
      face[i] = number_of(corner[i]);
      if (!smooth) continue;
      normals[i] = static_cast<std::uint32_t>(data_.normals.size());
      data_.normals.push_back(unit_or_zero(normal[i]));
    }
    data_.faces.push_back(face);
    data_.normal_corners.push_back(normals);
  }
  /// What may follow the corners inside a mesh.
  void extras() {
    Corners uv{MeshData::flat, MeshData::flat, MeshData::flat};
    if (in_.accept("uv_vectors")) {
      for (std::uint32_t& corner : uv) {
        corner = static_cast<std::uint32_t>(data_.uv.size());
        data_.uv.push_back(in_.vec2("uv vector"));
      }
    }
    std::array<std::int32_t, 3> textures{-1, -1, -1};
    if (in_.open("texture_list")) {
      for (std::int32_t& texture : textures) texture = in_.face_texture();
      in_.close();
    } else if (int const texture = in_.face_texture(); texture >= 0) {
      textures = {texture, texture, texture};
    }
    textured_ = textured_ || textures[0] >= 0;
    if (uvs_.size() == data_.faces.size()) return; // the triangle was refused
    uvs_.push_back(uv);
    textures_.push_back(textures);
  }
  bool empty() const { return data_.faces.empty(); }
  /// Do the normals of the first triangle all look to one of its sides?
  bool normals_agree() const {
    Corners const& face = data_.faces.front();
    Vec3 const a = data_.vertices[face[0]];
    Vec3 const across = glm::cross(data_.vertices[face[1]] - a, data_.vertices[face[2]] - a);
    double low = infinity, high = -infinity;
    for (Vec3 const& normal : data_.normals) {
      low = std::fmin(low, glm::dot(normal, across));
      high = std::fmax(high, glm::dot(normal, across));
    }
    return low > 0 || high < 0 || across == Vec3(0);
  }
  MeshData take() {
    if (data_.normals.empty()) data_.normal_corners.clear();
    if (!data_.uv.empty()) data_.uv_corners = std::move(uvs_);
    if (textured_) data_.textures = std::move(textures_);
    return std::move(data_);
  }
  void inside(Vec3 const& direction) { data_.inside_vector = direction; }

private:
  static Vec3 unit_or_zero(Vec3 const& v) { return v == Vec3(0) ? v : unit_vector(v); }
  struct Hash {
    std::size_t operator()(Vec3 const& v) const {
      std::uint64_t bits[3];
      Vec3 const positive = v + 0.0; // -0 and 0 are equal
      std::memcpy(bits, &positive, sizeof bits);
      std::uint64_t h = 0;
      for (std::uint64_t const b : bits) h = (h ^ b ^ (b >> 29)) * 0x9e3779b97f4a7c15ULL;
      return h ^ (h >> 32);
    }
  };
  std::uint32_t number_of(Vec3 const& corner) {
    auto const next = static_cast<std::uint32_t>(data_.vertices.size());
    auto const [at, added] = numbers_.try_emplace(corner, next);
    if (added) data_.vertices.push_back(corner);
    return at->second;
  }

  Parameters& in_;
  MeshData data_;
  std::vector<Corners> uvs_;
  std::vector<std::array<std::int32_t, 3>> textures_;
  bool textured_ = false;
  std::unordered_map<Vec3, std::uint32_t, Hash> numbers_;
};

std::optional<PlacedShape> read_single(Parameters& parameters, bool smooth) {
  MeshCollector collector(parameters);
  collector.triangle(smooth);
  if (smooth && !collector.empty() && !collector.normals_agree())
    return left_out(parameters, "E0610",
                    "a smooth_triangle whose normals are not on one side of it is not drawn");
  MeshData data = collector.take();
  if (data.faces.empty()) return std::nullopt; // reported
  data.lone = true;
  return finish(std::move(data), parameters);
}

std::optional<Vec3> read_inside_vector(Parameters& parameters) {
  Vec3 const direction = parameters.vec3("inside vector");
  if (finite(direction) && direction != Vec3(0)) return unit_vector(direction);
  parameters.report(Severity::Warning, "E0614", "inside_vector is zero: the mesh has no inside");
  return std::nullopt;
}

} // namespace

std::optional<PlacedShape> read_triangle(Parameters& parameters) {
  return read_single(parameters, false);
}
std::optional<PlacedShape> read_smooth_triangle(Parameters& parameters) {
  return read_single(parameters, true);
}

std::optional<PlacedShape> read_mesh(Parameters& parameters) {
  MeshCollector collector(parameters);
  std::optional<Vec3> inside_vector;
  for (;;) {
    bool const flat = parameters.open("triangle");
    if (flat || parameters.open("smooth_triangle")) {
      collector.triangle(!flat);
      collector.extras();
      parameters.close();
    } else if (parameters.accept("inside_vector")) {
      inside_vector = read_inside_vector(parameters);
    } else {
      break;
    }
  }
  MeshData data = collector.take();
  data.inside_vector = inside_vector;
  if (data.faces.empty()) {
    parameters.report(Severity::Error, "E0615", "a mesh needs at least one triangle");
    return std::nullopt;
  }
  return finish(std::move(data), parameters);
}

namespace {

/// Reads the blocks of mesh2.
class Mesh2Reader {
public:
  explicit Mesh2Reader(Parameters& parameters) : in_(parameters) {}

  bool block() {
    if (in_.open("vertex_vectors")) {
      vectors(data_.vertices, "vertex");
    } else if (in_.open("normal_vectors")) {
      vectors(data_.normals, "normal");
    } else if (in_.open("uv_vectors")) {
      int const count = in_.integer("number of uv vectors", 0, most);
      for (int i = 0; i < count && in_.has_value(); ++i) data_.uv.push_back(in_.vec2("uv vector"));
      check_count(count, data_.uv.size());
    } else if (in_.open("texture_list")) {
      int const count = in_.integer("number of textures", 0, most);
      for (int i = 0; i < count && !in_.at_end(); ++i) list_.push_back(in_.face_texture());
      check_count(count, list_.size());
    } else if (in_.open("face_indices")) {
      faces();
    } else if (in_.open("uv_indices")) {
      indices(data_.uv_corners, data_.uv.size());
    } else if (in_.open("normal_indices")) {
      indices(data_.normal_corners, data_.normals.size());
    } else if (in_.accept("inside_vector")) {
      data_.inside_vector = read_inside_vector(in_);
      return true;
    } else {
      return false;
    }
    in_.close();
    return true;
  }

  std::optional<MeshData> take() {
    std::size_t const faces = data_.faces.size();
    if (faces == 0) fail("E0615", "mesh2 needs vertex_vectors and face_indices");
    own_indices("uv", data_.uv.size(), data_.uv_corners.size());
    own_indices("normal", data_.normals.size(), data_.normal_corners.size());
    for (Vec3 const& v : data_.vertices) {
      if (!finite(v)) return fail("E0611", "a vertex is not finite"), std::nullopt;
    }
    if (failed_) return std::nullopt;
    return std::move(data_);
  }

private:
  void fail(std::string_view code, std::string const& message) {
    if (!failed_) in_.report(Severity::Error, code, message);
    failed_ = true;
  }
  void check_count(int told, std::size_t given) {
    if (static_cast<std::size_t>(told) == given) return;
    fail("E0613", std::to_string(told) + " entries announced, " + std::to_string(given) + " given");
  }
  void vectors(std::vector<Vec3>& to, std::string_view name) {
    int const count = in_.integer("number of vectors", 0, most);
    each_vector(count, name, to, [](Vec3 const& v) { return v; });
    check_count(count, to.size());
  }
  /// Appends what `made` makes of each of the next vectors, `count` at most.
  template <class T, class Made>
  void each_vector(int count, std::string_view name, std::vector<T>& to, Made&& made) {
    auto left = static_cast<std::size_t>(count);
    while (left > 0) {
      auto const run = in_.literal_vectors(3, left);
      if (run.empty()) {
        if (!in_.has_value()) return;
        to.push_back(made(in_.vec3(name)));
        --left;
        continue;
      }
      std::size_t const vectors = run.size() / 3;
      if (to.capacity() - to.size() < vectors) to.reserve(to.size() + vectors);
      for (std::size_t i = 0; i < run.size(); i += 3)
        to.push_back(made(Vec3(run[i], run[i + 1], run[i + 2])));
      left -= vectors;
    }
  }
  Corners corners(Vec3 const& v, std::size_t limit) {
    Corners result{};
    for (int i = 0; i < 3; ++i) {
      bool const good = v[i] >= 0 && v[i] < static_cast<double>(limit);
      if (!good) {
        fail("E0612", "an index is not in 0 ... " + std::to_string(limit) + " - 1");
      } else {
        result[static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(v[i]);
      }
    }
    return result;
  }
  std::int32_t texture() {
    int const number = in_.integer("texture index", 0, most);
    if (static_cast<std::size_t>(number) < list_.size()) {
      return list_[static_cast<std::size_t>(number)];
    }
    fail("E0612", "a texture index is not in 0 ... " + std::to_string(list_.size()) + " - 1");
    return -1;
  }
  void faces() {
    int const count = in_.integer("number of faces", 0, most);
    if (list_.empty()) {
      read_corners(count, data_.faces, data_.vertices.size());
      return;
    }
    for (int i = 0; i < count && in_.has_value(); ++i) {
      data_.faces.push_back(corners(in_.vec3("indices"), data_.vertices.size()));
      std::array<std::int32_t, 3> textures{-1, -1, -1};
      if (in_.has_number()) {
        textures[0] = texture();
        textures[1] = textures[2] = textures[0];
        if (in_.has_number()) {
          textures[1] = texture();
          textures[2] = texture();
        }
      }
      data_.textures.push_back(textures);
    }
    check_count(count, data_.faces.size());
  }
  void indices(std::vector<Corners>& to, std::size_t limit) {
    read_corners(in_.integer("number of faces", 0, most), to, limit);
  }
  void read_corners(int count, std::vector<Corners>& to, std::size_t limit) {
    each_vector(count, "indices", to, [&](Vec3 const& v) { return corners(v, limit); });
    check_count(count, to.size());
  }
  /// Without indices, the face's own must fit.
  void own_indices(std::string const& name, std::size_t vectors, std::size_t given) {
    if (vectors == 0 || given == data_.faces.size()) return;
    if (given == 0 && vectors == data_.vertices.size()) return;
    fail("E0613", name + "_indices are needed for each face, as there are not as many " + name
                      + " vectors as vertices");
  }

  Parameters& in_;
  MeshData data_;
  std::vector<std::int32_t> list_;
  bool failed_ = false;
};

} // namespace

std::optional<PlacedShape> read_mesh2(Parameters& parameters) {
  Mesh2Reader reader(parameters);
  while (reader.block()) {
  }
  std::optional<MeshData> data = reader.take();
  if (!data) return std::nullopt;
  return finish(std::move(*data), parameters);
}

} // namespace abbe::geometry
