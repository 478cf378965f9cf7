// SPDX-License-Identifier: MIT
#pragma once

#include "base/stopwatch.hpp"
#include "study/prober.hpp"
#include "study/target.hpp"

#include <atomic>

namespace abbe::study {

inline constexpr int most_bands = 512;

/// What both searches start from.
struct Question {
  Prober& prober;
  Target target;
  bool bands_given = false, mode_given = false;
  std::atomic<bool> const* stop = nullptr;
  Stopwatch since{};

  double elapsed_s() const { return since.wall_s(); }
  bool stopped() const { return stop && stop->load(); }
  /// The modes that may be chosen.
  std::vector<Way const*> open_ways() const;
  /// The cheapest setting of a mode.
  Place first_place(Way const& way) const;
  std::optional<Place> more_bands(Place place) const;
  std::optional<Place> next_step(Place place) const;
};

/// What was found.
struct Answer {
  Place place;
  Seen seen;
  bool reached = false;
};

/// The fewest rays for a mean CIEDE2000.
Answer search_for_error(Question const& question);
/// The least error in a time of the clock.
Answer search_for_time(Question const& question);

} // namespace abbe::study
