// SPDX-License-Identifier: MIT
#include "geometry/field_roots.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace abbe::geometry {

namespace {

struct Part {
  double low, high;
  int first, last; ///< sides at the ends
};

/// The field's value less the level, at one place of the line as given.
Interval at(FieldLine const& line, double t) {
  return line.field.along(line.origin, line.direction, Interval(t)).value - Interval(line.level);
}
Interval around_zero(Interval const& value) {
  return value.low <= value.high ? value : Interval::everything();
}

/// The root between sides that differ: Newton's steps with the slope of the field, halving else.
FieldRoot refined(FieldLine const& line, Part const& part) {
  double low = part.low, high = part.high, step = high - low;
  bool const rising = part.first < 0;
  double t = 0.5 * low + 0.5 * high;
  ScalarField::Along here{};
  for (int i = 0; i < 200; ++i) {
    here = line.field.along(line.origin, line.direction, Interval(t));
    double const value = line.field.value(line.origin + t * line.direction) - line.level;
    ((value <= 0) == rising ? low : high) = t;
    double const slope = here.slope.middle(), newton = t - value / slope;
    bool const good = newton > low && newton < high && std::fabs(newton - t) < 0.5 * step;
    double const next = good ? newton : 0.5 * low + 0.5 * high;
    step = std::fabs(next - t);
    if (value == 0 || next == t || next <= low || next >= high) break;
    t = next;
  }
  FieldRoot root;
  root.at = t;
  root.rising = rising;
  // What the value is uncertain by, over the least slope at the root; not more than the bracket.
  double const uncertain = 0.5 * around_zero(here.value).width();
  double const steep =
      here.slope.holds(0) ? 0 : std::min(std::fabs(here.slope.low), std::fabs(here.slope.high));
  double const by_slope = steep > 0 ? 2 * uncertain / steep : part.high - part.low;
  root.error = std::max(std::min(by_slope, part.high - part.low), high - low);
  if (!(root.error < part.high - part.low)) root.error = high - low;
  return root;
}

} // namespace

int FieldLine::side(double t) const {
  return field.value(origin + t * direction) - level <= 0 ? -1 : 1;
}

void field_roots(FieldLine const& line, double low, double high, std::vector<FieldRoot>& roots) {
  std::vector<Part> waiting{{low, high, line.side(low), line.side(high)}};
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
      roots.push_back(refined(line, part));
      if (roots.back().at - roots.back().error > line.enough) return;
      continue;
    }
    if (narrow || monotone || coarse) continue;
    Interval const here = at(line, middle);
    Interval const half((part.low - part.high) * 0.5, (part.high - part.low) * 0.5);
    Interval const mean = here + over.slope * half;
    if (part.first == part.last && !mean.holds(0)) continue;
    int const side = line.side(middle);
    if (here.holds(0) && part.first == part.last && side == part.first
        && at(line, part.low).holds(0) && at(line, part.high).holds(0)) {
      continue; // a graze that rounding hides
    }
    waiting.push_back({middle, part.high, side, part.last});
    waiting.push_back({part.low, middle, part.first, side});
  }
}

} // namespace abbe::geometry
