// SPDX-License-Identifier: MIT
#pragma once

#include "study/errors.hpp"
#include "study/record.hpp"
#include "study/settings.hpp"

#include <atomic>
#include <functional>
#include <map>

namespace abbe::study {

/// What all settings are compared with: deterministic, so many bands, so sampled.
struct Reference {
  std::optional<int> bands; ///< nothing: 450, or fewer when that takes over a third of the budget
  std::string aa;           ///< empty: the finest of the study's, in each pixel
};
/// "bands=450,aa=4". @error E0530
Result<Reference> parse_reference(std::string const& text);

struct Progress {
  int done = 0, total = 0;
  std::string now; ///< the setting that is being run
  double elapsed_s = 0;
  double left_s = 0; ///< expected; of settings nothing is known of yet: 0
};

struct StudyOptions {
  std::string program; ///< /proc/self/exe
  std::string scene;
  std::vector<std::string> scene_words; ///< -D NAME=VALUE ... of each run
  int width = 0, height = 0;
  int max_level = 256;          ///< the scene's: depths to look at end there
  std::string identity;         ///< of scene, options and program
  std::filesystem::path folder; ///< made when it is not there
  Selection selection;
  Reference reference;
  double budget_s = 300;
  int seeds = 2; ///< of stochastic settings
  std::atomic<bool> const* stop = nullptr;
  std::function<void(Progress const&)> on_progress;
};

struct SettingResult {
  Setting setting;
  std::vector<RunRecord> runs; ///< one a seed; of deterministic settings: repeated for the time
  std::string skipped;         ///< why there is no run; else empty
  Errors errors;               ///< mean over seeds
  std::optional<Spread> spread;
  double wall_s = 0, cpu_s = 0, peak_mib = 0; ///< the least of the runs; the most, of memory
  bool on_front = false;                      ///< mean CIEDE2000 against processor seconds
  bool measured() const { return !runs.empty(); }
};

/// Mean error of a family at 8 bands where paths end after `depth` surfaces, against the reference
/// that ends there too.
struct DepthPoint {
  std::string family;
  int depth = 0;
  double delta_e = 0;
};

/// What it costs a family to reach an error.
struct EqualError {
  double delta_e = 0;
  std::map<std::string, double> cpu_s; ///< by family; missing: not reached
};

struct StudyResult {
  std::string reference; ///< "deterministic, 450 bands, aa off"
  RunRecord reference_run;
  std::vector<SettingResult> settings;
  std::vector<DepthPoint> depth;
  std::vector<EqualError> equal_error;
  std::vector<std::string> notes; ///< what was skipped or lowered, and why
  Machine machine;
  double elapsed_s = 0;
  bool interrupted = false;
};

/// Runs what is missing and measures it all. Order: what is cheap, the reference, the rest by
/// expected time, further seeds, depths; what does not fit in the budget is named in the notes.
/// @error E0531 there is no reference: it failed, or the budget ended it; E0510 the folder
Result<StudyResult> run_study(StudyOptions const& options);

/// The picture of a setting's first run; its rays per pixel, smaller; the reference.
std::filesystem::path picture_of(std::filesystem::path const& folder, Setting const& setting);
std::filesystem::path cost_map_of(std::filesystem::path const& folder, Setting const& setting);
std::filesystem::path reference_picture(std::filesystem::path const& folder);

} // namespace abbe::study
