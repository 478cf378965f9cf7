// SPDX-License-Identifier: MIT
#include "geometry/shapes/bicubic_patch.hpp"

#include "geometry/shapes/mesh.hpp"
#include "geometry/shapes/reading.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace abbe::geometry {

namespace {

using Net = BicubicPatch::Net;

constexpr int most_steps = 10;

/// A piece of the surface, and where it lies in the unit square.
struct Piece {
  Net net;
  Vec2 low{0}, high{1};
  int u_left, v_left; ///< halvings
};

Net turned(Net const& net) {
  Net out;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) out[j][i] = net[i][j];
  return out;
}
/// Both halves, by de Casteljau. @param rows halve the number of the rows
std::pair<Net, Net> halves(Net const& given, bool rows) {
  Net const net = rows ? turned(given) : given;
  Net low, high;
  auto const middle = [](Vec3 const& a, Vec3 const& b) { return a * 0.5 + b * 0.5; };
  for (std::size_t i = 0; i < 4; ++i) {
    auto const& [a, b, c, d] = net[i];
    Vec3 const ab = middle(a, b), bc = middle(b, c), cd = middle(c, d);
    Vec3 const abc = middle(ab, bc), bcd = middle(bc, cd), m = middle(abc, bcd);
    low[i] = {a, ab, abc, m};
    high[i] = {m, bcd, cd, d};
  }
  return rows ? std::pair(turned(low), turned(high)) : std::pair(low, high);
}

/// All points within `most` of the plane through three corners.
bool is_flat(Net const& net, double most) {
  Vec3 const across = glm::cross(net[0][3] - net[0][0], net[3][0] - net[0][0]);
  double const size = vector_length(across);
  if (size == 0) return false;
  for (auto const& row : net)
    for (Vec3 const& point : row)
      if (!(std::fabs(glm::dot(point - net[0][0], across / size)) < most)) return false;
  return true;
}

/// The normal at a corner, along rows x across rows. Where points of the net fall together, by the
/// next ones; zero when there are none.
Vec3 corner_normal(Net const& net, bool last_row, bool last_column) {
  auto const at = [&](std::size_t i, std::size_t j) {
    return net[last_row ? 3 - i : i][last_column ? 3 - j : j];
  };
  Vec3 const corner = at(0, 0);
  auto const direction = [&](auto const& point) {
    for (std::size_t k = 1; k < 4; ++k)
      if (point(k) != corner) return point(k) - corner;
    return Vec3(0);
  };
  Vec3 along = direction([&](std::size_t k) { return at(0, k); });
  Vec3 across = direction([&](std::size_t k) { return at(k, 0); });
  // A side in one point: its direction is that of the row, or column, beside it.
  if (along == Vec3(0)) along = at(1, 3) - at(1, 0);
  if (across == Vec3(0)) across = at(3, 1) - at(0, 1);
  Vec3 const normal = glm::cross(along, across);
  if (normal == Vec3(0) || !finite(normal)) return Vec3(0);
  return unit_vector(last_row != last_column ? -normal : normal);
}

class Builder {
public:
  explicit Builder(BicubicPatch const& patch) : patch_(patch) {}

  void add(Piece const& piece) {
    bool const u = piece.u_left > 0, v = piece.v_left > 0;
    if ((!u && !v) || (patch_.flatness > 0 && is_flat(piece.net, patch_.flatness)))
      return leaf(piece);
    if (!u) return halve(piece, false, [&](Piece const& part) { add(part); });
    halve(piece, true, [&](Piece const& part) {
      if (!v) return add(part);
      halve(part, false, [&](Piece const& quarter) { add(quarter); });
    });
  }
  MeshData data;

private:
  template <class Take>
  static void halve(Piece const& piece, bool rows, Take const& take) {
    auto const [low, high] = halves(piece.net, rows);
    int const axis = rows ? 1 : 0;
    Piece a = piece, b = piece;
    a.net = low;
    b.net = high;
    a.high[axis] = b.low[axis] = piece.low[axis] * 0.5 + piece.high[axis] * 0.5;
    --(rows ? a.u_left : a.v_left);
    --(rows ? b.u_left : b.v_left);
    take(a);
    take(b);
  }
  std::uint32_t corner(Piece const& piece, bool last_row, bool last_column) {
    auto const number = static_cast<std::uint32_t>(data.vertices.size());
    data.vertices.push_back(piece.net[last_row ? 3 : 0][last_column ? 3 : 0]);
    data.normals.push_back(corner_normal(piece.net, last_row, last_column));
    double const u = last_column ? piece.high.x : piece.low.x,
                 v = last_row ? piece.high.y : piece.low.y;
    auto const& uv = patch_.uv;
    data.uv.push_back((1 - v) * ((1 - u) * uv[0] + u * uv[1]) + v * ((1 - u) * uv[3] + u * uv[2]));
    return number;
  }
  void leaf(Piece const& piece) {
    std::uint32_t const a = corner(piece, false, false), b = corner(piece, false, true),
                        c = corner(piece, true, true), d = corner(piece, true, false);
    data.faces.push_back({a, b, c});
    data.faces.push_back({a, c, d});
  }

  BicubicPatch const& patch_;
};

} // namespace

std::optional<PlacedShape> make_bicubic_patch(BicubicPatch const& patch) {
  for (auto const& row : patch.points)
    for (Vec3 const& point : row)
      if (!finite(point)) return std::nullopt;
  Builder builder(patch);
  builder.add({patch.points, Vec2(0), Vec2(1), patch.u_steps, patch.v_steps});
  return make_mesh(std::move(builder.data)).shape;
}

std::optional<PlacedShape> read_bicubic_patch(Parameters& parameters) {
  BicubicPatch patch;
  bool typed = false;
  for (;;) {
    if (parameters.accept("type")) {
      (void)parameters.integer("type of a bicubic_patch", 0, 1);
      typed = true;
    } else if (parameters.accept("flatness")) {
      patch.flatness = parameters.number("flatness");
    } else if (parameters.accept("u_steps")) {
      patch.u_steps = parameters.integer("u_steps", 0, most_steps);
    } else if (parameters.accept("v_steps")) {
      patch.v_steps = parameters.integer("v_steps", 0, most_steps);
    } else if (parameters.accept("accuracy")) {
      (void)parameters.number("accuracy");
    } else if (parameters.accept("uv_vectors")) {
      for (Vec2& uv : patch.uv) uv = parameters.vec2("uv vector");
    } else {
      break;
    }
  }
  if (!typed) {
    parameters.report(Severity::Error, "E0635", "a bicubic_patch begins with its type, 0 or 1");
    return std::nullopt;
  }
  for (auto& row : patch.points) {
    for (Vec3& point : row) {
      if (&point != &patch.points[0][0] && !parameters.has_value()) {
        parameters.report(Severity::Error, "E0616", "a bicubic_patch has sixteen points");
        return std::nullopt;
      }
      point = parameters.vec3("point");
    }
  }
  auto const first = patch.points[0][0];
  bool const one = std::all_of(patch.points.begin(), patch.points.end(), [&](auto const& row) {
    return std::all_of(row.begin(), row.end(), [&](Vec3 const& p) { return p == first; });
  });
  auto shape = one ? std::nullopt : make_bicubic_patch(patch);
  if (!shape)
    return left_out(parameters, "E0635",
                    "a bicubic_patch without an area, or with numbers out of range, is not drawn");
  return shape;
}

} // namespace abbe::geometry
