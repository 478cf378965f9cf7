// SPDX-License-Identifier: MIT
#include "texture/patterns/crackle.hpp"

#include "simd/math.hpp"
#include "texture/cell_point.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace abbe::texture {
namespace {

struct Offset {
  std::int8_t x, y, z;
};

/// The 81 cells around the middle one that can matter: -2..2 each, at most one of them at an end.
/// The nearest first, so that the farther ones can mostly be passed over.
constexpr std::array<Offset, 81> neighbours() {
  std::array<Offset, 81> cells{};
  std::size_t count = 0;
  for (int square = 0; square <= 6; ++square)
    for (int x = -2; x <= 2; ++x)
      for (int y = -2; y <= 2; ++y)
        for (int z = -2; z <= 2; ++z) {
          int const ends = (x * x == 4) + (y * y == 4) + (z * z == 4);
          if (ends > 1 || x * x + y * y + z * z != square) continue;
          cells[count++] = {static_cast<std::int8_t>(x), static_cast<std::int8_t>(y),
                            static_cast<std::int8_t>(z)};
        }
  return cells;
}

/// The points of the cells around one, each found when it is asked for first: neighbours in the
/// picture mostly ask for the same.
struct Surroundings {
  Vec3 cell{std::numeric_limits<double>::quiet_NaN()};
  std::array<bool, 81> known{};
  std::array<Vec3, 81> points;

  static Surroundings& of(Vec3 const& cell) {
    static thread_local std::array<Surroundings, 4> latest;
    // Neighbouring cells go to different places.
    auto const place = static_cast<std::size_t>(std::abs(std::fmod(cell.x + cell.y + cell.z, 4.0)));
    Surroundings& here = latest[place];
    if (!(here.cell == cell)) {
      here.cell = cell;
      here.known.fill(false);
    }
    return here;
  }
};

class Crackle final : public Pattern {
public:
  double raw(Vec3 const& p, PatternModifiers const& modifiers) const override {
    Nearest const nearest = find(p);
    if (solid_) return noise(nearest.point, modifiers.noise_generator);
    double value = 0;
    for (int i = 0; i < 3; ++i)
      if (form_[i] != 0) value += form_[i] * root(nearest.power[i]);
    return std::clamp(value, 0.0, 1.0);
  }
  std::shared_ptr<Pattern const> read_item(Parameters& in) const override;

  struct Nearest {
    std::array<double, 3> power{}; ///< |d|^m + offset^m of the nearest three, ascending
    Vec3 point{0};                 ///< the nearest
  };
  Nearest find(Vec3 const& p) const;
  void set_metric(double metric) {
    metric_ = metric;
    bool const simple = metric <= most_simple && 2 * metric == std::floor(2 * metric);
    halves_ = simple ? static_cast<int>(2 * metric) : 0;
  }

private:
  double power(double difference) const {
    double const size = std::abs(difference);
    if (halves_ == 0) return simd::pow(size, metric_);
    double result = halves_ % 2 == 1 ? std::sqrt(size) : 1;
    for (int i = 1; i < halves_; i += 2) result *= size;
    return result;
  }
  double root(double sum) const {
    return metric_ == 2 ? std::sqrt(sum) : simd::pow(sum, 1 / metric_);
  }
  /// Of the gap between the point's place in its own cell and the cell k cells away.
  double gap_power(double place, int k) const {
    if (k == 0) return 0;
    return power(k > 0 ? k - place : place - (k + 1));
  }

  Vec3 form_{-1, 1, 0};
  /// Up to this, powers of halves are products and roots.
  static constexpr double most_simple = 6;
  double metric_ = 2;
  int halves_ = 4; ///< twice the metric, where that is simple; else 0
  double offset_ = 0;
  bool solid_ = false;
};

Crackle::Nearest Crackle::find(Vec3 const& p) const {
  static constexpr auto cells = neighbours();
  NoiseTables const& tables = noise_tables();
  CellRandoms const& randoms = cell_randoms();
  Vec3 const cell = glm::floor(p - cell_tolerance);
  Vec3 const place = p - cell;
  std::array<std::array<double, 3>, 5> gap;
  for (int k = -2; k <= 2; ++k)
    for (int axis = 0; axis < 3; ++axis) gap[k + 2][axis] = gap_power(place[axis], k);

  Nearest nearest;
  nearest.power.fill(std::numeric_limits<double>::infinity());
  auto& best = nearest.power;
  Surroundings& around = Surroundings::of(cell);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    Offset const& d = cells[i];
    if (gap[d.x + 2][0] + gap[d.y + 2][1] + gap[d.z + 2][2] > best[2]) continue;
    Vec3& point = around.points[i];
    if (!around.known[i]) {
      Vec3 const corner = cell + Vec3(d.x, d.y, d.z);
      point = corner + cell_point(tables, randoms, corner);
      around.known[i] = true;
    }
    double const distance = power(p.x - point.x) + power(p.y - point.y) + power(p.z - point.z);
    if (distance < best[0]) {
      best = {distance, best[0], best[1]};
      nearest.point = point;
    } else if (distance < best[1]) {
      best = {best[0], distance, best[1]};
    } else if (distance < best[2]) {
      best[2] = distance;
    }
  }
  for (double& sum : best) sum += power(offset_);
  return nearest;
}

std::shared_ptr<Pattern const> Crackle::read_item(Parameters& in) const {
  auto changed = std::make_shared<Crackle>(*this);
  Span const span = in.next_span();
  if (in.accept("form")) {
    changed->form_ = in.vec3("form");
  } else if (in.accept("metric")) {
    double const metric = in.number("metric");
    if (metric > 0)
      changed->set_metric(metric);
    else
      in.report(Severity::Error, "E0384", "the metric of crackle must be positive", span);
  } else if (in.accept("offset")) {
    changed->offset_ = in.number("offset");
    if (!(changed->offset_ >= 0)) {
      in.report(Severity::Error, "E0384", "the offset of crackle must not be negative", span);
      changed->offset_ = offset_;
    }
  } else if (std::optional<bool> const solid = in.flag("solid")) {
    changed->solid_ = *solid;
  } else {
    return nullptr;
  }
  return changed;
}

class Facets final : public Pattern {
public:
  double raw(Vec3 const&, PatternModifiers const&) const override { return 0; }
  bool has_value() const override { return false; }
  bool tilt(Vec3 const& point, PatternModifiers const&, double, Vec3& normal) const override {
    if (coords_ == 0) {
      normal = glm::normalize(cells_.find(normal / size_).point);
      return true;
    }
    Vec3 const push = vector_noise(cells_.find(point / size_).point);
    normal = glm::normalize(normal + coords_ * (push - glm::dot(push, normal) * normal));
    return true;
  }
  std::shared_ptr<Pattern const> read_item(Parameters& in) const override {
    auto changed = std::make_shared<Facets>(*this);
    Span const span = in.next_span();
    bool const metric = in.accept("metric");
    if (!metric && in.accept("coords")) {
      changed->coords_ = in.number("coords");
      return changed;
    }
    if (!metric && !in.accept("size")) return nullptr;
    double const value = in.number(metric ? "metric" : "size");
    if (!(value > 0))
      in.report(Severity::Error, "E0384", "the size and metric of facets must be positive", span);
    else if (metric)
      changed->cells_.set_metric(value);
    else
      changed->size_ = value;
    return changed;
  }

private:
  Crackle cells_;
  double size_ = 0.1;
  double coords_ = 0; ///< 0: facets of directions, else how strongly facets of places lean
};

} // namespace

std::shared_ptr<Pattern const> read_crackle(Parameters&) {
  return std::make_shared<Crackle>();
}
std::shared_ptr<Pattern const> read_facets(Parameters&) {
  return std::make_shared<Facets>();
}

} // namespace abbe::texture
