// SPDX-License-Identifier: MIT
#include "texture/patterns/tilings.hpp"

#include "texture/lattice.hpp"
#include "texture/patterns/formula.hpp"

#include <cmath>
#include <numbers>

namespace abbe::texture {
namespace {

constexpr double root3 = std::numbers::sqrt3;
using Entry = Pattern::DefaultEntry;
constexpr Entry hexagon_map[] = {{0, Vec3(0, 0, 1)}, {1, Vec3(0, 1, 0)}, {2, Vec3(1, 0, 0)}};
constexpr Entry six_map[] = {{0, Vec3(1, 0, 0)}, {1, Vec3(0, 1, 0)}, {2, Vec3(0, 0, 1)},
                             {3, Vec3(1, 1, 0)}, {4, Vec3(0, 1, 1)}, {5, Vec3(1, 0, 1)}};

double modulo(double value, double by) {
  return value - by * std::floor(value / by);
}

double square(Vec3 const& p, PatternModifiers const&) {
  int const x = wrapped_floor(p.x + cell_tolerance, 1), z = wrapped_floor(p.z + cell_tolerance, 1);
  return z == 0 ? 3 * x : 1 + x;
}

/// Hexagons two wide in x, about the points 1.5 q, sqrt(3) (r + q / 2): the nearest one, found by
/// rounding three coordinates whose sum is 0.
double hexagon(Vec3 const& p, PatternModifiers const&) {
  double const q = (p.x + cell_tolerance) / 1.5, r = (p.z + cell_tolerance) / root3 - q / 2,
               s = -q - r;
  double q0 = std::round(q), r0 = std::round(r);
  double const s0 = std::round(s);
  double const dq = std::abs(q0 - q), dr = std::abs(r0 - r), ds = std::abs(s0 - s);
  if (dq > dr && dq > ds)
    q0 = -r0 - s0;
  else if (dr > ds)
    r0 = -q0 - s0;
  return modulo(r0 + 2 * q0, 3);
}

/// Strips of triangles that stand on their sides and on their tips in turn; each other strip is
/// shifted by half a side.
double triangular(Vec3 const& p, PatternModifiers const&) {
  constexpr double height = root3 / 2;
  double const strip = std::floor((p.z + cell_tolerance) / height);
  double const h = p.z / height - strip;
  bool const odd = modulo(strip, 2) == 1;
  static constexpr double standing[2][3] = {{0, 4, 2}, {4, 2, 0}};
  static constexpr double hanging[2][3] = {{1, 3, 5}, {5, 1, 3}};
  double const x = p.x + (odd ? 0.5 : 0) + cell_tolerance;
  double const left = std::floor(x - h / 2);
  double const within = x - left;
  auto const third = [](double i) { return static_cast<std::size_t>(modulo(i, 3)); };
  if (within < 1 - h / 2) return standing[odd][third(left)];
  return hanging[odd][third(odd ? left : left + 1)];
}

double cubic(Vec3 const& p, PatternModifiers const&) {
  Vec3 const size = glm::abs(p);
  if (size.x >= size.y && size.x >= size.z) return p.x >= 0 ? 0 : 3;
  if (size.y >= size.z) return p.y > 0 ? 1 : 4;
  return p.z > 0 ? 2 : 5;
}

class Tiles final : public Pattern {
public:
  using Raw = double (*)(Vec3 const&, PatternModifiers const&);
  Tiles(Raw formula, std::span<DefaultEntry const> map) : raw_(formula), map_(map) {}
  double raw(Vec3 const& p, PatternModifiers const& modifiers) const override {
    return raw_(p, modifiers);
  }
  int list_size() const override { return static_cast<int>(map_.size()); }
  double default_frequency() const override { return 0; }
  std::span<DefaultEntry const> default_map() const override { return map_; }

private:
  Raw raw_;
  std::span<DefaultEntry const> map_;
};

} // namespace

std::shared_ptr<Pattern const> read_hexagon(Parameters&) {
  return std::make_shared<Tiles>(hexagon, hexagon_map);
}
std::shared_ptr<Pattern const> read_square(Parameters&) {
  return std::make_shared<Tiles>(square, std::span(six_map).first(4));
}
std::shared_ptr<Pattern const> read_triangular(Parameters&) {
  return std::make_shared<Tiles>(triangular, six_map);
}
std::shared_ptr<Pattern const> read_cubic(Parameters&) {
  return std::make_shared<Tiles>(cubic, six_map);
}

} // namespace abbe::texture
