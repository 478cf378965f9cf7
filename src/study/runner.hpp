// SPDX-License-Identifier: MIT
#pragma once

#include "base/stopwatch.hpp"
#include "study/study.hpp"

namespace abbe::study {

/// Something to run: `abbe render` with words, its picture and record under a name.
struct Unit {
  std::string name; ///< of the files
  std::vector<std::string> words;
  std::uint64_t seed = 0;
  bool with_cost_map = false;
  int shrink = 1; ///< the picture is smaller by this, both ways
};

/// Runs units one after another, unless the folder has their results already.
class Runner {
public:
  explicit Runner(StudyOptions const& options);

  /// Since the study began.
  double elapsed_s() const { return since_.wall_s(); }
  /// For runs; a tenth of the budget is for measuring and writing.
  double left_s() const { return 0.9 * options_.budget_s - elapsed_s(); }
  bool stopped() const { return options_.stop && options_.stop->load(); }

  /// The result that is already there.
  std::optional<RunRecord> find(Unit const& unit) const;
  /// @return nothing when it was ended by the budget or a stop. What the program refused is a
  /// result: RunRecord::done is false.
  std::optional<RunRecord> run(Unit const& unit);
  std::filesystem::path picture(Unit const& unit) const;

private:
  std::vector<std::string> all_words(Unit const& unit) const;
  StudyOptions const& options_;
  Stopwatch since_;
};

/// A name for files: letters, digits and hyphens.
std::string file_name(std::string const& name);

} // namespace abbe::study
