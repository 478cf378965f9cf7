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

/// What is known of a piece of the line. Its ends are shared with its neighbours'.
struct Part {
  enum class Sight : std::uint8_t {
    Below, ///< certainly below the level all along
    Above,
    Settled, ///< at most one root that matters: the sides at its ends tell
    Open     ///< to be divided
  };
  double low, high;
  Sight sight;
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
double passage(FieldLine const& line, double low, double high) {
  double a = high, b = low;
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
  // Pieces about t, each 32 times as wide as the one before, the first being t itself.
  LinePieces about;
  double const grain = 2 * unit_roundoff * std::fabs(t);
  about.count = line.field.side_by_side() > 1 ? LinePieces::most : 1;
  for (int i = 0; i < about.count; ++i) {
    double const half = i == 0 ? 0 : grain + std::ldexp(most, 5 * i - 60);
    about.low[i] = t - half;
    about.high[i] = t + half;
  }
  line.field.along_each(line.origin, line.direction, about);
  Interval const here = Interval(about.value_low[0], about.value_high[0]) - Interval(line.level);
  double const uncertain = here.low <= here.high ? here.size() : infinity;
  double const reach = 2 * uncertain / least_of({about.slope_low[0], about.slope_high[0]});
  if (reach < 0x1p-30 * most) {
    // The slope hardly changes on so short a way: what it is at least there proves the reach.
    double least = 0;
    int i = 1;
    while (i < about.count
           && !(about.low[i] <= t - reach - grain && about.high[i] >= t + reach + grain))
      ++i;
    if (i < about.count) least = least_of({about.slope_low[i], about.slope_high[i]});
    if (!(uncertain <= reach * least)) {
      Interval const part(t - reach - grain, t + reach + grain);
      least = least_of(line.field.along(line.origin, line.direction, part).slope);
    }
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

namespace {

/// The search for the roots of one line: parts are divided, the first open one first, and what
/// came of it waits in the order of the line.
class Search {
public:
  Search(FieldLine const& line, double low, double high, std::vector<FieldRoot>& roots)
      : line_(line),
        length_(high - low),
        shares_(std::max(2, line.field.side_by_side())),
        total_(line.field.total()),
        roots_(roots),
        side_(line.side(low)) {}

  void run(double low, double high) {
    waiting_[count_++] = {low, high, Part::Sight::Open};
    while (count_ > 0) {
      if (waiting_[count_ - 1].sight == Part::Sight::Open)
        divide();
      else if (!pass(waiting_[--count_]))
        return;
    }
  }

private:
  static constexpr int most = LinePieces::most;
  /// Narrow is 2^-71 of the length at least: 24 divisions by eight, or 71 by two.
  static constexpr std::size_t room = std::size_t{most} * 32;

  /// Divides the first part, and the next open one of its neighbours with it: where the first
  /// comes close to the level, so does that.
  void divide() {
    std::size_t const first = count_ - 1, last = count_ > 4 ? count_ - 4 : 0;
    std::size_t other = first;
    while (shares_ == most && other > last && waiting_[other - 1].sight != Part::Sight::Open)
      --other;
    bool const two = shares_ == most && other > last;
    int const shares = two ? most / 2 : shares_;
    Part between[4];
    std::size_t kept = 0;
    share(0, shares, waiting_[first]);
    if (two) {
      share(shares, shares, waiting_[other - 1]);
      while (other + kept < first) {
        between[kept] = waiting_[other + kept];
        ++kept;
      }
    }
    pieces_.count = two ? most : shares;
    looked_at_ += static_cast<std::size_t>(pieces_.count);
    line_.field.along_each(line_.origin, line_.direction, pieces_);
    count_ = two ? other - 1 : first;
    if (two) {
      put(shares, shares);
      for (std::size_t k = 0; k < kept; ++k) waiting_[count_++] = between[k];
    }
    put(0, shares);
  }
  void share(int at, int shares, Part const& part) {
    double const low = part.low, wide = part.high - part.low;
    for (int k = 0; k < shares; ++k) {
      pieces_.low[at + k] = k == 0 ? low : low + wide * (static_cast<double>(k) / shares);
      pieces_.high[at + k] =
          k + 1 == shares ? part.high : low + wide * (static_cast<double>(k + 1) / shares);
    }
  }
  void put(int at, int shares) {
    for (int i = at + shares - 1; i >= at; --i)
      waiting_[count_++] = {pieces_.low[i], pieces_.high[i], sight(i)};
  }

  Part::Sight sight(int i) const {
    using Sight = Part::Sight;
    double const low = pieces_.low[i], high = pieces_.high[i], level = line_.level;
    if (pieces_.value_low[i] > level) return Sight::Above;
    if (pieces_.value_high[i] < level) return Sight::Below;
    Interval const slope(pieces_.slope_low[i], pieces_.slope_high[i]);
    // The mean value form; what is undefined fails all comparisons.
    double const over = pieces_.middle_low[i] - level, under = level - pieces_.middle_high[i];
    double const reach = slope.size() * ((high - low) * 0.5) * (1 + 0x1p-48);
    if (over > reach) return Sight::Above;
    if (under > reach) return Sight::Below;
    bool const monotone = !slope.holds(0);
    if (monotone || narrow(low, high) || high - low <= coarse()) return Sight::Settled;
    // Nowhere a number, as far as can be seen.
    auto const undefined = [&](double t) {
      return std::isnan(line_.field.value(line_.origin + t * line_.direction));
    };
    if (std::isnan(pieces_.middle_low[i]) && !total_ && undefined(low) && undefined(high))
      return Sight::Settled;
    // As close to the level all along as rounding can tell: a graze, or a line along a flat face.
    // Sides say nothing there, but for those at the ends.
    auto const hidden = [&](double t) { return at(line_, t).value.holds(0); };
    double const blur = pieces_.middle_high[i] - pieces_.middle_low[i];
    bool const all = reach <= 8 * blur && over <= 0 && under <= 0 && hidden(low) && hidden(high);
    return all ? Sight::Settled : Sight::Open;
  }

  bool narrow(double low, double high) const {
    double const middle = 0.5 * low + 0.5 * high;
    double const grain =
        unit_roundoff * std::max({std::fabs(low), std::fabs(high), 0x1p-20 * length_});
    return !(low < middle && middle < high) || high - low <= 4 * grain;
  }
  /// Parts as wide as this are not divided any more.
  double coarse() const {
    double const usual = line_.field.smooth() ? 0 : line_.resolution;
    if (looked_at_ < field_pieces) return usual;
    double const share = looked_at_ < 4 * field_pieces ? 0x1p-14 : 1;
    return std::max({usual, line_.resolution, length_ * share});
  }

  /// Goes over a part that is not open. @return false: there are roots enough
  bool pass(Part const& part) {
    if (part.sight != Part::Sight::Settled) {
      int const sign = part.sight == Part::Sight::Above ? 1 : -1;
      if (total_) return sign == side_ || take(part.low, part.low, sign); // a step where parts meet
      // What is no number counts as above, and is not in the enclosure.
      if (line_.side(part.high) == side_) return true;
      if (!narrow(part.low, part.high)) {
        waiting_[count_++] = {part.low, part.high, Part::Sight::Open};
        return true;
      }
    }
    int const side = line_.side(part.high);
    return side == side_ || take(part.low, part.high, side);
  }
  bool take(double low, double high, int side) {
    double const root = passage(line_, low, high);
    bool const rising = side > 0;
    side_ = side;
    roots_.push_back({root, field_root_error(line_, root, rising, length_), rising});
    return roots_.back().at - roots_.back().error <= line_.enough;
  }

  FieldLine const& line_;
  double const length_;
  int const shares_; ///< into how many a part is divided
  bool const total_;
  std::vector<FieldRoot>& roots_;
  int side_; ///< at the end of what has been passed
  std::size_t looked_at_ = 0, count_ = 0;
  LinePieces pieces_;
  Part waiting_[room];
};

} // namespace

void field_roots(FieldLine const& line, double low, double high, std::vector<FieldRoot>& roots) {
  Search(line, low, high, roots).run(low, high);
}

} // namespace abbe::geometry
