// SPDX-License-Identifier: MIT
#pragma once

/// The subcommands of `abbe`. Each gets its own name as argv[0] and its arguments after it, prints
/// to standard output (results) and standard error (messages), and returns the exit status:
/// 0 done, 1 the input is wrong, 2 the command line is wrong, 3 a file could not be read or
/// written, 130 or 143 interrupted by SIGINT or SIGTERM, 124 by --max-time.
namespace abbe::cli {

int run_compare(int argc, char** argv);
int run_tonemap(int argc, char** argv);
int run_render(int argc, char** argv);
/// POV-Ray's command line; exit statuses are POV-Ray's: 0 done, 1 failed, 2 interrupted.
int run_povray(int argc, char** argv);
int run_study(int argc, char** argv);
int run_check(int argc, char** argv);
int run_dump(int argc, char** argv);
int run_explain(int argc, char** argv);
int run_glass(int argc, char** argv);

} // namespace abbe::cli
