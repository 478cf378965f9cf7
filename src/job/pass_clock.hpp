// SPDX-License-Identifier: MIT
#pragma once

#include "job/job.hpp"

namespace abbe::job {

/// How many passes there shall be, by what those so far took: so many that the end is nearest to
/// the deadline, but no one more that would end later than a quarter of the time behind it.
/// @param done passes, >= 1, which took from begin_s to now_s @param target_s the deadline
/// @return >= done; more than done: ask again when they are made
int passes_wanted(int done, double begin_s, double now_s, double target_s);

/// The same by the clock of a deadline.
class PassClock {
public:
  /// The first pass begins.
  explicit PassClock(Deadline const& deadline)
      : deadline_(deadline), begin_s_(deadline.since.wall_s()) {}
  int wanted(int done) const {
    return passes_wanted(done, begin_s_, deadline_.since.wall_s(), deadline_.seconds);
  }

private:
  Deadline deadline_;
  double begin_s_;
};

} // namespace abbe::job
