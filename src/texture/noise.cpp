// SPDX-License-Identifier: MIT
#include "simd/native.hpp"
#include "texture/lattice.hpp"
#include "texture/noise_bounds.hpp"
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

namespace {

/// How much the value at a corner of a cell, and a component of its gradient, may be.
struct Steepest {
  double value, gradient;
};
Steepest steepest(int generator) {
  static Steepest const lattice = [] {
    auto const& g = noise_tables().gradient;
    Steepest out{0, 0};
    for (std::size_t m = 0; m + 3 < std::size(g); ++m) {
      double const sum = std::abs(g[m + 1]) + std::abs(g[m + 2]) + std::abs(g[m + 3]);
      out.value = std::max(out.value, 0.5 * std::abs(g[m]) + sum);
      for (int k = 1; k < 4; ++k) out.gradient = std::max(out.gradient, std::abs(g[m + k]));
    }
    return out;
  }();
  static Steepest const gradient = [] {
    double most = 0;
    for (Vec3 const& g : gradient_noise_tables().gradient)
      most = std::max(most, std::abs(g.x) + std::abs(g.y) + std::abs(g.z));
    return Steepest{most, most};
  }();
  return generator == 3 ? gradient : lattice;
}

/// noise() is (what the corners make + shift) scale, kept within 0 and 1.
struct Range {
  double shift, scale;
};
Range range_of(int generator) {
  switch (generator) {
  case 1:
    return {0.5, 1};
  case 3:
    return {0.985 / 1.59, 0.5 * 1.59};
  default:
    return {1.05242, 0.48985582};
  }
}

/// A cell's corners, x the slowest: the value that each makes of the point, and its gradient.
struct Cell {
  double value[8];
  Vec3 gradient[8];
  Vec3 offset; ///< of the point
};
Cell cell_about(Vec3 const& point, int generator) {
  Cell out;
  if (generator == 3) {
    GradientNoiseTables const& tables = gradient_noise_tables();
    Vec3 const shifted = point + 10000000.023157213;
    int const x = wrapped_floor(shifted.x, 2047);
    int const y = wrapped_floor(shifted.y, 2047);
    int const z = wrapped_floor(shifted.z, 2047);
    out.offset = shifted - glm::floor(shifted);
    for (int corner = 0; corner < 8; ++corner) {
      int const dx = corner >> 2, dy = (corner >> 1) & 1, dz = corner & 1;
      int const hash = tables.permutation[(x + dx) & 2047];
      Vec3 const& g = tables.gradient[(tables.permutation[hash + y + dy] + z + dz) & 4095];
      out.gradient[corner] = g;
      out.value[corner] = glm::dot(g, out.offset - Vec3(dx, dy, dz));
    }
    return out;
  }
  NoiseTables const& tables = noise_tables();
  Corners corners;
  find_corners(tables, point, corners);
  out.offset = corners.offset;
  for (int corner = 0; corner < 8; ++corner) {
    double const* const g = &tables.gradient[corners.row[corner]];
    double const* const place = corner_places[corner];
    out.gradient[corner] = {g[1], g[2], g[3]};
    out.value[corner] = 0.5 * g[0] + g[1] * (out.offset.x - place[1])
                        + g[2] * (out.offset.y - place[2]) + g[3] * (out.offset.z - place[3]);
  }
  return out;
}

/// By how much the second derivatives change the gradient in a box: value and gradient of the
/// corners differ by `values` and `slopes`.
Vec3 bend(double values, Vec3 const& slopes, Vec3 const& reach) {
  // s'' is within 6, s' within 1.5; s is the share of a corner's neighbour along an axis.
  Vec3 out;
  for (int i = 0; i < 3; ++i) {
    out[i] = (6 * values + 3 * slopes[i]) * reach[i];
    for (int k = 0; k < 3; ++k)
      if (k != i) out[i] += (4.5 * values + 1.5 * (slopes[i] + slopes[k])) * reach[k];
  }
  return out;
}

} // namespace

NoiseBounds noise_about(Vec3 const& middle, Vec3 const& reach, int generator) {
  Cell const cell = cell_about(middle, generator);
  Vec3 const f = cell.offset, s(s_curve(f.x), s_curve(f.y), s_curve(f.z));
  Vec3 const rate = 6.0 * f * (1.0 - f);
  double value = 0, least = cell.value[0], most = least;
  Vec3 slope(0), low = cell.gradient[0], high = low;
  for (int corner = 0; corner < 8; ++corner) {
    double const x = corner & 4 ? s.x : 1 - s.x, y = corner & 2 ? s.y : 1 - s.y,
                 z = corner & 1 ? s.z : 1 - s.z;
    double const own = cell.value[corner], weight = x * y * z;
    Vec3 const& g = cell.gradient[corner];
    value += weight * own;
    slope += weight * g;
    slope.x += (corner & 4 ? rate.x : -rate.x) * y * z * own;
    slope.y += (corner & 2 ? rate.y : -rate.y) * x * z * own;
    slope.z += (corner & 1 ? rate.z : -rate.z) * x * y * own;
    least = std::min(least, own);
    most = std::max(most, own);
    low = glm::min(low, g);
    high = glm::max(high, g);
  }
  Steepest const any = steepest(generator);
  bool const one_cell = glm::all(glm::lessThanEqual(reach, glm::min(f, 1.0 - f)));
  Vec3 const sizes = glm::max(glm::abs(low), glm::abs(high));
  Vec3 const bent = one_cell ? bend(most - least + 2 * glm::dot(sizes, reach), high - low, reach)
                             : bend(2 * any.value, Vec3(2 * any.gradient), reach);
  Range const range = range_of(generator);
  double const steep = noise_slope(generator);
  NoiseBounds out;
  double off = 0x1p-44;
  for (int i = 0; i < 3; ++i) {
    double const own = slope[i] * range.scale, by = bent[i] * range.scale * (1 + 0x1p-40) + 0x1p-40;
    out.gradient[i] = by < 2 * steep
                          ? Interval{std::max(own - by, -steep), std::min(own + by, steep)}
                          : Interval{-steep, steep};
    off += out.gradient[i].size() * reach[i];
  }
  double const raw = (value + range.shift) * range.scale;
  out.at = clamp01(raw);
  out.value = {clamp01(raw - off), clamp01(raw + off)};
  if (!(raw - off > 0 && raw + off < 1))
    for (Interval& g : out.gradient) g = hull(g, Interval(0));
  return out;
}

double noise_slope(int generator) {
  // A corner's share changes by 1.5 at most along an axis, from one corner's value to another's;
  // the values themselves change by their gradients.
  Steepest const most = steepest(generator);
  return range_of(generator).scale * (1.5 * 2 * most.value + most.gradient);
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
