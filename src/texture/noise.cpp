// SPDX-License-Identifier: MIT
#include "simd/native.hpp"
#include "texture/lattice.hpp"
#include "texture/noise_tables.hpp"
#include "texture/pattern.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace abbe::texture {
namespace {

namespace lane = simd;

double s_curve(double f) {
  return f * f * (3 - 2 * f);
}

/// The 8 corners of a point's cell: where the row of gradients begins that the hash gives each, the
/// share of each, and the offset of the point from the first.
struct Corners {
  int row[8];
  double weight[8];
  Vec3 offset;
};
void find_corners(NoiseTables const& tables, Vec3 const& point, Corners& out) {
  NoiseCell const x = noise_cell(point.x);
  NoiseCell const y = noise_cell(point.y);
  NoiseCell const z = noise_cell(point.z);
  double const sx = s_curve(x.fraction);
  double const sy = s_curve(y.fraction);
  double const sz = s_curve(z.fraction);
  auto const& hash = tables.hash;
  int corner = 0;
  for (int dx = 0; dx < 2; ++dx) {
    int const hx = hash[x.index + dx];
    double const wx = dx ? sx : 1 - sx;
    for (int dy = 0; dy < 2; ++dy) {
      int const hxy = hash[hx ^ (y.index + dy)];
      double const wxy = wx * (dy ? sy : 1 - sy);
      for (int dz = 0; dz < 2; ++dz, ++corner) {
        out.row[corner] = hash[hxy ^ (z.index + dz)] & 255;
        out.weight[corner] = wxy * (dz ? sz : 1 - sz);
      }
    }
  }
  out.offset = {x.fraction, y.fraction, z.fraction};
}

/// Of the corners, as find_corners() orders them, behind a 0.
alignas(32) constexpr double corner_places[8][4] = {{0, 0, 0, 0}, {0, 0, 0, 1}, {0, 0, 1, 0},
                                                    {0, 0, 1, 1}, {0, 1, 0, 0}, {0, 1, 0, 1},
                                                    {0, 1, 1, 0}, {0, 1, 1, 1}};

/// One value or three: at each corner 0.5 g0 + g . offset, times the corner's share. The four
/// products of a corner stand side by side, and each is summed over the corners first.
template <int Values>
struct SumCorners {
  template <class L>
  static void run(NoiseTables const& tables, Vec3 const& point, double* out) {
    static_assert(lane::width<L> == 4);
    Corners corners;
    find_corners(tables, point, corners);
    double const first[4] = {0.5, corners.offset.x, corners.offset.y, corners.offset.z};
    L const from_first = lane::load<L>(first);
    L sum[Values];
    for (L& value : sum) value = L(0.0);
    for (int corner = 0; corner < 8; ++corner) {
      L const way = from_first - lane::load<L>(corner_places[corner]);
      L const share = L(corners.weight[corner]) * way;
      double const* const g = &tables.gradient[corners.row[corner]];
      for (int value = 0; value < Values; ++value)
        sum[value] = sum[value] + share * lane::load<L>(g + 4 * value);
    }
    for (int value = 0; value < Values; ++value) {
      double part[4];
      lane::store(part, sum[value]);
      out[value] = (part[0] + part[1]) + (part[2] + part[3]);
    }
  }
};
simd::Native<SumCorners<1>, 4> const sum_one;
simd::Native<SumCorners<3>, 4> const sum_three;

double lattice_noise(Vec3 const& point) {
  double sum;
  sum_one(noise_tables(), point, &sum);
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
  double sum[3];
  sum_three(noise_tables(), point, sum);
  return {sum[0], sum[1], sum[2]};
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
