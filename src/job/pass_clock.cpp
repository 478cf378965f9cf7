// SPDX-License-Identifier: MIT
#include "job/pass_clock.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::job {
namespace {

/// Of the time: what counts as within it.
constexpr double most_late = 1.25;
/// More than anyone waits for.
constexpr double most_passes = 1e6;

} // namespace

int passes_wanted(int done, double begin_s, double now_s, double target_s) {
  double const each_s = (now_s - begin_s) / done;
  // To the nearest, unless that would be late.
  double const more = std::clamp(std::floor((target_s - now_s) / each_s + 0.5), 0.0, most_passes);
  if (more == 1 && now_s + each_s > most_late * target_s) return done;
  return done + static_cast<int>(more);
}

} // namespace abbe::job
