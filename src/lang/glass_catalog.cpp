// SPDX-License-Identifier: MIT
#include "lang/interpreter.hpp"
#include "optics/agf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace abbe::lang {

namespace {

constexpr std::size_t most_problems_told = 10;

std::string told(std::string const& path, optics::AgfCatalogue::Problem const& problem) {
  return fmt::format("{}: line {}: {}{}{}", path, problem.line,
                     problem.glass.empty() ? "" : "glass '" + problem.glass + "': ",
                     problem.message, problem.lost ? "; the glass is left out" : "");
}

/// One warning for all that makes no sense in a catalogue.
void report_problems(Reader& in, std::string const& path, optics::AgfCatalogue const& read,
                     Span at) {
  auto const& problems = read.problems;
  if (problems.empty()) return;
  std::vector<Diagnostic::Note> notes;
  std::size_t const shown = std::min(problems.size(), most_problems_told);
  for (std::size_t i = 1; i < shown; ++i) notes.push_back({{}, told(path, problems[i])});
  if (shown < problems.size())
    notes.push_back({{}, fmt::format("{} more lines make no sense", problems.size() - shown)});
  in.interpreter().report(Severity::Warning, "E0414", told(path, problems[0]), at,
                          std::move(notes));
}

} // namespace

/// `glass_catalog "file.agf"`: the file's name without its extension is the maker.
void read_glass_catalog(Reader& in) {
  Span const at = in.next_span();
  std::string const path = in.path("name of an AGF file");
  if (path.empty()) return;
  auto text = load_file(in.interpreter(), path);
  if (!text) {
    in.report(Severity::Error, text.error().code, text.error().message, at);
    return;
  }
  std::string const maker = std::filesystem::path(path).stem().string();
  auto const read = optics::read_agf(*text, maker);
  bool const none = std::none_of(read.problems.begin(), read.problems.end(),
                                 [](auto const& problem) { return problem.lost; });
  if (read.glasses.empty() && none) {
    in.report(Severity::Error, "E0414", path + ": no glass in it; is it an AGF file?", at);
    return;
  }
  report_problems(in, path, read, at);
  SceneState& state = scene_state(in.interpreter());
  state.file_glasses.insert(state.file_glasses.end(), read.glasses.begin(), read.glasses.end());
  for (auto const& problem : read.problems)
    if (problem.lost) state.lost_glasses.push_back({maker, problem.glass, told(path, problem)});
}

} // namespace abbe::lang
