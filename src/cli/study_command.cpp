// SPDX-License-Identifier: MIT
#include "cli/commands.hpp"
#include "cli/identity.hpp"
#include "cli/paper_command.hpp"
#include "cli/say.hpp"
#include "cli/scene_arguments.hpp"
#include "job/identity.hpp"
#include "job/interrupt.hpp"
#include "lang/folders.hpp"
#include "study/report.hpp"
#include "study/study.hpp"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <unistd.h>

/// study: what accuracy costs in time, for a scene.
namespace abbe::cli {
namespace {

struct Arguments {
  SceneArguments scene;
  std::vector<std::string> modes;
  std::vector<int> bands{4, 8, 16, 45};
  std::vector<std::string> aa{"off"};
  study::Reference reference;
  std::string reference_text;
  double budget_s = 300;
  std::string budget_text = "5m";
  int seeds = 2;
  int threads = 0;
  std::string folder;
};

int fail(Error const& error, int status) {
  say("abbe study: error[{}]: {}\n", error.code, error.message);
  return status;
}

void add_options(CommandLine& app, Arguments& arguments) {
  arguments.scene.width = 320;
  arguments.scene.height = 240;
  arguments.scene.add_to(app, false);
  app.add_option("--modes", arguments.modes, "what is compared (default: all modes)")
      .type_name("NAME,...")
      .separated_by(',');
  app.add_option("--bands", arguments.bands, "numbers of bands")
      .type_name("N,...")
      .separated_by(',')
      .range(1, 1000)
      .show_default();
  app.add_option("--aa", arguments.aa,
                 "anti-aliasing: off, a depth, depth/threshold, or samples (s16, s1..64/0.05)")
      .type_name("off|N[/T]|sA[..B[/E]],...")
      .separated_by(',')
      .show_default();
  app.add_option("--reference", arguments.reference_text,
                 "what all is compared with (default: 450 bands or what a third of the budget is "
                 "enough for, anti-aliasing as the finest of the study)")
      .type_name("bands=N,aa=N[/T]");
  app.add_option("--budget", arguments.budget_text, "time for all of it: seconds, or as 90s, 10m")
      .type_name("TIME")
      .check([&](std::string const& text) { return parse_duration(text, arguments.budget_s); })
      .show_default();
  app.add_option("--seeds", arguments.seeds, "runs of each stochastic setting")
      .range(1, 1000)
      .show_default();
  app.add_option("-j,--threads", arguments.threads, "threads of each run (default: one a core)")
      .range(1, 1024);
  app.add_option("-o,--output", arguments.folder,
                 "folder of the results (default: SCENE-study); what is there already is not run "
                 "again")
      .type_name("DIR");
}

/// Where the study is, on one line of a terminal; elsewhere a line a setting.
class StudyProgress {
public:
  explicit StudyProgress(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) == 1) {}
  ~StudyProgress() { finish(); }

  void show(study::Progress const& progress) {
    if (quiet_) return;
    auto const line =
        fmt::format("{}/{}  {}  ({:.0f} s, {:.0f} s left)", progress.done, progress.total,
                    progress.now, progress.elapsed_s, progress.left_s);
    if (terminal_)
      say_progress(fmt::format("\r{}\033[K", printable(line)));
    else
      say("abbe study: {}\n", line);
    shown_ = true;
  }
  void finish() {
    if (shown_ && terminal_) say_progress("\r\033[K");
    shown_ = false;
  }

private:
  bool quiet_, terminal_, shown_ = false;
};

std::string words_of(int argc, char** argv) {
  std::string line = "abbe";
  for (int i = 0; i < argc; ++i) {
    std::string_view const word = i == 0 ? "study" : argv[i];
    bool const plain = word.find_first_of(" \t'\"\\$*?&|;<>()") == std::string_view::npos;
    line += plain ? fmt::format(" {}", word) : fmt::format(" '{}'", word);
  }
  return line;
}

int run(Arguments& arguments, std::string const& command) {
  int status = 0;
  auto& scene = arguments.scene;
  lang::Evaluated const* const evaluated = load_scene(scene, status);
  if (!evaluated) return status;

  study::StudyOptions options;
  options.program = "/proc/self/exe";
  options.scene = scene.scene;
  options.width = scene.width;
  options.height = scene.height;
  for (auto const& declaration : scene.declarations)
    options.scene_words.insert(options.scene_words.end(), {"-D", declaration});
  for (auto const& dir : scene.include_dirs)
    options.scene_words.insert(options.scene_words.end(), {"-I", dir});
  for (auto const& dir : scene.read_dirs)
    options.scene_words.insert(options.scene_words.end(), {"--allow-read", dir});
  if (scene.allow_write) options.scene_words.push_back("--allow-write");
  if (arguments.threads > 0)
    options.scene_words.insert(options.scene_words.end(),
                               {"-j", std::to_string(arguments.threads)});
  options.max_level = evaluated->scene.settings.max_trace_level.value_or(options.max_level);
  render::RenderOptions picture;
  picture.width = scene.width;
  picture.height = scene.height;
  options.identity =
      fmt::format("{:016x}", job::picture_identity(scene_identity(*evaluated, ""), picture));
  options.folder = arguments.folder.empty()
                       ? std::filesystem::path(scene.scene).stem().string() + "-study"
                       : arguments.folder;
  options.selection = {arguments.modes, arguments.bands, arguments.aa};
  options.reference = arguments.reference;
  options.budget_s = arguments.budget_s;
  options.seeds = arguments.seeds;
  options.stop = &job::interrupted();
  StudyProgress progress(scene.quiet);
  options.on_progress = [&](study::Progress const& now) { progress.show(now); };

  auto const result = study::run_study(options);
  progress.finish();
  if (job::interrupted()) {
    say("abbe: interrupted; the same command goes on from what is in '{}'\n",
        options.folder.string());
    return job::interrupted_status();
  }
  if (!result)
    return fail(result.error(), result.error().code == "E0510"   ? 3
                                : result.error().code == "E0530" ? 2
                                                                 : 1);
  auto const written =
      study::write_report(*result, options, {command, ABBE_VERSION, lang::stdlib_dir() / "study"});
  if (!written) return fail(written.error(), 3);
  fmt::print("{}", study::to_text(*result));
  if (!scene.quiet)
    say("abbe: {} ({:.0f} s)\n", (options.folder / "report.html").string(), result->elapsed_s);
  return 0;
}

} // namespace

int run_study(int argc, char** argv) {
  if (std::any_of(argv + 1, argv + argc,
                  [](char const* word) { return std::string_view(word) == "--paper"; }))
    return run_paper(argc, argv);
  Arguments arguments;
  CommandLine app(
      "Renders a scene under many settings and measures what each costs and how far it is from a\n"
      "reference: a table, and study.json, study.csv and report.html in a folder.\n"
      "`abbe study --paper` makes docs/paper.md instead: the figures and the timing table of the "
      "paper.",
      "abbe study");
  add_options(app, arguments);
  auto const command = words_of(argc, argv);
  if (int const status = app.parse(argc, argv); status >= 0) return status;
  std::sort(arguments.bands.begin(), arguments.bands.end());
  auto const reference = study::parse_reference(arguments.reference_text);
  if (!reference) return fail(reference.error(), 2);
  arguments.reference = *reference;
  auto const settings = study::make_settings({arguments.modes, arguments.bands, arguments.aa});
  if (!settings) return fail(settings.error(), 2);
  return run(arguments, command);
}

} // namespace abbe::cli
