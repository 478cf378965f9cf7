// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <string>
#include <vector>

namespace abbe::job {

/// How a run of a program ended, and what it took.
struct ChildResult {
  enum class End { Done, Failed, TimedOut, Stopped, NotStarted } end = End::NotStarted;
  int status = 0; ///< exit status; of a signal: 128 + its number
  double wall_s = 0, cpu_s = 0;
  double peak_mib = 0;  ///< largest resident set
  std::string messages; ///< what it wrote to standard error, the last 4 KiB
};

/// Runs a program to its end. Standard input and output are /dev/null.
/// @param seconds it is asked to end (SIGTERM) when it takes longer; <= 0: it may take any time
/// @param stop set: it is asked to end
ChildResult run_child(std::string const& program, std::vector<std::string> const& words,
                      double seconds, std::atomic<bool> const* stop);

} // namespace abbe::job
