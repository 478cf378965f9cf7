// SPDX-License-Identifier: MIT
#include "geometry/shapes/height_field.hpp"

#include "geometry/shapes/reading.hpp"
#include "geometry/shapes/start.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::geometry {

namespace {

/// Boxes are taken larger by this share of the size of all: more than the rounding of where a line
/// meets their sides, far less than a cell.
constexpr double box_slack = 0x1p-40;

} // namespace

/// The part of a line in the box: above the water, between the four sides.
struct HeightField::Box {
  Crossing in, out;
};

HeightBlocks::HeightBlocks(HeightGrid const& grid) {
  auto const blocks = [](int n, int size) { return (n + size - 1) / size; };
  Level level{blocks(grid.columns - 1, side), blocks(grid.rows - 1, side), {}};
  for (int bz = 0; bz < level.rows; ++bz) {
    for (int bx = 0; bx < level.columns; ++bx) {
      Range range{65535, 0};
      for (int j = bz * side; j <= std::min((bz + 1) * side, grid.rows - 1); ++j) {
        for (int i = bx * side; i <= std::min((bx + 1) * side, grid.columns - 1); ++i) {
          range.low = std::min(range.low, grid.at(i, j));
          range.high = std::max(range.high, grid.at(i, j));
        }
      }
      level.ranges.push_back(range);
    }
  }
  levels.push_back(std::move(level));
  while (levels.back().ranges.size() > 1) {
    Level const& finer = levels.back();
    Level next{blocks(finer.columns, 2), blocks(finer.rows, 2), {}};
    for (int bz = 0; bz < next.rows; ++bz) {
      for (int bx = 0; bx < next.columns; ++bx) {
        Range range{65535, 0};
        for (int z = 2 * bz; z < std::min(2 * bz + 2, finer.rows); ++z) {
          for (int x = 2 * bx; x < std::min(2 * bx + 2, finer.columns); ++x) {
            Range const& part = finer.ranges[static_cast<std::size_t>(z * finer.columns + x)];
            range.low = std::min(range.low, part.low);
            range.high = std::max(range.high, part.high);
          }
        }
        next.ranges.push_back(range);
      }
    }
    levels.push_back(std::move(next));
  }
}

double HeightField::unit_of(int columns, int rows) {
  return std::exp2(std::ilogb(std::max(columns, rows)) - 16);
}

HeightField::HeightField(HeightGrid grid, Form const& form)
    : grid_(std::make_shared<HeightGrid const>(std::move(grid))),
      blocks_(std::make_shared<HeightBlocks const>(*grid_)),
      form_(form),
      inverse_(1),
      unit_(unit_of(grid_->columns, grid_->rows)),
      middle_x_((grid_->columns - 1) * 0.5),
      middle_z_((grid_->rows - 1) * 0.5) {
  inverse_[0][0] = 2 * middle_x_;
  inverse_[1][1] = 65536 * unit_;
  inverse_[2][2] = 2 * middle_z_;
  find_bounds();
}

void HeightField::find_bounds() {
  // Without water all is seen, also what lies at height 0: the bottom is one code below.
  water_ = std::max((form_.water * 65536 - 32768) * unit_, -32769 * unit_);
  if (!(form_.water > 0)) water_ = -32769 * unit_;
  bottom_ = form_.deep ? -infinity : water_;
  top_ = y_of(blocks_->levels.back().ranges.front().high);
  bounds_ = {{-middle_x_, water_, -middle_z_}, {middle_x_, top_, middle_z_}, form_.deep};
  ball_ = vector_length(bounds_.high - bounds_.low) / 2 * (1 + gamma_bound(8));
}

std::shared_ptr<HeightField const> HeightField::deepened() const {
  auto deep = std::make_shared<HeightField>(*this);
  deep->form_.deep = true;
  deep->find_bounds();
  return deep;
}

std::shared_ptr<HeightField const> HeightField::placed(Mat3 const& inverse_linear) const {
  auto other = std::make_shared<HeightField>(*this);
  other->inverse_ = inverse_linear;
  return other;
}

void HeightField::half_spaces(std::vector<HalfSpace>& out) const {
  if (!form_.deep) return;
  for (double const side : {-1.0, 1.0}) {
    out.push_back({{side, 0, 0}, middle_x_});
    out.push_back({{0, 0, side}, middle_z_});
  }
  out.push_back({{0, 1, 0}, top_});
}

void HeightField::corners(std::uint32_t face, Vec3 (&corner)[3]) const {
  int const cell = static_cast<int>(face / 2);
  int const i = cell % (grid_->columns - 1), j = cell / (grid_->columns - 1);
  bool const upper = face % 2 != 0;
  corner[0] = upper ? vertex(i + 1, j + 1) : vertex(i, j);
  corner[1] = upper ? vertex(i + 1, j) : vertex(i, j + 1);
  corner[2] = upper ? vertex(i, j + 1) : vertex(i + 1, j);
}

/// A line on its way through the pyramid, from the nearest blocks on.
struct HeightField::Walk {
  static constexpr int side = HeightBlocks::side;
  HeightField const& field;
  ShearedLine const& line;
  double from, to; ///< counted from line.point
  double pad;      ///< of boxes, in cells
  Crossings& out;
  bool first_only = false;
  Vec3 inverse{0}, origin{0}, slack{0}; ///< of the line; the slack is that of boxes along it
  int near_x = 0, near_z = 0;           ///< which of two blocks comes first

  Walk(HeightField const& of, ShearedLine const& with, double begin, double end, Crossings& into)
      : field(of),
        line(with),
        from(begin),
        to(end),
        pad(box_slack * (of.grid_->columns + of.grid_->rows)),
        out(into),
        near_x(with.direction.x < 0 ? 1 : 0),
        near_z(with.direction.z < 0 ? 1 : 0) {
    // A line that stands still along an axis hardly moves there: one that is beside a box comes to
    // it nowhere that counts.
    for (int axis = 0; axis < 3; ++axis) {
      double const d = line.direction[axis];
      inverse[axis] = std::fabs(d) > 1e-300 ? 1 / d : std::copysign(1e300, d);
      slack[axis] = pad * std::fabs(inverse[axis]);
    }
    origin = line.point + Vec3(field.middle_x_, 0, field.middle_z_);
  }

  /// Narrows the part of the line to that between two values of a coordinate.
  void slab(int axis, double low, double high, double& begin, double& end) const {
    double const a = (low - origin[axis]) * inverse[axis],
                 b = (high - origin[axis]) * inverse[axis];
    begin = std::max(begin, std::min(a, b) - slack[axis]);
    end = std::min(end, std::max(a, b) + slack[axis]);
  }
  /// Can the line meet one of the two triangles of a cell? As hit_triangle() finds it, up to signs.
  bool may_hit(int i, int j) const {
    double x[4], y[4];
    for (int k = 0; k < 4; ++k) {
      Vec3 const v = field.vertex(i + (k & 1), j + (k >> 1)) - line.point;
      x[k] = v[line.kx] - line.sx * v[line.kz];
      y[k] = v[line.ky] - line.sy * v[line.kz];
    }
    auto const edge = [&](int a, int b) { return x[a] * y[b] - x[b] * y[a]; };
    auto const apart = [](double a, double b, double c) {
      return std::min(a, std::min(b, c)) < 0 && std::max(a, std::max(b, c)) > 0;
    };
    double const diagonal = edge(2, 1);
    return !apart(edge(0, 2), diagonal, edge(1, 0)) || !apart(edge(3, 1), -diagonal, edge(2, 3));
  }
  void cell(int i, int j) {
    if (!may_hit(i, j)) return;
    for (std::uint32_t half = 0; half < 2; ++half) {
      std::uint32_t const face =
          2 * static_cast<std::uint32_t>(j * (field.grid_->columns - 1) + i) + half;
      Vec3 corner[3];
      field.corners(face, corner);
      auto const hit = hit_triangle(line, corner[0], corner[1], corner[2]);
      if (!hit) continue;
      bool const wet =
          field.form_.deep && line.point.y + (hit->t - line.t) * line.direction.y < field.water_;
      out.push_back({hit->t, hit->error, hit->slack, face, hit->downward, true, !wet});
      // Beyond the first, only what is as near as its error.
      if (first_only && hit->t > 2 * (hit->error + hit->slack))
        to = std::min(to, hit->t - line.t + 16 * hit->error);
    }
  }
  /// The cells of a block of the smallest size that are along a part of the line.
  void leaf(int bx, int bz, double begin, double end) {
    int const columns = field.grid_->columns - 1, rows = field.grid_->rows - 1;
    int const low_x = bx * side, low_z = bz * side;
    double begin_x[side], end_x[side];
    int const count_x = std::min(side, columns - low_x), count_z = std::min(side, rows - low_z);
    for (int k = 0; k < count_x; ++k) {
      begin_x[k] = begin;
      end_x[k] = end;
      slab(0, low_x + k, low_x + k + 1, begin_x[k], end_x[k]);
    }
    for (int n = 0; n < count_z; ++n) {
      int const j = low_z + (near_z != 0 ? count_z - 1 - n : n);
      double begin_z = begin, end_z = end;
      slab(2, j, j + 1, begin_z, end_z);
      if (!(begin_z <= end_z)) continue;
      std::uint16_t const* const row =
          &field.grid_->heights[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns + 1)
                                + static_cast<std::size_t>(low_x)];
      for (int m = 0; m < count_x; ++m) {
        int const k = near_x != 0 ? count_x - 1 - m : m;
        double const a = std::max(begin_x[k], begin_z), b = std::min(end_x[k], end_z);
        if (!(a <= std::min(b, to))) continue;
        std::uint16_t const* const at = row + k;
        std::uint16_t const* const next = at + columns + 1;
        double const low = std::min(std::min(at[0], at[1]), std::min(next[0], next[1])),
                     high = std::max(std::max(at[0], at[1]), std::max(next[0], next[1]));
        double const ya = line.point.y + a * line.direction.y,
                     yb = line.point.y + b * line.direction.y;
        if (std::min(ya, yb) - pad > (high - 32768) * field.unit_
            || std::max(ya, yb) + pad < (low - 32768) * field.unit_)
          continue;
        cell(low_x + k, j);
      }
    }
  }
  void node(std::size_t depth, int bx, int bz) {
    HeightBlocks::Level const& level = field.blocks_->levels[depth];
    HeightBlocks::Range const range =
        level.ranges[static_cast<std::size_t>(bz * level.columns + bx)];
    double const size = side << depth;
    double begin = from, end = to;
    slab(0, bx * size, (bx + 1) * size, begin, end);
    slab(2, bz * size, (bz + 1) * size, begin, end);
    if (!(begin <= end)) return;
    slab(1, field.y_of(range.low), field.y_of(range.high), begin, end);
    if (!(begin <= end)) return;
    if (depth == 0) return leaf(bx, bz, begin, end);
    HeightBlocks::Level const& finer = field.blocks_->levels[depth - 1];
    for (int k = 0; k < 4; ++k) {
      int const cx = 2 * bx + ((k & 1) ^ near_x), cz = 2 * bz + ((k >> 1) ^ near_z);
      if (cx < finer.columns && cz < finer.rows) node(depth - 1, cx, cz);
    }
  }
  void run() { node(field.blocks_->levels.size() - 1, 0, 0); }
};

bool HeightField::box_of(Ray const& ray, Box& box) const {
  box.in.t = -infinity;
  box.out.t = infinity;
  box.in.entering = true;
  box.in.visible = box.out.visible = false;
  // Nothing is inside at its upper side.
  Vec3 const low(-middle_x_, bottom_, -middle_z_), high(middle_x_, top_ + 1, middle_z_);
  for (int axis = 0; axis < 3; ++axis) {
    double const o = ray.origin[axis], d = ray.direction[axis];
    if (d == 0) {
      if (o < low[axis] || o > high[axis]) return false;
      continue;
    }
    for (int upper = 0; upper < 2; ++upper) {
      double const side = upper != 0 ? high[axis] : low[axis];
      Crossing c;
      c.t = (side - o) / d;
      c.error = (ray.origin_rounding[axis] + std::fabs(c.t) * ray.direction_rounding[axis]
                 + gamma_bound(4) * (std::fabs(side) + std::fabs(o)))
                    / std::fabs(d)
                + gamma_bound(2) * std::fabs(c.t);
      c.slack = ray.origin_error[axis] / std::fabs(d);
      c.face = 2 * cells() + static_cast<std::uint32_t>(axis == 1 ? 4 : axis + upper);
      c.visible = false;
      c.entering = (upper == 0) == (d > 0);
      if (c.entering && c.t > box.in.t) box.in = c;
      if (!c.entering && c.t < box.out.t) box.out = c;
    }
  }
  return box.in.t < box.out.t;
}

void HeightField::finish(Ray const& ray, Box const& box, std::size_t first, Crossings& out) const {
  auto const begin = out.begin() + static_cast<std::ptrdiff_t>(first);
  std::sort(begin, out.end(), [](Crossing const& a, Crossing const& b) {
    return a.t != b.t ? a.t < b.t : a.face < b.face;
  });
  std::size_t const count = out.size() - first;
  bool alternate = true;
  for (std::size_t i = 1; i < count; ++i)
    alternate = alternate && out[first + i].entering != out[first + i - 1].entering;
  bool inside_first = count > 0 && !out[first].entering;
  if (count == 0 || !alternate) {
    // By the widest part between two hits, or a hit and the box.
    double widest = -infinity, middle = 0;
    bool odd = false;
    constexpr double far = 1e300;
    double last = std::max(box.in.t, -far);
    for (std::size_t i = 0; i <= count; ++i) {
      double const next = i < count ? out[first + i].t : std::min(box.out.t, far);
      if (next - last > widest) {
        widest = next - last;
        middle = last * 0.5 + next * 0.5;
        odd = i % 2 != 0;
      }
      last = next;
    }
    inside_first = below(ray.origin + middle * ray.direction) != odd;
  }
  for (std::size_t i = 0; i < count; ++i) out[first + i].entering = (i % 2 == 0) != inside_first;
  bool const inside_last = inside_first != (count % 2 != 0);
  if (inside_first) out.insert(out.begin() + static_cast<std::ptrdiff_t>(first), box.in);
  if (inside_last) out.push_back(box.out);
  std::size_t to = first;
  for (std::size_t i = first; i + 1 < out.size(); i += 2) {
    Crossing const a = out[i].t < box.in.t ? box.in : out[i];
    Crossing const b = out[i + 1].t > box.out.t ? box.out : out[i + 1];
    if (!(a.t < b.t)) continue;
    if (a.t > -infinity) out[to++] = a;
    if (b.t < infinity) out[to++] = b;
  }
  out.resize(to);
}

void HeightField::crossings(Ray const& ray, Start const* start, Crossings& out) const {
  std::size_t const first = out.size();
  Box box;
  if (box_of(ray, box)) {
    ShearedLine const line(line_of(ray));
    double const off = box_slack * (std::fabs(line.t) + std::fabs(box.in.t) + std::fabs(box.out.t));
    Walk walk(*this, line, -infinity, infinity, out);
    if (off < infinity) {
      walk.from = box.in.t - line.t - off;
      walk.to = box.out.t - line.t + off;
    }
    walk.run();
    finish(ray, box, first, out);
  }
  if (start != nullptr) impose_start(*start, false, first, out);
}

void HeightField::crossings_ahead(Ray const& ray, Start const* start, double until,
                                  Crossings& out) const {
  if (start != nullptr && (start->to_inside || start->face >= 2 * cells()))
    return crossings(ray, start, out);
  Box box;
  if (!box_of(ray, box)) return crossings(ray, start, out);
  if (box.out.t < 0 && start == nullptr) return;
  std::size_t const first = out.size();
  ShearedLine const line(line_of(ray));
  double before = 0; // where the root of the start may be
  if (start != nullptr) {
    Vec3 corner[3];
    corners(start->face, corner);
    Vec3 const across = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
    before = 4 * glm::dot(glm::abs(across), line.slack + line.rounding)
             / std::fabs(glm::dot(across, line.direction));
  }
  double const begin = std::max(box.in.t, -before), end = std::min(box.out.t, until);
  double const off = box_slack * (std::fabs(line.t) + std::fabs(begin) + std::fabs(end));
  if (!(off < infinity)) return crossings(ray, start, out);
  Walk walk(*this, line, begin - line.t - off, end - line.t + off, out);
  walk.first_only = true;
  walk.run();
  auto const anew = [&] {
    out.resize(first);
    crossings(ray, start, out);
  };
  std::sort(out.begin() + static_cast<std::ptrdiff_t>(first), out.end(),
            [](Crossing const& a, Crossing const& b) { return a.t < b.t; });
  std::size_t next = first;
  if (start != nullptr) {
    // The root of the start is the first, and none is beside it.
    auto const near = [&](std::size_t k) {
      return k < out.size() && out[k].t <= 2 * (out[k].error + out[k].slack);
    };
    if (!near(first) || near(first + 1) || out[first].face != start->face || out[first].entering)
      return anew();
    out[first].t = 0;
    ++next;
  }
  if (out.size() == next) {
    double const middle = std::max(begin, 0.0) * 0.5 + end * 0.5;
    if (start == nullptr && below(ray.origin + middle * ray.direction)) anew();
    return;
  }
  // The first, where it is clear of the box, the start and the next; else all is seen as a whole.
  Crossing const& hit = out[next];
  bool const clear =
      hit.t - hit.error > std::max(begin, 0.0) + off && hit.t + hit.error < end - off
      && (out.size() == next + 1 || hit.t + hit.error < out[next + 1].t - out[next + 1].error);
  bool const from_side = !hit.entering && (start != nullptr || box.in.t > -box.in.error);
  if (!clear || from_side) return anew();
  out.resize(next + 1);
}

bool HeightField::below(Vec3 const& point) const {
  double const x = point.x + middle_x_, z = point.z + middle_z_;
  int const i = static_cast<int>(std::clamp(std::floor(x), 0.0, grid_->columns - 2.0)),
            j = static_cast<int>(std::clamp(std::floor(z), 0.0, grid_->rows - 2.0));
  double const u = x - i, v = z - j;
  bool const upper = u + v > 1;
  double const corner = y_of(upper ? grid_->at(i + 1, j + 1) : grid_->at(i, j));
  double const along_x = y_of(upper ? grid_->at(i, j + 1) : grid_->at(i + 1, j)) - corner,
               along_z = y_of(upper ? grid_->at(i + 1, j) : grid_->at(i, j + 1)) - corner;
  return point.y <= corner + along_x * (upper ? 1 - u : u) + along_z * (upper ? 1 - v : v);
}

bool HeightField::inside(Vec3 const& point) const {
  return std::fabs(point.x) <= middle_x_ && std::fabs(point.z) <= middle_z_ && point.y >= bottom_
         && below(point);
}

Vec3 HeightField::geometric_normal(Vec3 const&, std::uint32_t face) const {
  std::uint32_t const wall = face - 2 * cells();
  if (face >= 2 * cells()) {
    if (wall == 4) return {0, -1, 0};
    double const side = wall % 2 == 0 ? -1 : 1;
    return wall < 2 ? Vec3(side, 0, 0) : Vec3(0, 0, side);
  }
  Vec3 corner[3];
  corners(face, corner);
  return unit_vector(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
}

/// A corner's normal is, as POV-Ray has it, the mean of the directions of the four triangles that a
/// point forms with its neighbours along x and z, in units of cells and of 1/65536 of the height,
/// kept in 16 bits; then in canonical form, of unit length where the field is placed.
Vec3 HeightField::vertex_normal(int i, int j) const {
  int const here = grid_->at(i, j);
  Vec3 sum(0);
  for (int const sx : {-1, 1}) {
    if (i + sx < 0 || i + sx >= grid_->columns) continue;
    double const rise_x = sx * (grid_->at(i + sx, j) - here);
    for (int const sz : {-1, 1}) {
      if (j + sz < 0 || j + sz >= grid_->rows) continue;
      Vec3 const across(-rise_x, 1, -sz * (grid_->at(i, j + sz) - here));
      sum += across / std::sqrt(glm::dot(across, across));
    }
  }
  Vec3 const kept = glm::trunc(sum / std::sqrt(glm::dot(sum, sum)) * 32767.0);
  Vec3 const normal(kept.x * unit_, kept.y, kept.z * unit_);
  double const length = vector_length(glm::transpose(inverse_) * normal);
  return length > 0 && std::isfinite(length) ? normal / length : normal;
}

Vec3 HeightField::normal(Vec3 const& point, std::uint32_t face) const {
  if (!form_.smooth || face >= 2 * cells()) return geometric_normal(point, face);
  int const cell = static_cast<int>(face / 2);
  int const i = cell % (grid_->columns - 1), j = cell / (grid_->columns - 1);
  double const u = std::clamp(point.x + middle_x_ - i, 0.0, 1.0),
               v = std::clamp(point.z + middle_z_ - j, 0.0, 1.0);
  Vec3 const sum = (1 - v) * ((1 - u) * vertex_normal(i, j) + u * vertex_normal(i + 1, j))
                   + v * ((1 - u) * vertex_normal(i, j + 1) + u * vertex_normal(i + 1, j + 1));
  if (sum == Vec3(0) || !finite(sum)) return geometric_normal(point, face);
  return unit_vector(sum);
}

std::optional<Vec2> HeightField::uv(Vec3 const& point, std::uint32_t) const {
  return Vec2(point.x / (2 * middle_x_) + 0.5, point.y / (65536 * unit_) + 0.5);
}

std::optional<PlacedShape> make_height_field(HeightGrid grid, bool smooth, double water) {
  std::uint16_t const top = *std::max_element(grid.heights.begin(), grid.heights.end());
  if (!(water < top / 65536.0)) return std::nullopt;
  double const wide = grid.columns - 1, deep = grid.rows - 1;
  double const tall = 65536 * HeightField::unit_of(grid.columns, grid.rows);
  Transform const placement =
      Transform::scaling({1 / wide, 1 / tall, 1 / deep}).then(Transform::translation(Vec3(0.5)));
  return PlacedShape{
      std::make_shared<HeightField>(std::move(grid), HeightField::Form{smooth, false, water}),
      placement};
}

} // namespace abbe::geometry
