// SPDX-License-Identifier: MIT
#include "cli/bad_sample_text.hpp"
#include "cli/commands.hpp"
#include "cli/identity.hpp"
#include "cli/povray/frames.hpp"
#include "cli/povray/options.hpp"
#include "cli/povray/sinks.hpp"
#include "cli/say.hpp"
#include "cli/scene_arguments.hpp"
#include "job/interrupt.hpp"
#include "job/picture_file.hpp"
#include "job/with_alpha.hpp"

#include <chrono>
#include <cmath>
#include <fmt/format.h>

namespace abbe::cli {
namespace fs = std::filesystem;
namespace {

/// POV-Ray's exit statuses.
constexpr int failed = 1, aborted = 2;

constexpr char const* usage =
    "usage: abbe povray [SCENE.pov] [FILE.ini] [SWITCHES] [KEY=VALUE]...\n"
    "       (or as a program of the name povray)\n\n"
    "POV-Ray's command line: +Ifile +Ofile|- +Wn +Hn +A[threshold] +AMn +Rn +J[amount] +Qn "
    "+F[type]\n"
    "+UA +SCn +ECn +SRn +ERn +C +Lpath +WTn +K +KFIn +KFFn +KIn +KFn +SFn +EFn +KC, ini files "
    "with\n"
    "sections, Declare=NAME=VALUE. What has no effect on the picture is accepted. docs/povray.md "
    "has\n"
    "the list.\n";

int wrong(std::string const& text) {
  say("povray: {}\n", text);
  return failed;
}

int wrong(Error const& error) {
  return wrong(fmt::format("error[{}]: {}", error.code, error.message));
}

/// "Rendered n of m pixels (p%)", which programs look for, no more often than they read it.
class ProgressLine {
public:
  ProgressLine(bool shown, std::int64_t pixels) : shown_(shown), pixels_(pixels) {}
  void show(double share) {
    auto const now = std::chrono::steady_clock::now();
    if (!shown_ || (share < 1 && now - last_ < std::chrono::milliseconds(500))) return;
    last_ = now;
    auto const done = static_cast<std::int64_t>(share * static_cast<double>(pixels_));
    say_progress(fmt::format("\rRendered {} of {} pixels ({}%)", done, pixels_,
                             static_cast<int>(100 * share)));
    begun_ = true;
  }
  void finish() {
    if (!shown_) return;
    show(1);
    if (begun_) say_text("\n");
  }

private:
  bool shown_, begun_ = false;
  std::int64_t pixels_;
  std::chrono::steady_clock::time_point last_{};
};

/// The scene's file: as named, with .pov behind it, or in a library path. Empty: none is there.
std::string find_input(PovraySettings const& settings) {
  if (settings.input == "-") return "-";
  std::error_code none;
  for (std::string const& name : {settings.input, settings.input + ".pov"}) {
    if (fs::exists(name, none)) return name;
    for (auto const& folder : settings.library_paths)
      if (fs::path(name).is_relative() && fs::exists(fs::path(folder) / name, none))
        return (fs::path(folder) / name).string();
  }
  return "";
}

/// Statements that the options have read before the scene.
std::string statements_before(PovraySettings const& settings) {
  std::string text;
  if (settings.version) text += fmt::format("#version {};\n", *settings.version);
  if (settings.header.empty()) return text;
  text += "#include \"";
  for (char const c : settings.header) (text += c == '"' ? "\\" : "") += c;
  return text + "\"\n";
}

SceneArguments scene_arguments(PovraySettings const& settings, lang::AnimationFrame const& frame,
                               std::string const& input) {
  SceneArguments scene;
  scene.scene = input;
  scene.width = settings.width;
  scene.height = settings.height;
  scene.declarations = settings.declarations;
  scene.before = statements_before(settings);
  scene.include_dirs = settings.library_paths;
  scene.allow_write = true; // below the scene's folder, as POV-Ray's own restrictions have it
  scene.quiet = !settings.messages;
  scene.frame = frame;
  scene.quality = settings.quality;
  return scene;
}

render::RenderOptions render_options(PovraySettings const& settings,
                                     std::optional<render::Region> const& part) {
  render::RenderOptions options;
  options.width = settings.width;
  options.height = settings.height;
  options.threads = settings.threads;
  options.region = part;
  options.stop = &job::interrupted();
  if (settings.antialias) {
    auto& aa = options.anti_aliasing;
    aa.method = settings.sampling_method;
    aa.depth = settings.antialias_depth;
    aa.threshold = settings.antialias_threshold;
    aa.jitter = settings.jitter ? settings.jitter_amount : 0;
  }
  return options;
}

image::WriteOptions write_options(PovraySettings const& settings) {
  image::WriteOptions write;
  auto& display = write.display;
  bool const deep = settings.bits > 8 && (settings.type == 'N' || settings.type == 'P');
  display.bits = deep ? 16 : 8;
  display.tone.gamut = image::Gamut::Clip;
  display.gamma = settings.file_gamma;
  display.compress = settings.type == 'C';
  if (settings.compression && *settings.compression > 0) display.quality = *settings.compression;
  return write;
}

/// One picture of the series.
class Frame {
public:
  Frame(PovraySettings const& settings, lang::AnimationFrame const& frame)
      : settings_(settings), frame_(frame) {}

  /// The exit status.
  int render(std::string const& input, std::optional<render::Region> const& part) {
    fs::path path = picture_path(settings_, frame_);
    bool const to_output = settings_.output == "-";
    std::optional<TemporaryFolder> folder;
    if (to_output && settings_.to_file) {
      folder.emplace();
      if (folder->path().empty()) return wrong("cannot make a temporary folder");
      path = folder->path() / path.filename();
    }
    if (settings_.to_file)
      if (auto const writable = image::check_destination(path); !writable)
        return wrong(writable.error());
    auto const arguments = scene_arguments(settings_, frame_, input);
    int status = 0;
    lang::Evaluated* const evaluated = load_scene(arguments, status);
    if (!evaluated) return job::interrupted() ? aborted : failed;
    auto const plan = plan_scene(*evaluated, arguments, status);
    if (!plan) return failed;
    status = trace(*evaluated, *plan, path, part);
    give_up(evaluated);
    if (status != 0 || !folder) return status;
    auto const copied = copy_to_standard_output(path);
    return copied ? 0 : wrong(copied.error());
  }

private:
  int trace(lang::Evaluated& evaluated, plan::Plan const& plan, fs::path const& path,
            std::optional<render::Region> const& part) {
    job::Options job;
    job.render = render_options(settings_, part);
    if (!settings_.antialias && evaluated.scene.settings.samples)
      job.render.anti_aliasing = render::AntiAliasing::of(*evaluated.scene.settings.samples);
    auto const shown = job.render.pixels();
    ProgressLine progress(settings_.verbose,
                          std::int64_t{shown.x1 - shown.x0} * (shown.y1 - shown.y0));
    job.render.on_progress = [&](render::Progress const& now) { progress.show(now.share); };
    if (settings_.to_file && settings_.output != "-") keep(job.keeping, evaluated, path);
    auto head = job::head_of(job.render, plan, fs::path(settings_.input).filename().string());
    head.width = settings_.width;
    head.height = settings_.height;
    head.alpha = settings_.alpha;
    job::PictureFile file(path, write_options(settings_), head);
    WholePicture whole(file, shown, settings_.width, settings_.height);
    NoPicture nothing;
    job::Sink& sink = !settings_.to_file ? static_cast<job::Sink&>(nothing)
                      : part             ? static_cast<job::Sink&>(whole)
                                         : file;
    auto const outcome = settings_.alpha
                             ? job::run_with_alpha(std::move(evaluated.scene), plan, {}, job, sink)
                             : job::run(std::move(evaluated.scene), plan, job, sink);
    progress.finish();
    return say_end(outcome, path);
  }

  void keep(job::Keeping& keeping, lang::Evaluated const& evaluated, fs::path const& path) const {
    keeping.when = job::Keeping::When::AfterAWhile;
    keeping.path = path.string() + ".abbe-checkpoint";
    std::error_code none;
    keeping.resume = settings_.continue_trace && fs::exists(keeping.path, none);
    std::string words = fmt::format("{} {} {}", settings_.quality, settings_.alpha, frame_.number);
    for (auto const& each : settings_.declarations) words += '\n' + each;
    words += '\n' + statements_before(settings_);
    keeping.scene_identity = scene_identity(evaluated, words);
  }

  int say_end(job::Outcome const& outcome, fs::path const& path) const {
    using End = job::Outcome::End;
    switch (outcome.end) {
    case End::Done:
      if (settings_.verbose && settings_.to_file && settings_.output != "-")
        say("povray: {} written\n", path.string());
      return 0;
    case End::Interrupted:
      say("povray: interrupted; {} was not written{}\n", path.string(),
          outcome.resumable.empty() ? "" : "; the same command with +C goes on");
      return aborted;
    case End::BadSample:
      say("povray: {}", bad_sample_text(*outcome.result.bad_sample));
      return failed;
    case End::NotResumed:
    case End::NotTaken:
      return wrong(*outcome.error);
    }
    ABBE_ASSERT(false);
  }

  PovraySettings const& settings_;
  lang::AnimationFrame const& frame_;
};

/// The part of the picture that is asked for; nullopt: all of it.
Result<std::optional<render::Region>> part_of(PovraySettings const& settings) {
  auto const columns = pixel_range(settings.start_column, settings.end_column, settings.width);
  if (!columns) return columns.error();
  auto const rows = pixel_range(settings.start_row, settings.end_row, settings.height);
  if (!rows) return rows.error();
  render::Region const region{columns->begin, rows->begin, columns->end, rows->end};
  bool const all =
      region.x1 - region.x0 == settings.width && region.y1 - region.y0 == settings.height;
  return all ? std::optional<render::Region>() : std::optional(region);
}

int render_all(PovraySettings const& settings) {
  if (settings.input.empty()) return wrong("no input file provided");
  std::string const input = find_input(settings);
  if (input.empty())
    return wrong(
        fmt::format("cannot find the file '{}', nor '{}.pov'", settings.input, settings.input));
  auto const frames = frames_of(settings);
  if (!frames) return wrong(frames.error());
  auto const part = part_of(settings);
  if (!part) return wrong(part.error());
  for (auto const& remark : settings.remarks) say("povray: warning: {}\n", remark);
  for (auto const& frame : *frames) {
    std::error_code none;
    if (settings.continue_trace && is_series(settings)
        && fs::exists(picture_path(settings, frame), none))
      continue; // an earlier run made it
    if (settings.verbose && is_series(settings))
      say("povray: frame {} of {} to {}, clock {:g}\n", frame.number, frames->front().number,
          frames->back().number, frame.clock);
    if (int const status = Frame(settings, frame).render(input, *part)) return status;
  }
  return 0;
}

} // namespace

int run_povray(int argc, char** argv) {
  PovrayOptions options;
  if (auto const bad = options.read_defaults(); !bad.empty()) return wrong(bad);
  for (int i = 1; i < argc; ++i) {
    std::string const word = argv[i];
    if (word == "--help" || word == "-help" || word == "-h" || word == "-?") {
      fmt::print("{}", usage);
      return 0;
    }
    if (word == "--version" || word == "-version") {
      fmt::print("abbe {} in place of POV-Ray 3.7\n", ABBE_VERSION);
      return 0;
    }
    if (auto const bad = options.read_word(word); !bad.empty()) return wrong(bad);
  }
  return render_all(options.settings);
}

} // namespace abbe::cli
