// SPDX-License-Identifier: MIT
#include "transport/shadows.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

/// Shadows of area lights: POV-Ray's recursion. Of a quarter of the grid whose corners differ, or
/// that is larger than `adaptive` asks for, its quarters are looked at; the mean of the corners
/// counts, so places weigh differently.
namespace abbe::transport {

void AreaPoints::add(Chunk const& chunk, std::size_t number, Lamp const& lamp, Aim const& aim,
                     RaySet lit) {
  Values strength;
  bool const weakens = lamp.strengths(aim, lit, chunk.count, strength.value);
  each_of(lit, [&](std::size_t r) {
    points.push_back({chunk.jitter[chunk.sample[r]].child(number),
                      chunk.geometric.get(r),
                      {chunk.start_of(r, false), chunk.start_of(r, true)},
                      {chunk.before[r], chunk.after[r]},
                      lamp.area()->axes(aim.direction.get(r))});
    for (std::size_t k = r * chunk.each; k < (r + 1) * chunk.each; ++k)
      full.push_back(lamp.value()[chunk.channels[k]] * (weakens ? strength[r] : 1));
  });
}

namespace {

/// Ways that are traced together, about.
constexpr std::size_t most_ways = std::size_t{1} << 14;
/// Corners differ by more than that: sum over r, g and b.
constexpr double differing = 0.1;
/// What is known of a place: 0, nothing.
constexpr std::uint8_t asked_for = 1, known = 2;

/// The places of one point.
class Quarters {
public:
  /// @param seen a byte a place, as above @param light of places, lanes a place
  Quarters(Stage const& stage, LightKind const& kind, Area const& area, std::uint8_t* seen,
           double const* light, double* sum)
      : stage_(stage), kind_(kind), area_(area), seen_(seen), light_(light), sum_(sum) {}

  /// Adds the whole grid's mean to `sum`. @param ask is told of places that are not seen yet
  /// @return false: there are some, so the sum has no meaning
  template <class Ask>
  bool add(Ask const& ask) {
    auto const& grid = area_.grid();
    whole_ = true;
    visit(0, 0, grid.size1 - 1, grid.size2 - 1, 0, 1, ask);
    return whole_;
  }

private:
  template <class Ask>
  void visit(int u1, int v1, int u2, int v2, int level, double weight, Ask const& ask) {
    std::size_t const corners[] = {area_.place(u1, v1), area_.place(u2, v1), area_.place(u2, v2),
                                   area_.place(u1, v2)};
    bool seen = true;
    for (std::size_t const corner : corners)
      if (seen_[corner] != known) {
        seen = false;
        if (std::exchange(seen_[corner], asked_for) != asked_for) ask(corner);
      }
    whole_ = whole_ && seen;
    bool const parts = u2 - u1 > 1 || v2 - v1 > 1;
    bool const asked = parts && level < area_.grid().adaptive;
    if (!asked && !seen) return;
    if (!asked && !(parts && differ(corners))) {
      std::size_t const n = kind_.size();
      for (std::size_t const corner : corners)
        for (std::size_t k = 0; k < n; ++k) sum_[k] += weight / 4 * light_[corner * n + k];
      return;
    }
    int const u_low = (u1 + u2) / 2, u_high = (u1 + u2 + 1) / 2;
    int const v_low = (v1 + v2) / 2, v_high = (v1 + v2 + 1) / 2;
    visit(u1, v1, u_low, v_low, level + 1, weight / 4, ask);
    visit(u_high, v1, u2, v_low, level + 1, weight / 4, ask);
    visit(u1, v_high, u_low, v2, level + 1, weight / 4, ask);
    visit(u_high, v_high, u2, v2, level + 1, weight / 4, ask);
  }

  /// @param corners each beside the next
  bool differ(std::size_t const (&corners)[4]) const {
    for (int i = 0; i < 4; ++i)
      if (difference(corners[i], corners[(i + 1) % 4]) > differing) return true;
    return false;
  }
  double difference(std::size_t a, std::size_t b) const {
    std::size_t const n = kind_.size();
    double const *const first = light_ + a * n, *const second = light_ + b * n;
    if (!kind_.in_order()) {
      double sum = 0;
      for (std::size_t k = 0; k < n; ++k) sum += std::abs(first[k] - second[k]);
      return 3 * sum / static_cast<double>(n);
    }
    Vec3 sum(0);
    for (std::size_t k = 0; k < n; ++k) sum += (first[k] - second[k]) * stage_.rgb_weights[k];
    return std::abs(sum.x) + std::abs(sum.y) + std::abs(sum.z);
  }

  Stage const& stage_;
  LightKind const& kind_;
  Area const& area_;
  std::uint8_t* seen_;
  double const* light_;
  double* sum_;
  bool whole_ = true;
};

} // namespace

std::uint64_t Shadows::finish(AreaPoints& points, Lamp const& lamp, std::uint8_t opaque,
                              geometry::Groups const& groups) {
  std::uint64_t looked_at = 0;
  Rays &rays = points.rays, &ways = points.ways;
  std::size_t const n = rays.kind().size(), places = lamp.area()->places();
  std::size_t const block = std::max<std::size_t>(1, most_ways / places);
  for (std::size_t first = 0; first < rays.count(); first += block) {
    std::size_t const count = std::min(block, rays.count() - first);
    points.seen.assign(count * places * n, 0);
    points.sums.assign(count * n, 0);
    points.known.assign(count * places, 0);
    points.whole.assign(count, 0);
    do {
      ways.clear();
      for (std::size_t i = 0; i < count; ++i) {
        if (points.whole[i] != 0 || !(rays.rest[first + i] > 0)) continue;
        std::fill_n(points.sums.data() + i * n, n, 0.0);
        Quarters quarters(stage_, rays.kind(), *lamp.area(), points.known.data() + i * places,
                          points.seen.data() + i * places * n, points.sums.data() + i * n);
        points.whole[i] = quarters.add([&](std::size_t place) {
          add_way(points, *lamp.area(), first + i, place, i * places + place);
        });
      }
      if (ways.count() == 0) break;
      looked_at += ways.count();
      for (std::size_t w = 0; w < ways.count(); ++w) points.known[ways.slot[w]] = known;
      arrived_ = &points.seen;
      finish(ways, lamp, opaque, groups);
      arrived_ = nullptr;
    } while (true);
    for (std::size_t i = 0; i < count; ++i) {
      std::size_t const k = first + i;
      double* const to = rays.light_of(k);
      double const* const full = points.full.data() + k * n;
      for (std::size_t c = 0; rays.rest[k] > 0 && c < n; ++c)
        to[c] = full[c] != 0 ? to[c] * (points.sums[i * n + c] / full[c]) : 0;
      add_to_film(rays, k);
    }
  }
  return looked_at;
}

void Shadows::add_way(AreaPoints& points, Area const& area, std::size_t k, std::size_t place,
                      std::size_t slot) {
  Rays const& rays = points.rays;
  Rays& ways = points.ways;
  AreaPoints::Point const& point = points.points[k];
  Vec3 const middle = rays.direction.get(k);
  auto const across = static_cast<std::size_t>(area.grid().size1);
  Vec3 const way = middle * rays.rest[k]
                   + area.offset(point.axes, static_cast<int>(place % across),
                                 static_cast<int>(place / across), point.key);
  double const length = glm::length(way);
  Vec3 const direction = length > 0 ? way / length : middle;
  ways.copy(rays, k);
  std::size_t const at = ways.count() - 1;
  bool const through = glm::dot(point.geometric, direction) < 0;
  ways.direction.set(at, direction);
  ways.rest[at] = length;
  ways.start[at] = point.start[through ? 1 : 0];
  ways.stack[at] = point.stack[through ? 1 : 0];
  ways.slot[at] = static_cast<std::uint32_t>(slot);
  std::size_t const n = rays.kind().size();
  std::copy_n(points.full.data() + k * n, n, ways.light_of(at));
}

} // namespace abbe::transport
