// SPDX-License-Identifier: MIT
#include "texture/lattice.hpp"
#include "texture/noise_tables.hpp"
#include "texture/pattern.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace abbe::texture {
namespace {

double s_curve(double f) {
  return f * f * (3 - 2 * f);
}

/// Calls visit(hash byte, weight, offset from the corner) for the 8 corners of the point's cell.
template <class Visit>
void for_each_corner(NoiseTables const& tables, Vec3 const& point, Visit visit) {
  NoiseCell const x = noise_cell(point.x);
  NoiseCell const y = noise_cell(point.y);
  NoiseCell const z = noise_cell(point.z);
  double const sx = s_curve(x.fraction);
  double const sy = s_curve(y.fraction);
  double const sz = s_curve(z.fraction);
  auto const& hash = tables.hash;
  for (int dx = 0; dx < 2; ++dx) {
    int const hx = hash[x.index + dx];
    double const wx = dx ? sx : 1 - sx;
    for (int dy = 0; dy < 2; ++dy) {
      int const hxy = hash[hx ^ (y.index + dy)];
      double const wxy = wx * (dy ? sy : 1 - sy);
      for (int dz = 0; dz < 2; ++dz)
        visit(hash[hxy ^ (z.index + dz)] & 255, wxy * (dz ? sz : 1 - sz),
              Vec3(x.fraction - dx, y.fraction - dy, z.fraction - dz));
    }
  }
}

double corner_value(double const* g, Vec3 const& d) {
  return 0.5 * g[0] + g[1] * d.x + g[2] * d.y + g[3] * d.z;
}

double lattice_noise(Vec3 const& point) {
  NoiseTables const& tables = noise_tables();
  double sum = 0;
  for_each_corner(tables, point, [&](int m, double weight, Vec3 const& d) {
    sum += weight * corner_value(&tables.gradient[m], d);
  });
  return sum;
}

/// Generator 3: gradient noise, shifted so that its lattice planes miss the integers.
double gradient_noise(Vec3 const& point) {
  GradientNoiseTables const& tables = gradient_noise_tables();
  Vec3 const shifted = point + 10000000.023157213;
  int const x = wrapped_floor(shifted.x, 2047);
  int const y = wrapped_floor(shifted.y, 2047);
  int const z = wrapped_floor(shifted.z, 2047);
  Vec3 const f = shifted - glm::floor(shifted);
  Vec3 const s(s_curve(f.x), s_curve(f.y), s_curve(f.z));
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    int const dx = corner >> 2, dy = (corner >> 1) & 1, dz = corner & 1;
    double const weight = (dx ? s.x : 1 - s.x) * (dy ? s.y : 1 - s.y) * (dz ? s.z : 1 - s.z);
    int const hash = tables.permutation[(x + dx) & 2047];
    Vec3 const& g = tables.gradient[(tables.permutation[hash + y + dy] + z + dz) & 4095];
    sum += weight * glm::dot(g, f - Vec3(dx, dy, dz));
  }
  return sum;
}

double clamp01(double v) {
  return std::clamp(v, 0.0, 1.0);
}

} // namespace

double noise(Vec3 const& point, int generator) {
  switch (generator) {
  case 1:
    return clamp01(lattice_noise(point) + 0.5);
  case 3:
    return clamp01(0.5 * (1.59 * gradient_noise(point) + 0.985));
  default:
    return clamp01((lattice_noise(point) + 1.05242) * 0.48985582);
  }
}

double noise_slope(int generator) {
  // A corner's share changes by 1.5 at most along an axis, from one corner's value to another's;
  // the values themselves change by their gradients.
  static double const lattice = [] {
    auto const& g = noise_tables().gradient;
    double most = 0, steep = 0;
    for (std::size_t m = 0; m + 3 < std::size(g); ++m) {
      double const slope =
          std::max(std::abs(g[m + 1]), std::max(std::abs(g[m + 2]), std::abs(g[m + 3])));
      most = std::max(most, 0.5 * std::abs(g[m]) + std::abs(g[m + 1]) + std::abs(g[m + 2])
                                + std::abs(g[m + 3]));
      steep = std::max(steep, slope);
    }
    return 1.5 * 2 * most + steep;
  }();
  static double const gradient = [] {
    double most = 0;
    for (Vec3 const& g : gradient_noise_tables().gradient)
      most = std::max(most, std::abs(g.x) + std::abs(g.y) + std::abs(g.z));
    return 1.5 * 2 * most + most;
  }();
  switch (generator) {
  case 1:
    return lattice;
  case 3:
    return 0.5 * 1.59 * gradient;
  default:
    return 0.48985582 * lattice;
  }
}

Vec3 vector_noise(Vec3 const& point) {
  NoiseTables const& tables = noise_tables();
  Vec3 sum{0};
  for_each_corner(tables, point, [&](int m, double weight, Vec3 const& d) {
    double const* const g = &tables.gradient[m];
    sum += weight * Vec3(corner_value(g, d), corner_value(g + 4, d), corner_value(g + 8, d));
  });
  return sum;
}

double turbulence(Vec3 const& point, Turbulence const& t, int generator) {
  auto const octave = [generator](Vec3 const& p) {
    return generator == 1 ? noise(p, 1) : 2 * noise(p, generator) - 0.5;
  };
  double value = octave(point);
  if (generator != 1) value = clamp01(value);
  double scale = t.lambda;
  double weight = t.omega;
  for (int k = 1; k < t.octaves; ++k) {
    value += weight * octave(point * scale);
    scale *= t.lambda;
    weight *= t.omega;
  }
  return value;
}

Vec3 vector_turbulence(Vec3 const& point, Turbulence const& t) {
  Vec3 value = vector_noise(point);
  double scale = t.lambda;
  double weight = t.omega;
  for (int k = 1; k < t.octaves; ++k) {
    value += weight * vector_noise(point * scale);
    scale *= t.lambda;
    weight *= t.omega;
  }
  return value;
}

} // namespace abbe::texture
