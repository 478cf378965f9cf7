// SPDX-License-Identifier: MIT
#pragma once

#include "image/image.hpp"
#include "render/render.hpp"

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace abbe::study {

/// One run of `abbe render`, kept as a file so that it need not be run again.
struct RunRecord {
  std::string identity; ///< of scene, options and program, with the words below
  std::vector<std::string> words;
  std::uint64_t seed = 0;
  bool done = false; ///< else `message` says what the program said
  std::string message;
  double wall_s = 0, cpu_s = 0; ///< of the render; the scene's reading apart
  double scene_s = 0;           ///< processor, to read and plan the scene
  double peak_mib = 0;
  int bands = 0;
  render::RayCounts rays; ///< by kind; splits are not kept
};

nlohmann::ordered_json to_json(RunRecord const& run);
/// @return nothing when there is no such file, it is no record, or it is of another identity
std::optional<RunRecord> read_record(std::filesystem::path const& path, std::string const& identity,
                                     std::vector<std::string> const& words);
/// Takes over what `abbe render --stats` wrote. @return false when it cannot be read
bool read_stats(std::filesystem::path const& path, RunRecord& run);

/// The machine, as the report names it.
struct Machine {
  std::string processor, system, compiler;
  int threads = 0;
  double memory_gib = 0;
  double load = 0; ///< processes that want to run, mean of a minute
};
Machine this_machine();
nlohmann::ordered_json to_json(Machine const& machine);

} // namespace abbe::study
