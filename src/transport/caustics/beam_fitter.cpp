// SPDX-License-Identifier: MIT
#include "transport/caustics/beam_fitter.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace abbe::transport::caustics {
namespace {

/// How far a polynomial's ray may be from the real one, in half sides of the cell.
constexpr double most_off = 3e-3;
/// How many times more where little light is left.
constexpr double most_lax = 8;
constexpr int deepest_cut = 5;

/// Where polynomials through the nodes are the farthest off.
constexpr double inner = 0.37, outer = 0.88;
constexpr std::array<Vec2, 5> cell_tests{
    {{inner, outer}, {-outer, inner}, {-inner, -outer}, {outer, -inner}, {outer, outer}}};
constexpr std::array<Vec2, 3> spectrum_tests{{{-1, -1}, {1, 1}, {0, 0}}};

/// How far apart two rays are at a distance.
struct Apart {
  double of_cell;    ///< in half sides of the cell by the map there; or less, where it is folded
  double of_longest; ///< as a share of the map's longest stretch
};
Apart apart(BeamMap const& map, double w, Vec2 const& u, BeamMap::Ray const& real, double ahead) {
  Vec3 const at(real[BeamMap::X] + ahead * real[BeamMap::SlopeX],
                real[BeamMap::Y] + ahead * real[BeamMap::SlopeY], ahead);
  auto const o = BeamMap::offset(map.passing(w, at), u);
  double const det = o.by_u.x * o.by_v.y - o.by_u.y * o.by_v.x;
  Vec2 const back{o.at.x * o.by_v.y - o.at.y * o.by_v.x, o.by_u.x * o.at.y - o.by_u.y * o.at.x};
  double const longest = std::sqrt(glm::dot(o.by_u, o.by_u) + glm::dot(o.by_v, o.by_v));
  Apart out{0, glm::length(o.at) / longest};
  out.of_cell = std::min(glm::length(back) / std::abs(det), 16 * out.of_longest);
  if (!std::isfinite(out.of_cell)) out = {INFINITY, INFINITY};
  return out;
}

/// Where a beam is looked at: at its ends, and where it has become twice as wide as it was or, if
/// that is sooner, half-way.
std::array<double, 3> ways_of(Sheet const& sheet) {
  auto const span = [](std::span<float const> values) {
    auto const [low, high] = std::ranges::minmax(values.first(9));
    return static_cast<double>(high) - low;
  };
  double const wide = std::max(span(sheet.x), span(sheet.y)),
               grows = std::max(span(sheet.slope_x), span(sheet.slope_y));
  double const half = 0.5 * (sheet.far - sheet.near);
  return {sheet.near, sheet.near + (wide < grows * half ? wide / grows : half), sheet.far};
}

/// How far rays are outside of rectangles around the nine of a sheet, which move evenly with the
/// wavelength, as a share of these: a quarter at most.
float margin_of(Sheet const& sheet, BeamMap const& map, bool disperses) {
  constexpr int across = 4, waves = 6;
  double most = 0x1p-10;
  for (double const ahead : ways_of(sheet))
    for (int w = 0; w <= (disperses ? waves : 0); ++w) {
      double const share = static_cast<double>(w) / waves;
      double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
      auto const node = [&](auto const& at, auto const& slope, std::size_t k) {
        double const a = at[k] + ahead * slope[k], b = at[k + 9] + ahead * slope[k + 9];
        return a + share * (b - a);
      };
      for (std::size_t k = 0; k < 9; ++k)
        for (std::size_t axis = 0; axis < 2; ++axis) {
          double const at =
              axis == 0 ? node(sheet.x, sheet.slope_x, k) : node(sheet.y, sheet.slope_y, k);
          low[axis] = std::min(low[axis], at);
          high[axis] = std::max(high[axis], at);
        }
      BeamMap::Passing const passing = map.passing(2 * share - 1, Vec3(0, 0, ahead));
      for (int i = 0; i <= across; ++i)
        for (int j = 0; j <= across; ++j) {
          Vec2 const at =
              BeamMap::offset(passing, Vec2(2.0 * i / across - 1, 2.0 * j / across - 1)).at;
          for (int axis = 0; axis < 2; ++axis) {
            double const wide = high[axis] - low[axis];
            double const off = std::max(low[axis] - at[axis], at[axis] - high[axis]);
            most = std::max(most, wide > 0 ? off / wide : INFINITY);
          }
        }
    }
  // Places between those looked at may be farther out.
  return static_cast<float>(std::min(0.25, 1.5 * most));
}

} // namespace

int BeamFitter::wave_at(Chain const& chain, Sheet const& sheet, int sixteenths) const {
  if (!chain.disperses) return Waves::whole;
  auto const pieces = static_cast<double>(spectrum_.size() - 1);
  double const at = sheet.from + (sheet.to - sheet.from) * sixteenths / 16;
  return spectrum_[static_cast<std::size_t>(std::lround(at * pieces))];
}

bool BeamFitter::trace(Chain const& chain, Sheet const& sheet, std::span<Vec2 const> at, int wave,
                       std::span<BeamMap::Ray> out) {
  rays_.count = at.size();
  double const half = 0.5 * sheet.cell.size();
  Vec2 const middle = sheet.cell.low() + Vec2(half);
  for (std::size_t k = 0; k < at.size(); ++k) {
    Emission::Place const place{sheet.cell.face, middle + half * at[k]};
    rays_.origin.set(k, emission_.origin(place));
    rays_.direction.set(k, emission_.direction(place));
    rays_.wave[k] = wave;
  }
  forced_.follow(chain, rays_);
  if (rays_.valid != first_rays(at.size())) return false;
  for (std::size_t k = 0; k < at.size(); ++k) {
    BeamRay const ray{rays_.origin.get(k), rays_.direction.get(k)};
    if (!(glm::dot(ray.direction, sheet.along) > 0.25)) return false;
    out[k] = BeamMap::in_frame(sheet, ray);
    out[k][BeamMap::Way] = rays_.length[k];
    out[k][BeamMap::Share] = rays_.share[k];
    out[k][BeamMap::Inside] = rays_.inside[0][k];
    out[k][BeamMap::Inside2] = rays_.inside[1][k];
  }
  return true;
}

bool BeamFitter::trace_nine(Chain const& chain, Sheet const& sheet, int wave,
                            std::array<BeamRay, 9>& out) {
  if (!forced_.follow_nodes(chain, emission_, sheet.cell, wave, rays_)) return false;
  for (std::size_t k = 0; k < 9; ++k) out[k] = {rays_.origin.get(k), rays_.direction.get(k)};
  return true;
}

BeamFitter::Verdict BeamFitter::fit(Chain const& chain, Sheet const& sheet, BeamMap& map) {
  std::array<Vec2, BeamMap::terms> places;
  for (std::size_t k = 0; k < BeamMap::terms; ++k) places[k] = BeamMap::node(k);
  std::array<BeamMap::Ray, BeamMap::waves * BeamMap::terms> rays;
  std::size_t const waves = chain.disperses ? BeamMap::waves : 1;
  for (std::size_t w = 0; w < waves; ++w)
    if (!trace(chain, sheet, places, wave_at(chain, sheet, BeamMap::wave_sixteenths[w]),
               std::span(rays).subspan(w * BeamMap::terms, BeamMap::terms)))
      return Verdict::Nowhere;
  map = BeamMap(std::span(rays).first(waves * BeamMap::terms));
  std::array const ways = ways_of(sheet);
  double off_longest = 0;
  auto const off_at = [&](std::span<Vec2 const> at, int sixteenths) {
    std::array<BeamMap::Ray, cell_tests.size()> real;
    if (!trace(chain, sheet, at, wave_at(chain, sheet, sixteenths), real)) return INFINITY + 0.0;
    double worst = 0;
    for (std::size_t k = 0; k < at.size(); ++k)
      for (double const way : ways) {
        Apart const off = apart(map, 0.125 * sixteenths - 1, at[k], real[k], way);
        worst = std::max(worst, off.of_cell);
        off_longest = std::max(off_longest, off.of_longest);
      }
    return worst;
  };
  double of_cell = off_at(cell_tests, 0), of_spectrum = 0;
  if (chain.disperses) {
    of_cell = std::max(of_cell, off_at(cell_tests, 16));
    of_spectrum = std::max(off_at(spectrum_tests, 8), off_at(spectrum_tests, 15));
  }
  map.set_off(off_longest);
  double const enough = most_off * std::clamp(1 / sheet.power, 1.0, most_lax);
  if (std::max(of_cell, of_spectrum) <= enough) return Verdict::Fits;
  return of_cell >= of_spectrum ? Verdict::CutCell : Verdict::CutSpectrum;
}

void BeamFitter::cut(Chain const& chain, Sheet const& sheet, int depth, std::vector<Sheet>& sheets,
                     std::vector<BeamMap>& maps) {
  BeamMap map;
  Verdict const verdict = fit(chain, sheet, map);
  if (verdict == Verdict::Fits) {
    sheets.push_back(sheet);
    sheets.back().map = static_cast<std::int32_t>(maps.size());
    sheets.back().margin = margin_of(sheet, map, chain.disperses);
    maps.push_back(std::move(map));
    return;
  }
  auto const as_it_is = [&] { sheets.push_back(sheet); };
  if (verdict == Verdict::Nowhere || depth == deepest_cut) return as_it_is();
  std::vector<Sheet> parts;
  if (verdict == Verdict::CutSpectrum) {
    auto const pieces = static_cast<double>(spectrum_.size() - 1);
    if ((sheet.to - sheet.from) * pieces < 31.5) return as_it_is();
    double const middle = 0.5 * (sheet.from + sheet.to);
    parts = {sheet, sheet};
    parts[0].to = parts[1].from = middle;
  } else {
    for (std::uint32_t k = 0; k < 4; ++k) {
      parts.push_back(sheet);
      parts.back().cell = {sheet.cell.face, sheet.cell.level + 1, 2 * sheet.cell.i + k % 2,
                           2 * sheet.cell.j + k / 2};
    }
  }
  for (Sheet& part : parts) {
    std::array<std::array<BeamRay, 9>, 2> ends;
    if (!trace_nine(chain, part, wave_at(chain, part, 0), ends[0])
        || !trace_nine(chain, part, wave_at(chain, part, 16), ends[1]))
      return as_it_is();
    part.set(ends);
    part.far += part.length;
  }
  for (Sheet const& part : parts) cut(chain, part, depth + 1, sheets, maps);
}

void BeamFitter::cut(Chain const& chain, Sheet const& sheet, std::vector<Sheet>& sheets,
                     std::vector<BeamMap>& maps) {
  cut(chain, sheet, 0, sheets, maps);
}

} // namespace abbe::transport::caustics
