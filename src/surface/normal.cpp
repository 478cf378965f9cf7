// SPDX-License-Identifier: MIT
#include "surface/normal.hpp"

#include <cmath>

namespace abbe::surface {
namespace {

using scene::Normal, texture::PatternInstance, texture::Sight;

/// Where a pattern is looked at for its slope: the corners of a regular tetrahedron.
constexpr double third = 1.0 / 3;
Vec3 const corners[] = {{0.942809041, -third, 0},
                        {-0.471404521, -third, 0.816496581},
                        {-0.471404521, -third, -0.816496581},
                        {0, 1, 0}};
/// POV-Ray's height of bumps: what bump_size 1 is, at the accuracy that bumps have unasked.
constexpr double height = 5, default_accuracy = 0.02;

/// The height that a slope_map gives a value, by the slopes at both ends of the piece it falls
/// into.
double height_of(std::span<Normal::Slope const> map, double value) {
  if (map.empty()) return value;
  if (value >= map.back().value) return map.back().height;
  std::size_t above = 0;
  while (map[above].value < value) ++above;
  Normal::Slope const& high = map[above];
  if (above == 0 || high.value == value) return high.height;
  Normal::Slope const& low = map[above - 1];
  double const t = (value - low.value) / (high.value - low.value);
  double const t2 = t * t, t3 = t2 * t;
  return low.height * (2 * t3 - 3 * t2 + 1) + low.slope * (t3 - 2 * t2 + t)
         + high.height * (3 * t2 - 2 * t3) + high.slope * (t3 - t2);
}

void tilt_by_slope(Normal const& source, Vec3 const& placed, Sight const& sight, Vec3& normal) {
  double const scale = height * source.amount * default_accuracy / source.accuracy;
  for (Vec3 const& corner : corners) {
    double const value = source.pattern->value(placed + source.accuracy * corner, &sight);
    normal -= scale * height_of(source.slopes, value) * corner;
  }
}

Vec3 tilted(Textures const& textures, int number, Vec3 const& point, Vec3 const& normal,
            Sight const& sight) {
  CompiledNormal const& own = textures.normals[static_cast<std::size_t>(number)];
  Normal const& source = *own.source;
  Vec3 const placed = source.pattern->place(point, &sight);
  Vec3 out = own.in * normal;
  if (!source.no_bump_scale) out = glm::normalize(out);
  if (!own.entries.empty() && source.pattern->pattern->averages()) {
    Vec3 sum(0);
    for (std::size_t i = 0; i < own.entries.size(); ++i)
      sum += own.values[i]
             * (own.entries[i] < 0 ? out : tilted(textures, own.entries[i], placed, out, sight));
    out = sum;
  } else if (!own.entries.empty()) {
    auto const at = texture::look_up(own.values, source.pattern->value(placed, &sight));
    auto const of = [&](int entry) {
      int const inner = own.entries[static_cast<std::size_t>(entry)];
      return inner < 0 ? out : tilted(textures, inner, placed, out, sight);
    };
    Vec3 const first = of(at.first);
    out = at.weight == 0 ? first : (1 - at.weight) * first + at.weight * of(at.second);
  } else if (!source.slopes.empty()
             || !source.pattern->pattern->tilt(placed, source.pattern->modifiers, source.amount,
                                               out)) {
    tilt_by_slope(source, placed, sight, out);
  }
  return glm::normalize(own.out * out);
}

} // namespace

Vec3 tilted_normal(Textures const& textures, int number, Vec3 const& point, Vec3 const& normal,
                   Sight const& sight) {
  Vec3 const out = tilted(textures, number, point, normal, sight);
  return std::isfinite(out.x + out.y + out.z) ? out : normal;
}

} // namespace abbe::surface
