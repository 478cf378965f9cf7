// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>

namespace abbe {

/// Seconds since it was made: of the clock, and of the processor (this process, all threads, user
/// and system mode).
class Stopwatch {
public:
  Stopwatch();
  double wall_s() const;
  double cpu_s() const;

private:
  std::chrono::steady_clock::time_point wall_begin_;
  double cpu_begin_s_;
};

} // namespace abbe
