// SPDX-License-Identifier: MIT
#pragma once

#include "base/stopwatch.hpp"
#include "cli/render_arguments.hpp"

#include <string>

namespace abbe::cli {

/// --error and --time: takes over what suits them, and says so. The exit status, 0: go on.
/// @param since the program's begin
/// @param chosen the options that would have asked for it
int choose(RenderArguments& arguments, lang::Evaluated const& evaluated, Stopwatch const& since,
           std::string& chosen);

/// --time: how many passes there shall be, by what those so far took.
class PassClock {
public:
  /// The first pass begins. @param since the program's begin
  PassClock(double target_s, Stopwatch const& since)
      : target_s_(target_s), since_(since), begin_s_(since.wall_s()) {}
  int wanted(int done) const;

private:
  double target_s_;
  Stopwatch since_;
  double begin_s_;
};

/// --time: how to get the same bytes without a clock.
void say_again(RenderArguments const& arguments, std::string const& chosen, int passes);

} // namespace abbe::cli
