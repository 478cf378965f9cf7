// SPDX-License-Identifier: MIT
#pragma once

#include "cli/command_line.hpp"
#include "lang/evaluate.hpp"
#include "plan/plan.hpp"

#include <optional>
#include <string>
#include <vector>

namespace abbe::cli {

/// What every subcommand that reads a scene understands.
struct SceneArguments {
  std::string scene; ///< "-": standard input
  int width = 640;
  int height = 480;
  std::vector<std::string> declarations; ///< -D NAME=VALUE
  std::string before;                    ///< statements that are read before the scene's
  std::vector<std::string> include_dirs;
  std::vector<std::string> read_dirs; ///< --allow-read
  bool allow_write = false;
  bool strict = false;
  bool quiet = false;
  std::string max_time, max_memory;
  std::optional<int> bands;
  std::string dispersion; ///< the words of a mode
  std::string representation;
  std::string spacing;
  bool spectral = false;
  std::string caustics;        ///< "off"; empty: as the scene says
  lang::AnimationFrame frame;  ///< which picture of a series
  std::optional<double> clock; ///< --clock: instead of the frame's
  int quality = 9;             ///< POV-Ray's +Q (plan/quality.hpp)

  void add_to(CommandLine& app, bool with_plan);
};

/// "90", "90s", "1.5m" or "1h" as seconds. @return what is wrong, empty: nothing
std::string parse_duration(std::string const& text, double& seconds);

/// Evaluates the scene and prints its diagnostics and messages.
/// @return the scene, which stays until the program ends (to take a large one apart, object by
/// object, would be for nothing), or nullptr and the exit status in `status`
lang::Evaluated* load_scene(SceneArguments const& arguments, int& status);
/// Takes apart what load_scene gave, where there is more to come.
void give_up(lang::Evaluated* evaluated);

/// What the command line overrides.
plan::Overrides overrides_of(SceneArguments const& arguments);

/// The plan of the scene under the command line's overrides; prints what is wrong.
std::optional<plan::Plan> plan_scene(lang::Evaluated const& evaluated,
                                     SceneArguments const& arguments, int& status);

/// From now on Ctrl-C and SIGTERM set job::interrupted() and end the program soon, and a file that
/// is cut short while it is read ends it.
void catch_signals();

} // namespace abbe::cli
