// SPDX-License-Identifier: MIT
#include "transport/air/rainbow.hpp"

#include "base/random.hpp"
#include "simd/math.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace abbe::transport {
namespace {

/// Random, the same for the same direction: -1 .. 1.
double shift_of(Vec3 const& direction) {
  RandomKey key;
  for (int axis = 0; axis < 3; ++axis)
    key = key.child(std::bit_cast<std::uint64_t>(direction[axis]));
  return 2 * key.uniform(0) - 1;
}

/// The entries beside a value, and the share of the second.
struct Between {
  Bow::Entry const *low, *high;
  double share;
  double mix(double a, double b) const { return a + share * (b - a); }
};
Between find(std::vector<Bow::Entry> const& entries, double value) {
  auto const high = std::ranges::lower_bound(entries, value, {}, &Bow::Entry::value);
  if (high == entries.begin()) return {&*high, &*high, 0};
  Bow::Entry const& low = *(high - 1);
  if (high == entries.end()) return {&low, &low, 0};
  return {&low, &*high, (value - low.value) / (high->value - low.value)};
}

} // namespace

bool Bow::meet(Vec3 const& direction, double& place, double& fade) const {
  double const cosine = std::clamp(glm::dot(direction, axis), -1.0, 1.0);
  place = (simd::acos(cosine) - inner_rad) / width_rad;
  if (jitter != 0) place += jitter * shift_of(direction);
  if (!(place >= 0 && place <= 1)) return false;
  fade = 1;
  double const aside = std::abs(simd::atan2(glm::dot(direction, right), glm::dot(direction, up)));
  if (aside <= falloff_rad) return true;
  if (aside > arc_rad) return false;
  double const x = (arc_rad - aside) / (arc_rad - falloff_rad);
  fade = x * x * (3 - 2 * x);
  return true;
}

double Rainbow::brightest() const {
  double most = 0;
  for (Bow const& bow : bows_)
    for (auto const& entry : bow.entries) most = std::max(most, entry.colour.brightest());
  return most;
}

void Rainbow::along(AirWay const& way) const {
  struct Met {
    Between at;
    double passed, filter;
  };
  std::vector<Met> met;
  each_of(way.rays, [&](std::size_t r) {
    met.clear();
    Vec3 const direction = way.direction->get(r);
    for (Bow const& bow : bows_) {
      double place = 0, fade = 0;
      if (!bow.meet(direction, place, fade)) continue;
      Between const at = find(bow.entries, place);
      double const transmit = at.mix(at.low->colour.transmit, at.high->colour.transmit);
      double const passed =
          std::max(simd::exp(-way.distance[r] / bow.distance), 1 - fade * (1 - transmit));
      double const filter = at.mix(at.low->colour.filter, at.high->colour.filter);
      met.push_back({at, passed, filter * (1 - passed)});
    }
    if (met.empty()) return;
    double const share = 1.0 / static_cast<double>(met.size());
    for (std::size_t k = r * way.each; k < (r + 1) * way.each; ++k) {
      std::uint16_t const c = way.channel[k];
      double left = 0, added = 0;
      for (auto const& [at, passed, filter] : met) {
        added += (1 - passed) * at.mix(at.low->colour.light[c], at.high->colour.light[c]);
        double tint = 1;
        if (filter != 0)
          tint = 1 - filter + filter * at.mix(at.low->colour.tint[c], at.high->colour.tint[c]);
        left += passed * tint;
      }
      way.added[k] += way.left[k] * added * share;
      way.left[k] *= left * share;
    }
  });
}

} // namespace abbe::transport
