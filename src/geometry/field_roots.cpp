// SPDX-License-Identifier: MIT
#include "geometry/field_roots.hpp"

#include "geometry/line.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::geometry {

namespace {

/// Roots that are nearer to one another, as a share of the line's length, may be one root to the
/// enclosures, whose width is a rounding of the values.
constexpr double graze = 0x1p-24;

struct Part {
  double low, high;
  int first, last; ///< sides at the ends
};

/// The field's value less the level, at one place of the line as given.
ScalarField::Along at(FieldLine const& line, double t) {
  ScalarField::Along here = line.field.along(line.origin, line.direction, Interval(t));
  here.value = here.value - Interval(line.level);
  return here;
}
double value_at(FieldLine const& line, double t) {
  double const value = line.field.value(line.origin + t * line.direction) - line.level;
  return std::isnan(value) ? infinity : value;
}

/// Where doubles see the field pass the level, between sides that differ: by inverse quadratic
/// interpolation where it can be trusted, halving else (Chandrupatla 1997).
double passage(FieldLine const& line, Part const& part) {
  double a = part.high, b = part.low;
  double at_a = value_at(line, a), at_b = value_at(line, b);
  double share = at_a / (at_a - at_b); // of the way from a to b: where their chord is zero
  for (int i = 0; i < 200; ++i) {
    double const best = std::fabs(at_b) < std::fabs(at_a) ? b : a;
    double const least = 2 * unit_roundoff * std::fabs(best) / std::fabs(b - a);
    if (!(least <= 0.5)) return best;
    if (!(share >= 0)) share = 0.5;
    double const next = a + std::clamp(share, least, 1 - least) * (b - a);
    if (next == a || next == b) return best;
    double const value = value_at(line, next);
    bool const beyond = (value <= 0) != (at_a <= 0);
    double const c = beyond ? b : a, at_c = beyond ? at_b : at_a;
    if (beyond) {
      b = a;
      at_b = at_a;
    }
    a = next;
    at_a = value;
    double const xi = (a - b) / (c - b), phi = (at_a - at_b) / (at_c - at_b);
    bool const trusted = phi * phi < xi && (1 - phi) * (1 - phi) < 1 - xi;
    share = trusted ? at_a / (at_b - at_a) * at_c / (at_b - at_c)
                          + (c - a) / (b - a) * at_a / (at_c - at_a) * at_b / (at_c - at_b)
                    : 0.5;
  }
  return a;
}

double least_of(Interval const& slope) {
  return slope.holds(0) ? 0 : std::min(std::fabs(slope.low), std::fabs(slope.high));
}

/// How far from t, a multiple of `reach`, the field is certainly off the level. Beyond `graze` it
/// is enough that doubles see it on the `side` where it should be: else a field that keeps to the
/// level for a while would have roots without a bound.
double certain_from(FieldLine const& line, double t, double reach, int side, double most) {
  for (; std::fabs(reach) < most; reach *= 4) {
    bool const undefined = std::isnan(line.field.value(line.origin + (t + reach) * line.direction));
    if (undefined || !at(line, t + reach).value.holds(0)) return std::fabs(reach);
    if (std::fabs(reach) > graze * most && line.side(t + reach) == side) return std::fabs(reach);
  }
  return most;
}

} // namespace

double field_root_error(FieldLine const& line, double t, bool rising, double most) {
  ScalarField::Along const here = at(line, t);
  double const uncertain = here.value.low <= here.value.high ? here.value.size() : infinity;
  double const grain = 2 * unit_roundoff * std::fabs(t),
               reach = 2 * uncertain / least_of(here.slope);
  if (reach < 0x1p-30 * most) {
    // The slope hardly changes on so short a way: what it is at least there proves the reach.
    Interval const part(t - reach - grain, t + reach + grain);
    double const least = least_of(line.field.along(line.origin, line.direction, part).slope);
    if (uncertain <= reach * least) return uncertain / least + grain;
  }
  // A graze or a kink: signs tell.
  double const first = std::max(0x1p-50 * most, grain);
  int const beyond = rising ? 1 : -1;
  return std::max(certain_from(line, t, first, beyond, most),
                  certain_from(line, t, -first, -beyond, most));
}

int FieldLine::side(double t) const {
  return value_at(*this, t) <= 0 ? -1 : 1;
}

void field_roots(FieldLine const& line, double low, double high, std::vector<FieldRoot>& roots) {
  std::vector<Part> waiting{{low, high, line.side(low), line.side(high)}};
  auto const take = [&](Part const& part) {
    double const root = passage(line, part);
    bool const rising = part.first < 0;
    roots.push_back({root, field_root_error(line, root, rising, high - low), rising});
  };
  while (!waiting.empty()) {
    Part const part = waiting.back();
    waiting.pop_back();
    auto const over = line.field.along(line.origin, line.direction, {part.low, part.high});
    Interval const value = over.value - Interval(line.level);
    if (!value.holds(0) && part.first == part.last) continue;
    double const middle = 0.5 * part.low + 0.5 * part.high;
    bool const narrow =
        !(part.low < middle && middle < part.high)
        || part.high - part.low
               <= 4 * unit_roundoff * std::max(std::fabs(part.low), std::fabs(part.high));
    bool const monotone = !over.slope.holds(0);
    bool const coarse = !line.field.smooth() && part.high - part.low <= line.resolution;
    if (part.first != part.last && (monotone || narrow || coarse)) {
      take(part);
      if (roots.back().at - roots.back().error > line.enough) return;
      continue;
    }
    if (narrow || monotone || coarse) continue;
    Interval const here = at(line, middle).value;
    Interval const half((part.low - part.high) * 0.5, (part.high - part.low) * 0.5);
    Interval const mean = here + over.slope * half;
    if (part.first == part.last && !mean.holds(0)) continue;
    int const side = line.side(middle);
    // As close to the level all along as rounding can tell: a graze, or a line along a flat face.
    // Sides say nothing there, but for those at the ends.
    auto const hidden = [&](double t) { return at(line, t).value.holds(0); };
    if (mean.size() <= 16 * here.width() && here.holds(0) && hidden(part.low)
        && hidden(part.high)) {
      if (part.first != part.last) take(part);
      continue;
    }
    waiting.push_back({middle, part.high, side, part.last});
    waiting.push_back({part.low, middle, part.first, side});
  }
}

} // namespace abbe::geometry
