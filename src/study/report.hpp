// SPDX-License-Identifier: MIT
#pragma once

#include "study/study.hpp"

namespace abbe::study {

/// What the report says beside the figures.
struct ReportHead {
  std::string command; ///< that made it
  std::string version;
  std::filesystem::path assets; ///< stdlib/study: the page's parts
};

/// Writes study.json, study.csv, report.html and the pictures in it into the study's folder.
/// @error E0510 a file cannot be written, E0511 a part of the page cannot be read
image::Status write_report(StudyResult const& result, StudyOptions const& options,
                           ReportHead const& head);

/// The figures as a plain table, and the notes.
std::string to_text(StudyResult const& result);

/// Seconds over those of the setting without dispersion that is alike else; nothing without one.
std::optional<double> ratio_to_none(StudyResult const& result, SettingResult const& setting);

} // namespace abbe::study
