// SPDX-License-Identifier: MIT
#include "cli/bad_sample_text.hpp"
#include "cli/commands.hpp"
#include "cli/identity.hpp"
#include "cli/progress_bar.hpp"
#include "cli/render_arguments.hpp"
#include "cli/render_target.hpp"
#include "cli/say.hpp"
#include "job/interrupt.hpp"
#include "job/picture_file.hpp"
#include "job/stats.hpp"
#include "job/with_alpha.hpp"

#include <fmt/format.h>

#include <utility>

namespace abbe::cli {
namespace {

image::WriteOptions write_options(RenderArguments const& arguments, bool spectral) {
  image::WriteOptions write;
  write.exr.spectral = arguments.scene.spectral;
  write.exr.depth =
      arguments.half ? image::ExrOptions::Depth::Half : image::ExrOptions::Depth::Float;
  write.display.tone.exposure_ev = arguments.exposure_ev;
  bool const clip = arguments.gamut == "clip" || (arguments.gamut == "auto" && !spectral);
  write.display.tone.gamut = clip                       ? image::Gamut::Clip
                             : arguments.gamut == "hue" ? image::Gamut::Hue
                                                        : image::Gamut::Standard;
  return write;
}

job::Keeping keeping_of(RenderArguments const& arguments, lang::Evaluated const& evaluated) {
  job::Keeping keeping;
  if (arguments.no_checkpoint || !arguments.cost_map.empty() || arguments.target.seconds > 0)
    return keeping;
  keeping.when =
      arguments.checkpoint ? job::Keeping::When::FromTheFirst : job::Keeping::When::AfterAWhile;
  keeping.path = arguments.output + ".abbe-checkpoint";
  keeping.resume = arguments.resume;
  std::string words;
  for (auto const& declaration : arguments.scene.declarations) words += declaration + '\n';
  words += fmt::format("{} {} {} {} {} {} {}", arguments.scene.frame.number, arguments.alpha,
                       arguments.scene.bands.value_or(0), arguments.scene.dispersion,
                       arguments.scene.representation, arguments.scene.spacing,
                       arguments.scene.spectral);
  keeping.scene_identity = scene_identity(evaluated, words);
  return keeping;
}

void say_resumed(std::filesystem::path const& path, std::size_t tiles) {
  if (tiles == 0)
    say("abbe: nothing to resume in '{}': from the beginning\n", path.string());
  else
    say("abbe: {} tiles resumed from '{}'\n", tiles, path.string());
}

/// The exit status.
int say_interrupted(RenderArguments const& arguments, job::Outcome const& outcome) {
  say("abbe: interrupted; {} was not written\n", arguments.output);
  if (!outcome.resumable.empty())
    say("abbe: what is done is in '{}': the same command with --resume goes on from there\n",
        outcome.resumable.string());
  return job::interrupted_status();
}

/// Says why there is no picture. The exit status, 0: there is one.
int say_end(RenderArguments const& arguments, job::Outcome const& outcome) {
  using End = job::Outcome::End;
  switch (outcome.end) {
  case End::Done:
    if (!outcome.not_kept.empty()) say("abbe: no checkpoint could be kept: {}\n", outcome.not_kept);
    return 0;
  case End::Interrupted:
    return say_interrupted(arguments, outcome);
  case End::BadSample:
    say("abbe render: {}", bad_sample_text(*outcome.result.bad_sample));
    if (outcome.in_passes) say("  in pass {}\n", outcome.result.passes + 1);
    return 1;
  case End::NotResumed:
    return render_failed(*outcome.error, outcome.error->code == "E0520" ? 1 : 3);
  case End::NotTaken:
    return render_failed(*outcome.error, outcome.error->code == "E0710" ? 1 : 3);
  }
  ABBE_ASSERT(false);
}

/// Can the file be written, as far as can be told? The exit status, 0: go on.
int check_output(std::string const& path) {
  auto const writable = image::check_destination(path);
  if (writable) return 0;
  return render_failed(writable.error(), writable.error().code == "E0512" ? 2 : 3);
}

/// What was asked for beside the picture. The exit status, 0: done.
int write_records(RenderArguments const& arguments, job::Before const& before,
                  plan::Plan const& plan, job::Outcome const& outcome) {
  image::Status written = std::monostate();
  if (!arguments.stats.empty())
    written = job::write_stats(arguments.stats, before, plan, arguments.options, outcome);
  if (written && !arguments.cost_map.empty())
    written = job::write_cost_map(arguments.cost_map, arguments.options, outcome);
  return written ? 0 : render_failed(written.error(), 3);
}

/// One picture. The exit status.
int render_scene(RenderArguments& arguments) {
  Stopwatch const all;
  int status = 0;
  lang::Evaluated* const evaluated = load_scene(arguments.scene, status);
  if (!evaluated) return status;
  render::RenderOptions& options = arguments.options;
  options.width = arguments.scene.width;
  options.height = arguments.scene.height;
  options.stop = &job::interrupted();
  options.spectral_output = arguments.scene.spectral;
  if (int const bad = settle_samples(arguments, evaluated->scene.settings)) return bad;
  std::string chosen;
  if (arguments.has_target())
    if (int const failed = choose(arguments, *evaluated, all, chosen)) return failed;
  auto const plan = plan_scene(*evaluated, arguments.scene, status);
  if (!plan) return status;
  if (int const bad = check_passes(arguments, *plan)) return bad;

  job::Options job;
  job.render = options;
  job.keeping = keeping_of(arguments, *evaluated);
  job.count_rays = !arguments.cost_map.empty();
  if (arguments.target.seconds > 0) job.deadline = job::Deadline{arguments.target.seconds, all};
  ProgressBar bar(arguments.scene.quiet);
  job.render.on_progress = [&bar](render::Progress const& progress) { bar.show(progress); };
  if (!arguments.scene.quiet)
    job.on_resumed = [&](std::size_t tiles) { say_resumed(job.keeping.path, tiles); };
  auto const name = std::filesystem::path(arguments.scene.scene).filename().string();
  auto head = job::head_of(options, *plan, name);
  head.alpha = arguments.alpha;
  job::PictureFile file(arguments.output, write_options(arguments, plan->spectral.has_value()),
                        std::move(head));
  job::Before const before{arguments.scene.scene, all.wall_s(), all.cpu_s()};
  auto const outcome = arguments.alpha
                           ? job::run_with_alpha(std::move(evaluated->scene), *plan,
                                                 overrides_of(arguments.scene), job, file)
                           : job::run(std::move(evaluated->scene), *plan, job, file);
  bar.finish();
  if (int const failed = say_end(arguments, outcome)) return failed;
  if (int const failed = write_records(arguments, before, *plan, outcome)) return failed;
  if (!arguments.scene.quiet) {
    auto const region = options.pixels();
    say("{}: {} x {}, {}, {:.2f} s, {} rays\n", arguments.output, region.x1 - region.x0,
        region.y1 - region.y0, plan::describe_channels(*plan), all.wall_s(),
        outcome.result.counts.total());
    if (arguments.target.seconds > 0) say_again(arguments, chosen, outcome.result.passes);
  }
  give_up(evaluated);
  return 0;
}

int check_outputs(RenderArguments& arguments) {
  if (arguments.output.empty())
    arguments.output = arguments.scene.scene == "-"
                           ? std::string("stdin.png")
                           : std::filesystem::path(arguments.scene.scene).stem().string() + ".png";
  if (int const bad = check_output(arguments.output)) return bad;
  if (!arguments.cost_map.empty())
    if (int const bad = check_output(arguments.cost_map)) return bad;
  return check(arguments);
}

/// OUTn.png for each frame, n in as many digits as the last one has.
int render_frames(RenderArguments const& arguments) {
  std::filesystem::path const output(arguments.output);
  auto const digits = std::to_string(arguments.last_frame).size();
  int const steps = arguments.last_frame - arguments.first_frame;
  for (int number = arguments.first_frame; number <= arguments.last_frame; ++number) {
    RenderArguments one = arguments;
    one.output = (output.parent_path()
                  / fmt::format("{}{:0{}}{}", output.stem().string(), number, digits,
                                output.extension().string()))
                     .string();
    auto& frame = one.scene.frame;
    frame.clock_on = true;
    frame.final_clock = 1;
    frame.clock_delta = steps > 0 ? 1.0 / steps : 0;
    frame.number = number;
    frame.initial_frame = arguments.first_frame;
    frame.final_frame = arguments.last_frame;
    frame.clock = frame.clock_delta * (number - arguments.first_frame);
    if (int const status = render_scene(one)) return status;
  }
  return 0;
}

} // namespace

int run_render(int argc, char** argv) {
  RenderArguments arguments;
  CommandLine app("Renders a scene.", "abbe render");
  add_options(app, arguments);
  if (int const status = app.parse(argc, argv); status >= 0) return status;
  arguments.aa_given = app.has("--aa") || app.has("--aa-method") || app.has("--samples");
  arguments.target.keep_aa = arguments.aa_given;
  if (int const bad = check_outputs(arguments)) return bad;
  return arguments.frames.empty() ? render_scene(arguments) : render_frames(arguments);
}

} // namespace abbe::cli
