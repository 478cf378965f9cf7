// SPDX-License-Identifier: MIT
#include "study/runner.hpp"

#include "image/atomic_file.hpp"
#include "job/child.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace abbe::study {
namespace fs = std::filesystem;

std::string file_name(std::string const& name) {
  std::string out;
  for (char const c : name) {
    bool const plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.';
    if (plain)
      out += c;
    else if (!out.empty() && out.back() != '-')
      out += '-';
  }
  return out;
}

Runner::Runner(StudyOptions const& options) : options_(options) {}

fs::path Runner::picture(Unit const& unit) const {
  return options_.folder / "runs" / fmt::format("{}.s{}.exr", unit.name, unit.seed);
}

std::vector<std::string> Runner::all_words(Unit const& unit) const {
  std::vector<std::string> words{"render", options_.scene};
  words.insert(words.end(), {"-W", std::to_string(std::max(1, options_.width / unit.shrink)), "-H",
                             std::to_string(std::max(1, options_.height / unit.shrink))});
  words.insert(words.end(), options_.scene_words.begin(), options_.scene_words.end());
  words.insert(words.end(), unit.words.begin(), unit.words.end());
  words.insert(words.end(), {"--seed", std::to_string(unit.seed)});
  return words;
}

std::optional<RunRecord> Runner::find(Unit const& unit) const {
  auto const image = picture(unit);
  auto run =
      read_record(fs::path(image).replace_extension(".json"), options_.identity, all_words(unit));
  std::error_code ignored;
  if (!run || (run->done && !fs::exists(image, ignored))) return std::nullopt;
  return run;
}

std::optional<RunRecord> Runner::run(Unit const& unit) {
  if (auto known = find(unit)) return known;
  double const left = left_s();
  if (left <= 0 || stopped()) return std::nullopt;
  auto const image = picture(unit);
  fs::path const record = fs::path(image).replace_extension(".json");
  fs::path const stats = fs::path(image).replace_extension(".stats.json");
  RunRecord run;
  run.identity = options_.identity;
  run.words = all_words(unit);
  run.seed = unit.seed;
  auto words = run.words;
  words.insert(words.end(),
               {"-o", image.string(), "--stats", stats.string(), "--no-checkpoint", "--quiet"});
  if (unit.with_cost_map)
    words.insert(words.end(),
                 {"--cost-map", fs::path(image).replace_extension(".rays.exr").string()});
  auto const child = job::run_child(options_.program, words, left, options_.stop);
  std::error_code ignored;
  using End = job::ChildResult::End;
  if (child.end == End::TimedOut || child.end == End::Stopped) return std::nullopt;
  run.done = child.end == End::Done && read_stats(stats, run);
  fs::remove(stats, ignored);
  run.peak_mib = child.peak_mib;
  if (!run.done)
    run.message =
        child.end == End::NotStarted ? "the program could not be started" : child.messages;
  while (run.message.ends_with('\n')) run.message.pop_back();
  bool const refused = child.status == 1 || child.status == 2;
  if (run.done || refused) {
    auto const kept = image::write_text(record, to_json(run).dump(1) + "\n");
    if (!kept) run.message = kept.error().message; // the next study runs it again
  }
  return run;
}

} // namespace abbe::study
