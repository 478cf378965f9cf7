// SPDX-License-Identifier: MIT
#include "study/study.hpp"

#include "image/atomic_file.hpp"
#include "image/io.hpp"
#include "study/front.hpp"
#include "study/runner.hpp"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/parallel_for_each.h>

namespace abbe::study {
namespace fs = std::filesystem;
namespace {

/// Deterministic settings are run so often, for the least time, while a run is shorter than this.
constexpr int repeats = 3;
constexpr double short_run_s = 1;
/// Of the budget, for the reference.
constexpr double reference_share = 0.35;
/// Error against depth is looked at in a picture smaller by this, both ways.
constexpr int depth_shrink = 4;
/// Of the budget: settings that would take this too wait for the depths and the maps of rays.
constexpr double depth_share = 0.2;
constexpr int depth_bands = 8;
constexpr int cost_map_shrink = 3;

Unit unit_of(Setting const& setting, std::uint64_t seed) {
  return {file_name(setting.name), setting.words, seed};
}

/// A run of its own, for it takes more time.
Unit cost_map_unit(Setting const& setting) {
  return {"rays-" + file_name(setting.name), setting.words, 0, true, cost_map_shrink};
}

class Study {
public:
  explicit Study(StudyOptions const& options) : options_(options), runner_(options) {}

  Result<StudyResult> run() {
    auto settings = make_settings(options_.selection);
    if (!settings) return settings.error();
    for (auto& setting : *settings) {
      result_.settings.emplace_back();
      result_.settings.back().setting = std::move(setting);
    }
    std::error_code failed;
    fs::create_directories(options_.folder / "runs", failed);
    if (failed)
      return Error{"E0510", fmt::format("cannot write '{}': {}", options_.folder.string(),
                                        failed.message())};
    result_.machine = this_machine();
    count_ = static_cast<int>(result_.settings.size()) + 1;
    for (auto& setting : result_.settings) // what is cheap, to learn what things cost
      if (setting.setting.value <= 8 && setting.setting.aa == "off") run_seed(setting, 0);
    if (auto const error = make_reference()) return *error;
    reserve_s_ = depth_share * options_.budget_s;
    run_by_cost(0);
    reserve_s_ = 0;
    run_depths();
    run_cost_maps();
    run_by_cost(0);
    for (int seed = 1; seed < std::max(options_.seeds, repeats); ++seed)
      run_by_cost(static_cast<std::uint64_t>(seed));
    measure();
    say_what_is_missing();
    result_.interrupted = runner_.stopped();
    result_.elapsed_s = runner_.elapsed_s();
    return std::move(result_);
  }

private:
  /// Expected seconds of the clock; nothing where nothing alike has been run.
  std::optional<double> expected_s(Setting const& setting) const {
    std::optional<double> best;
    double nearest = 0;
    for (auto const& other : result_.settings) {
      if (!other.measured()) continue;
      bool const same_family = other.setting.family == setting.family;
      double const ratio =
          setting.family->parameter == "bands" && other.setting.family->parameter == "bands"
              ? setting.value / std::max(1.0, other.setting.value)
              : 1;
      double const samples = static_cast<double>(Sampling{setting.aa}.samples())
                             / Sampling{other.setting.aa}.samples();
      double const apart =
          std::abs(std::log2(ratio)) + std::abs(std::log2(samples)) + (same_family ? 0 : 4);
      if (best && apart >= nearest) continue;
      nearest = apart;
      best = other.wall_s * std::max(1.0, ratio) * samples;
    }
    return best;
  }

  /// A run of a family for lines had no channels beside its bands.
  bool has_no_lines(Family const& family) const {
    return family.for_lines
           && std::any_of(result_.settings.begin(), result_.settings.end(), [&](auto const& other) {
                return other.setting.family == &family && other.measured()
                       && other.runs.front().bands == static_cast<int>(other.setting.value);
              });
  }

  void tell(std::string const& now) {
    if (!options_.on_progress) return;
    Progress progress{0, count_, now, runner_.elapsed_s(), 0};
    for (auto const& setting : result_.settings)
      if (setting.measured() || !setting.skipped.empty())
        ++progress.done;
      else
        progress.left_s += expected_s(setting.setting).value_or(0);
    if (result_.reference_run.done) ++progress.done;
    progress.left_s = std::clamp(runner_.left_s(), 0.0, progress.left_s);
    options_.on_progress(progress);
  }

  /// The first run of a setting, or a further one of another seed.
  void run_seed(SettingResult& result, std::uint64_t seed) {
    if (runner_.stopped() || result.runs.size() > seed || !result.skipped.empty()) return;
    bool const stochastic = result.setting.family->stochastic;
    if (seed >= static_cast<std::uint64_t>(stochastic ? options_.seeds : repeats)) return;
    if (seed > 0 && result.runs.size() != seed) return; // an earlier one did not fit
    if (seed > 0 && !stochastic && result.wall_s > short_run_s) return;
    if (seed == 0 && has_no_lines(*result.setting.family)) {
      result.skipped = "the lights have no lines: the picture of deterministic";
      return;
    }
    Unit const unit = unit_of(result.setting, seed);
    if (!runner_.find(unit)) {
      auto const expected = expected_s(result.setting);
      double const left = runner_.left_s() - reserve_s_;
      if (left <= 0 || (expected && *expected > left)) {
        if (seed == 0 && reserve_s_ == 0)
          result.skipped = expected ? fmt::format("would take about {:.0f} s, {:.0f} s were left",
                                                  *expected, std::max(0.0, left))
                                    : std::string("the budget is spent");
        return;
      }
      tell(seed == 0 ? result.setting.name
                     : fmt::format("{}, run {}", result.setting.name, seed + 1));
    }
    auto const run = runner_.run(unit);
    if (!run) {
      if (seed == 0)
        result.skipped = runner_.stopped() ? "interrupted" : "ended when the budget was spent";
    } else if (!run->done) {
      if (seed == 0) result.skipped = "refused: " + run->message;
    } else {
      result.wall_s = result.runs.empty() ? run->wall_s : std::min(result.wall_s, run->wall_s);
      result.cpu_s = result.runs.empty() ? run->cpu_s : std::min(result.cpu_s, run->cpu_s);
      result.peak_mib = std::max(result.peak_mib, run->peak_mib);
      result.runs.push_back(*run);
    }
  }

  void run_by_cost(std::uint64_t seed) {
    std::vector<SettingResult*> order;
    for (auto& setting : result_.settings) order.push_back(&setting);
    auto const cost = [&](SettingResult const* s) {
      return s->measured() ? s->wall_s : expected_s(s->setting).value_or(0);
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](auto const* a, auto const* b) { return cost(a) < cost(b); });
    // Seeds tell noise from bias; repeats only steady a time.
    std::stable_partition(order.begin(), order.end(), [&](auto const* s) {
      return seed == 0 || s->setting.family->stochastic;
    });
    for (auto* setting : order) run_seed(*setting, seed);
  }

  Unit reference_unit(int bands, std::string const& aa) const {
    auto words = fill_words("--dispersion deterministic --bands {}", std::to_string(bands));
    for (auto& word : Sampling{aa}.words()) words.push_back(std::move(word));
    return {fmt::format("reference-{}-{}", bands, file_name(aa)), words};
  }

  /// The finest of the study's, in each pixel.
  std::string finest_aa() const {
    std::string finest = "off";
    for (auto const& aa : options_.selection.aa)
      if (Sampling{aa}.samples() > Sampling{finest}.samples()) finest = aa;
    return Sampling{finest}.everywhere().text;
  }

  std::optional<Error> make_reference() {
    auto const aa = options_.reference.aa.empty() ? finest_aa() : options_.reference.aa;
    int bands = options_.reference.bands.value_or(450);
    if (!options_.reference.bands) bands = affordable_bands(aa);
    Unit const unit = reference_unit(bands, aa);
    result_.reference = fmt::format("deterministic, {} bands, aa {}", bands, aa);
    tell("the reference: " + result_.reference);
    auto const run = runner_.run(unit);
    if (!run)
      return Error{"E0531", runner_.stopped()
                                ? "interrupted before the reference was complete"
                                : fmt::format("the reference ({}) does not fit in the budget: "
                                              "--budget or --reference bands=N,aa=N helps",
                                              result_.reference)};
    if (!run->done) return Error{"E0531", "the reference cannot be rendered: " + run->message};
    result_.reference_run = *run;
    reference_bands_ = bands;
    std::error_code failed;
    fs::copy_file(runner_.picture(unit), reference_picture(options_.folder),
                  fs::copy_options::overwrite_existing, failed);
    if (failed) return Error{"E0510", "cannot copy the reference: " + failed.message()};
    return std::nullopt;
  }

  /// 450, or what a third of the budget is enough for.
  int affordable_bands(std::string const& aa) {
    Setting like{find_family("deterministic"), 0, "", aa, {}};
    for (int const bands : {450, 225, 150, 90, 45}) {
      like.value = bands;
      double const seconds = expected_s(like).value_or(0);
      bool const there = runner_.find(reference_unit(bands, aa)).has_value();
      if (!there && seconds > reference_share * options_.budget_s && bands != 45) continue;
      if (bands < 450) {
        like.value = 450;
        result_.notes.push_back(fmt::format(
            "The reference has {} bands: 450 would take about {:.0f} s of a budget of {:.0f} s "
            "(--reference bands=450 wants them all the same).",
            bands, expected_s(like).value_or(0), options_.budget_s));
      }
      return bands;
    }
    return 450;
  }

  void measure() {
    auto const reference = image::read(reference_picture(options_.folder));
    if (!reference) {
      result_.notes.push_back(reference.error().message);
      return;
    }
    tell("measuring");
    auto const field = dispersion_field(*reference);
    tbb::parallel_for_each(result_.settings, [&](SettingResult& result) {
      if (!result.measured()) return;
      bool const stochastic = result.setting.family->stochastic;
      std::vector<image::Image> pictures;
      for (auto const& run : result.runs) {
        if (!stochastic && !pictures.empty()) break;
        auto picture = image::read(runner_.picture(unit_of(result.setting, run.seed)));
        if (picture) pictures.push_back(std::move(*picture));
      }
      auto const count = static_cast<double>(pictures.size());
      for (auto const& picture : pictures) {
        auto const e = measure_errors(*reference, picture, field);
        result.errors.relative_mse += e.relative_mse / count;
        result.errors.relative_mse_rgb += e.relative_mse_rgb / count;
        result.errors.delta_e_mean += e.delta_e_mean / count;
        result.errors.delta_e_p99 += e.delta_e_p99 / count;
        result.errors.flip += e.flip / count;
        result.errors.banding += e.banding / count;
      }
      result.spread = measure_spread(*reference, pictures, !stochastic);
    });
    compare_settings();
  }

  void compare_settings() {
    std::vector<SettingResult*> measured;
    std::vector<Point> points;
    for (auto& result : result_.settings)
      if (result.measured()) {
        measured.push_back(&result);
        points.push_back({result.cpu_s, result.errors.delta_e_mean});
      }
    auto const front = pareto_front(points);
    for (std::size_t i = 0; i < measured.size(); ++i) measured[i]->on_front = front[i];
    for (double const target : {5.0, 2.0, 1.0, 0.5, 0.2, 0.1, 0.05, 0.02}) {
      EqualError row{target, {}};
      for (auto const& family : families()) {
        std::vector<Point> own;
        for (std::size_t i = 0; i < measured.size(); ++i)
          if (measured[i]->setting.family == &family) own.push_back(points[i]);
        if (auto const cost = cost_at_error(own, target))
          row.cpu_s[std::string(family.name)] = *cost;
      }
      if (!row.cpu_s.empty()) result_.equal_error.push_back(std::move(row));
    }
  }

  void run_cost_maps() {
    std::vector<std::string> missing;
    for (auto const& result : result_.settings) {
      double const pixels = cost_map_shrink * cost_map_shrink;
      bool const fits = 2 * result.wall_s / pixels < runner_.left_s();
      if (!result.measured() || runner_.stopped()) continue;
      Unit const unit = cost_map_unit(result.setting);
      if (runner_.find(unit)) continue;
      tell("rays a pixel of " + result.setting.name);
      if (!fits || !runner_.run(unit)) missing.push_back(result.setting.name);
    }
    if (!missing.empty())
      result_.notes.push_back(
          fmt::format("No map of rays (the budget is spent): {}.", fmt::join(missing, ", ")));
  }

  std::vector<int> depths() const {
    std::vector<int> out;
    for (int const depth : {2, 3, 4, 6, 8, 12, 16, 24})
      if (depth < options_.max_level) out.push_back(depth);
    if (options_.max_level <= 24) out.push_back(options_.max_level);
    return out;
  }

  Unit at_depth(Unit unit, int depth) const {
    unit.name = fmt::format("depth{}-{}", depth, unit.name);
    unit.shrink = depth_shrink;
    unit.words.insert(unit.words.end(), {"--max-trace-level", std::to_string(depth)});
    return unit;
  }

  std::optional<image::Image> depth_picture(Unit const& unit) {
    tell(unit.name);
    auto const run = runner_.run(unit);
    if (!run || !run->done) return std::nullopt;
    auto picture = image::read(runner_.picture(unit));
    if (!picture) return std::nullopt;
    return std::move(*picture);
  }

  void run_depths() {
    for (int const depth : depths()) {
      if (runner_.stopped()) return;
      double const pixels = depth_shrink * depth_shrink;
      bool const fits = runner_.find(at_depth(reference_unit(reference_bands_, "off"), depth))
                        || result_.reference_run.wall_s / pixels < runner_.left_s();
      auto const reference =
          fits ? depth_picture(at_depth(reference_unit(reference_bands_, "off"), depth))
               : std::nullopt;
      if (!reference) {
        result_.notes.push_back(
            fmt::format("Error against depth ends before depth {}: the budget is spent.", depth));
        return;
      }
      for (auto const& result : result_.settings) {
        auto const& setting = result.setting;
        if (setting.value != depth_bands || setting.aa != "off"
            || setting.family->parameter != "bands" || !result.measured())
          continue;
        auto const picture = depth_picture(at_depth(unit_of(setting, 0), depth));
        if (picture)
          result_.depth.push_back(
              {std::string(setting.family->name), depth, mean(delta_e_map(*reference, *picture))});
      }
    }
  }

  void say_what_is_missing() {
    std::vector<std::string> few;
    for (auto const& result : result_.settings) {
      if (!result.skipped.empty())
        result_.notes.push_back(
            fmt::format("Skipped: {} ({}).", result.setting.name, result.skipped));
      else if (result.setting.family->stochastic
               && result.runs.size() < static_cast<std::size_t>(options_.seeds))
        few.push_back(fmt::format("{} ({})", result.setting.name, result.runs.size()));
    }
    if (!few.empty())
      result_.notes.push_back(fmt::format("Fewer than {} seeds fitted in the budget: {}.",
                                          options_.seeds, fmt::join(few, ", ")));
  }

  StudyOptions const& options_;
  Runner runner_;
  StudyResult result_;
  int count_ = 0;
  int reference_bands_ = 0;
  double reserve_s_ = 0; ///< of the budget, not for further settings now
};

} // namespace

Result<Reference> parse_reference(std::string const& text) {
  Reference reference;
  std::size_t at = 0;
  while (at < text.size()) {
    auto const end = std::min(text.find(',', at), text.size());
    std::string const part = text.substr(at, end - at);
    at = end + 1;
    if (part.starts_with("bands=")) {
      int bands = 0;
      auto const [stop, failed] =
          std::from_chars(part.data() + 6, part.data() + part.size(), bands);
      if (failed != std::errc() || stop != part.data() + part.size() || bands < 1 || bands > 1000)
        return Error{"E0530", fmt::format("'{}': bands from 1 to 1000", part)};
      reference.bands = bands;
    } else if (part.starts_with("aa=")) {
      auto const sampling = parse_sampling(part.substr(3));
      if (!sampling) return sampling.error();
      reference.aa = sampling->text;
    } else {
      return Error{"E0530",
                   fmt::format("reference '{}': expected bands=N, aa=off or aa=N[/T]", part)};
    }
  }
  return reference;
}

Result<StudyResult> run_study(StudyOptions const& options) {
  return Study(options).run();
}

fs::path picture_of(fs::path const& folder, Setting const& setting) {
  return folder / "runs" / (file_name(setting.name) + ".s0.exr");
}

fs::path cost_map_of(fs::path const& folder, Setting const& setting) {
  return folder / "runs" / ("rays-" + file_name(setting.name) + ".s0.rays.exr");
}

fs::path reference_picture(fs::path const& folder) {
  return folder / "reference.exr";
}

} // namespace abbe::study
