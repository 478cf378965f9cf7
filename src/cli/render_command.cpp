// SPDX-License-Identifier: MIT
#include "base/stopwatch.hpp"
#include "cli/bad_sample_text.hpp"
#include "cli/commands.hpp"
#include "cli/identity.hpp"
#include "cli/progress_bar.hpp"
#include "cli/render_arguments.hpp"
#include "cli/render_stats.hpp"
#include "cli/render_target.hpp"
#include "image/writer.hpp"
#include "render/checkpoint.hpp"
#include "render/passes.hpp"
#include "render/render.hpp"

#include <fmt/format.h>

#include <utility>

namespace abbe::cli {
namespace {

image::WriteOptions write_options(RenderArguments const& arguments) {
  image::WriteOptions write;
  write.exr.spectral = arguments.scene.spectral;
  write.exr.depth =
      arguments.half ? image::ExrOptions::Depth::Half : image::ExrOptions::Depth::Float;
  write.png.tone.exposure_ev = arguments.exposure_ev;
  write.png.tone.gamut = arguments.gamut == "clip"  ? image::Gamut::Clip
                         : arguments.gamut == "hue" ? image::Gamut::Hue
                                                    : image::Gamut::Standard;
  return write;
}

/// @param passes that it has
image::ImageHead head_of(RenderArguments const& arguments, plan::Plan const& plan, int passes) {
  image::ImageHead head;
  auto const& options = arguments.options;
  render::Region const region = options.pixels();
  head.width = region.x1 - region.x0;
  head.height = region.y1 - region.y0;
  if (options.spectral_output) {
    auto const centers = plan.spectral->bands.centers();
    auto const edges = plan.spectral->bands.edges();
    head.band_centres_nm.assign(centers.begin(), centers.end());
    head.band_edges_nm.assign(edges.begin(), edges.end());
  }
  head.metadata = {{"Software", fmt::format("abbe {}", ABBE_VERSION)},
                   {"Scene", std::filesystem::path(arguments.scene.scene).filename().string()},
                   {"Plan", plan::describe(plan)},
                   {"Seed", fmt::format("{}", options.seed)},
                   {"AntiAliasing", options.anti_aliasing.method == 0
                                        ? std::string("off")
                                        : fmt::format("{}", options.anti_aliasing.depth)}};
  if (passes > 1) head.metadata.emplace_back("Passes", fmt::format("{}", passes));
  head.late_keys = {"MissingLight"};
  return head;
}

/// The file, opened when the first rows are done: a short render leaves nothing beside it.
class Output {
public:
  /// @param passes how many there are, when the first rows are done
  Output(RenderArguments const& arguments, plan::Plan const& plan, int const& passes)
      : arguments_(arguments), plan_(plan), passes_(passes) {}

  bool write(image::Image const& rows) {
    if (!writer_) {
      auto opened = image::open_writer(head_of(arguments_, plan_, passes_), arguments_.output,
                                       write_options(arguments_));
      if (!opened) return failed(opened.error());
      writer_ = std::move(*opened);
    }
    auto const written = writer_->write(rows);
    return written ? true : failed(written.error());
  }

  bool finish(render::RenderResult const& result) {
    if (error_) return false;
    auto const done = writer_->finish({fmt::format("at most {:.3g}, in no sample more than {:.3g}",
                                                   result.missing_mean, result.missing_most)});
    return done ? true : failed(done.error());
  }

  std::optional<Error> const& error() const { return error_; }

private:
  bool failed(Error error) {
    error_ = std::move(error);
    return false;
  }
  RenderArguments const& arguments_;
  plan::Plan const& plan_;
  int const& passes_;
  std::unique_ptr<image::ImageWriter> writer_;
  std::optional<Error> error_;
};

/// How long a render must have run before it leaves a checkpoint: what is lost is no more.
constexpr double checkpoint_after_seconds = 5;

std::unique_ptr<render::Checkpoint> make_checkpoint(RenderArguments const& arguments,
                                                    lang::Evaluated const& evaluated) {
  if (arguments.no_checkpoint || !arguments.cost_map.empty() || arguments.target.seconds > 0)
    return nullptr;
  std::string words;
  for (auto const& declaration : arguments.scene.declarations) words += declaration + '\n';
  words += fmt::format("{} {} {} {} {}", arguments.scene.bands.value_or(0),
                       arguments.scene.dispersion, arguments.scene.representation,
                       arguments.scene.spacing, arguments.scene.spectral);
  return std::make_unique<render::Checkpoint>(arguments.output + ".abbe-checkpoint",
                                              arguments.checkpoint ? 0 : checkpoint_after_seconds,
                                              [&evaluated, &options = arguments.options, words] {
                                                return picture_identity(evaluated, options, words);
                                              });
}

/// The exit status when the checkpoint cannot be gone on from, else 0.
int resume(RenderArguments const& arguments, render::Checkpoint& checkpoint) {
  auto const tiles = checkpoint.resume();
  if (!tiles) return render_failed(tiles.error(), tiles.error().code == "E0520" ? 1 : 3);
  if (arguments.scene.quiet) return 0;
  if (*tiles == 0)
    fmt::print(stderr, "abbe: nothing to resume in '{}': from the beginning\n",
               checkpoint.path().string());
  else
    fmt::print(stderr, "abbe: {} tiles resumed from '{}'\n", *tiles, checkpoint.path().string());
  return 0;
}

int say_interrupted(RenderArguments const& arguments, render::Checkpoint const* checkpoint) {
  fmt::print(stderr, "abbe: interrupted; {} was not written\n", arguments.output);
  if (checkpoint && checkpoint->written())
    fmt::print(stderr,
               "abbe: what is done is in '{}': the same command with --resume goes on from there\n",
               checkpoint->path().string());
  return 130;
}

/// What was asked for beside the picture. The exit status, 0: done.
int write_records(RenderArguments const& arguments, RenderStats stats, Stopwatch const& all,
                  plan::Plan const& plan, render::RenderResult const& result) {
  auto const& options = arguments.options;
  if (!arguments.stats.empty()) {
    stats.render_wall_s = all.wall_s() - stats.scene_wall_s;
    stats.render_cpu_s = all.cpu_s() - stats.scene_cpu_s;
    auto const written = write_stats(arguments.stats, stats, plan, options, result);
    if (!written) return render_failed(written.error(), 3);
  }
  if (!arguments.cost_map.empty()) {
    render::Region const region = options.pixels();
    auto const written = write_cost_map(arguments.cost_map, *options.rays_of_pixels,
                                        region.x1 - region.x0, region.y1 - region.y0);
    if (!written) return render_failed(written.error(), 3);
  }
  return 0;
}

int render_scene(RenderArguments& arguments) {
  if (arguments.output.empty())
    arguments.output = std::filesystem::path(arguments.scene.scene).stem().string() + ".png";
  auto const writable = image::check_destination(arguments.output);
  if (!writable) return render_failed(writable.error(), writable.error().code == "E0512" ? 2 : 3);
  if (!arguments.cost_map.empty()) {
    auto const map = image::check_destination(arguments.cost_map);
    if (!map) return render_failed(map.error(), map.error().code == "E0512" ? 2 : 3);
  }
  if (int const bad = check(arguments)) return bad;

  Stopwatch const all;
  int status = 0;
  lang::Evaluated* const evaluated = load_scene(arguments.scene, status);
  if (!evaluated) return status;
  render::RenderOptions& options = arguments.options;
  options.width = arguments.scene.width;
  options.height = arguments.scene.height;
  options.stop = &interrupted();
  options.spectral_output = arguments.scene.spectral;
  std::string chosen;
  if (arguments.has_target())
    if (int const failed = choose(arguments, *evaluated, all, chosen)) return failed;
  auto const plan = plan_scene(*evaluated, arguments.scene, status);
  if (!plan) return status;
  if (int const bad = check_passes(arguments, *plan)) return bad;

  std::vector<float> rays_of_pixels;
  if (!arguments.cost_map.empty()) options.rays_of_pixels = &rays_of_pixels;
  auto const checkpoint = make_checkpoint(arguments, *evaluated);
  if (arguments.resume)
    if (int const failed = resume(arguments, *checkpoint)) return failed;
  options.checkpoint = checkpoint.get();
  ProgressBar bar(arguments.scene.quiet);
  options.on_progress = [&bar](render::Progress const& progress) { bar.show(progress); };
  int passes = options.passes;
  bool const by_clock = arguments.target.seconds > 0
                        && render::passes_differ(*plan, options.anti_aliasing)
                        && passes_fit(arguments, *plan);
  if (by_clock)
    options.passes_wanted = [&passes, clock = PassClock(arguments.target.seconds, all)](int done) {
      passes = done;
      return clock.wanted(done);
    };
  Output output(arguments, *plan, passes);
  options.on_rows = [&output](image::Image const& rows) { return output.write(rows); };
  RenderStats stats{arguments.scene.scene, all.wall_s(), all.cpu_s()};
  auto const result = render::render(std::move(evaluated->scene), *plan, options);
  bar.finish();
  if (result.interrupted) return say_interrupted(arguments, checkpoint.get());
  if (result.bad_sample) {
    fmt::print(stderr, "abbe render: {}", bad_sample_text(*result.bad_sample));
    if (passes > 1 || by_clock) fmt::print(stderr, "  in pass {}\n", result.passes + 1);
    if (checkpoint) checkpoint->remove();
    return 1;
  }
  if (!output.finish(result)) return render_failed(*output.error(), 3);
  if (checkpoint) {
    if (!checkpoint->problem().empty())
      fmt::print(stderr, "abbe: no checkpoint could be kept: {}\n", checkpoint->problem());
    checkpoint->remove();
  }
  if (int const failed = write_records(arguments, stats, all, *plan, result)) return failed;
  if (!arguments.scene.quiet) {
    double const seconds = all.wall_s();
    fmt::print(stderr, "{}: {} x {}, {}, {:.2f} s, {} rays\n", arguments.output,
               options.region ? options.region->x1 - options.region->x0 : options.width,
               options.region ? options.region->y1 - options.region->y0 : options.height,
               plan::describe_channels(*plan), seconds, result.counts.total());
    if (arguments.target.seconds > 0) say_again(arguments, chosen, result.passes);
  }
  return 0;
}

} // namespace

int run_render(int argc, char** argv) {
  RenderArguments arguments;
  CLI::App app("Renders a scene.", "abbe render");
  add_options(app, arguments);
  if (int const status = parse_arguments(app, argc, argv); status >= 0) return status;
  arguments.target.keep_aa = app.count("--aa") + app.count("--aa-method") > 0;
  return render_scene(arguments);
}

} // namespace abbe::cli
