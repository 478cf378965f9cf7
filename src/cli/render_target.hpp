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

/// --time: how to get the same bytes without a clock.
void say_again(RenderArguments const& arguments, std::string const& chosen, int passes);

} // namespace abbe::cli
