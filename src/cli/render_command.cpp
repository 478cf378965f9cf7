// SPDX-License-Identifier: MIT
#include "base/stopwatch.hpp"
#include "cli/bad_sample_text.hpp"
#include "cli/commands.hpp"
#include "cli/identity.hpp"
#include "cli/progress_bar.hpp"
#include "cli/render_stats.hpp"
#include "cli/scene_arguments.hpp"
#include "image/writer.hpp"
#include "render/checkpoint.hpp"
#include "render/render.hpp"
#include "study/target.hpp"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>

namespace abbe::cli {
namespace {

struct Arguments {
  SceneArguments scene;
  std::string output;
  std::string anti_aliasing = "off";
  std::string region;
  render::RenderOptions options;
  std::string gamut = "standard";
  double exposure_ev = 0;
  bool half = false;
  study::Target target;
  std::string time_text;
  std::string stats, cost_map; ///< files; empty: not asked for
  bool checkpoint = false, no_checkpoint = false, resume = false;
};

/// "off" or the depth.
std::string set_anti_aliasing(std::string const& text, render::AntiAliasing& aa) {
  if (text == "off") {
    aa.method = 0;
    return "";
  }
  int depth = 0;
  auto const [end, failed] = std::from_chars(text.data(), text.data() + text.size(), depth);
  if (failed != std::errc() || end != text.data() + text.size() || depth < 1 || depth > 64)
    return "expected 'off' or a depth from 1 to 64, got '" + text + "'";
  aa.depth = depth;
  if (aa.method == 0) aa.method = 1;
  return "";
}

std::string set_region(std::string const& text, std::optional<render::Region>& out) {
  render::Region region;
  int* const numbers[] = {&region.x0, &region.y0, &region.x1, &region.y1};
  char const* at = text.data();
  char const* const end = at + text.size();
  for (int i = 0; i < 4; ++i) {
    auto const [stop, failed] = std::from_chars(at, end, *numbers[i]);
    bool const separated = i == 3 ? stop == end : stop != end && *stop == ',';
    if (failed != std::errc() || !separated) return "expected x0,y0,x1,y1, got '" + text + "'";
    at = stop + 1;
  }
  out = region;
  return "";
}

int fail(Error const& error, int status) {
  fmt::print(stderr, "abbe render: error[{}]: {}\n", error.code, error.message);
  return status;
}

void add_options(CLI::App& app, Arguments& arguments) {
  auto& options = arguments.options;
  arguments.scene.add_to(app, true);
  app.add_option("-o,--output", arguments.output,
                 "OUT.exr, OUT.png or OUT.tif (default: SCENE.png)")
      ->check([](std::string const& name) {
        return name.empty() ? std::string("the name is empty") : std::string();
      });
  app.add_option("-j,--threads", options.threads, "threads (default: one a core)")
      ->check(CLI::Range(1, 1024));
  app.add_option("--aa", arguments.anti_aliasing,
                 "anti-aliasing: up to N x N rays where pixels differ")
      ->type_name("off|N")
      ->check(
          [&](std::string const& text) { return set_anti_aliasing(text, options.anti_aliasing); })
      ->capture_default_str();
  app.add_option("--aa-method", options.anti_aliasing.method,
                 "1: grid in pixels that differ from a neighbour; 2: subdivision from the corners")
      ->check(CLI::Range(1, 2));
  app.add_option("--aa-threshold", options.anti_aliasing.threshold, "how much counts as different")
      ->check(CLI::Range(0.0, 3.0))
      ->capture_default_str();
  app.add_option("--aa-jitter", options.anti_aliasing.jitter,
                 "how far the rays of method 1 lie from the middle of their cells, of the cells")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app.add_option(
         "--error", arguments.target.delta_e,
         "choose mode, bands and anti-aliasing for this mean CIEDE2000 (those given are kept)")
      ->type_name("DE")
      ->check(CLI::Range(0.01, 50.0));
  app.add_option("--time", arguments.time_text,
                 "choose them for this time of the clock: seconds, or as 30s, 5m")
      ->type_name("TIME")
      ->check(
          [&](std::string const& text) { return parse_duration(text, arguments.target.seconds); })
      ->excludes("--error");
  app.add_option("--seed", options.seed, "of the stochastic dispersion mode")
      ->capture_default_str();
  app.add_option("--region", arguments.region, "render this part only; x1, y1 not included")
      ->type_name("x0,y0,x1,y1")
      ->check([&](std::string const& text) { return set_region(text, options.region); });
  app.add_option("--tile", options.tile_size, "pixels across a tile")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
  app.add_option("--exposure", arguments.exposure_ev, "stops, of PNG output")
      ->capture_default_str();
  app.add_option("--gamut", arguments.gamut,
                 "of PNG output: clip, standard or hue (see abbe tonemap --help)")
      ->check(CLI::IsMember({"clip", "standard", "hue"}))
      ->capture_default_str();
  app.add_flag("--half", arguments.half, "16-bit EXR");
  app.add_flag("--check-finite", options.check_finite,
               "end at the first sample that is not a number, infinite or negative, and say which "
               "path made it");
  app.add_option("--max-trace-level", options.max_trace_level,
                 "paths end after as many surfaces (default: the scene's)")
      ->check(CLI::Range(1, 1000));
  app.add_option("--stats", arguments.stats, "write seconds and rays by kind to FILE, as JSON")
      ->type_name("FILE");
  auto* cost_map =
      app.add_option("--cost-map", arguments.cost_map,
                     "write the number of rays of each pixel to FILE.exr; keeps no checkpoint")
          ->type_name("FILE");
  auto* resume = app.add_flag("--resume", arguments.resume,
                              "go on from OUT.abbe-checkpoint, which an interrupted render left")
                     ->excludes(cost_map);
  auto* always = app.add_flag("--checkpoint", arguments.checkpoint,
                              "keep finished tiles from the first on (default: after 5 s)")
                     ->excludes(cost_map);
  app.add_flag("--no-checkpoint", arguments.no_checkpoint, "keep none")
      ->excludes(resume)
      ->excludes(always);
}

image::WriteOptions write_options(Arguments const& arguments) {
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

int check_region(std::optional<render::Region> const& region, int width, int height) {
  if (!region) return 0;
  if (region->x0 >= 0 && region->y0 >= 0 && region->x0 < region->x1 && region->y0 < region->y1
      && region->x1 <= width && region->y1 <= height)
    return 0;
  fmt::print(stderr, "abbe render: --region {},{},{},{} is not a part of the {} x {} picture\n",
             region->x0, region->y0, region->x1, region->y1, width, height);
  return 2;
}

/// Subdivision makes 4^depth cells of a pixel.
int check_anti_aliasing(render::AntiAliasing const& aa) {
  constexpr int deepest = 9;
  if (aa.method != 2 || aa.depth <= deepest) return 0;
  fmt::print(stderr, "abbe render: --aa {} is too deep for --aa-method 2; the most is {}\n",
             aa.depth, deepest);
  return 2;
}

image::ImageHead head_of(Arguments const& arguments, plan::Plan const& plan) {
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
                   {"AntiAliasing", arguments.anti_aliasing}};
  head.late_keys = {"MissingLight"};
  return head;
}

/// The file, opened when the first rows are done: a short render leaves nothing beside it.
class Output {
public:
  Output(Arguments const& arguments, plan::Plan const& plan) : arguments_(arguments), plan_(plan) {}

  bool write(image::Image const& rows) {
    if (!writer_) {
      auto opened = image::open_writer(head_of(arguments_, plan_), arguments_.output,
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
  Arguments const& arguments_;
  plan::Plan const& plan_;
  std::unique_ptr<image::ImageWriter> writer_;
  std::optional<Error> error_;
};

/// How long a render must have run before it leaves a checkpoint: what is lost is no more.
constexpr double checkpoint_after_seconds = 5;

std::unique_ptr<render::Checkpoint> make_checkpoint(Arguments const& arguments,
                                                    lang::Evaluated const& evaluated) {
  if (arguments.no_checkpoint || !arguments.cost_map.empty()) return nullptr;
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
int resume(Arguments const& arguments, render::Checkpoint& checkpoint) {
  auto const tiles = checkpoint.resume();
  if (!tiles) return fail(tiles.error(), tiles.error().code == "E0520" ? 1 : 3);
  if (arguments.scene.quiet) return 0;
  if (*tiles == 0)
    fmt::print(stderr, "abbe: nothing to resume in '{}': from the beginning\n",
               checkpoint.path().string());
  else
    fmt::print(stderr, "abbe: {} tiles resumed from '{}'\n", *tiles, checkpoint.path().string());
  return 0;
}

int say_interrupted(Arguments const& arguments, render::Checkpoint const* checkpoint) {
  fmt::print(stderr, "abbe: interrupted; {} was not written\n", arguments.output);
  if (checkpoint && checkpoint->written())
    fmt::print(stderr,
               "abbe: what is done is in '{}': the same command with --resume goes on from there\n",
               checkpoint->path().string());
  return 130;
}

/// What was asked for beside the picture. The exit status, 0: done.
int write_records(Arguments const& arguments, RenderStats stats, Stopwatch const& all,
                  plan::Plan const& plan, render::RenderResult const& result) {
  auto const& options = arguments.options;
  if (!arguments.stats.empty()) {
    stats.render_wall_s = all.wall_s() - stats.scene_wall_s;
    stats.render_cpu_s = all.cpu_s() - stats.scene_cpu_s;
    auto const written = write_stats(arguments.stats, stats, plan, options, result);
    if (!written) return fail(written.error(), 3);
  }
  if (!arguments.cost_map.empty()) {
    render::Region const region = options.pixels();
    auto const written = write_cost_map(arguments.cost_map, *options.rays_of_pixels,
                                        region.x1 - region.x0, region.y1 - region.y0);
    if (!written) return fail(written.error(), 3);
  }
  return 0;
}

/// --error and --time: takes over what suits them, and says so. The exit status, 0: go on.
/// @param spent_s of the time
int choose(Arguments& arguments, lang::Evaluated const& evaluated, double spent_s) {
  auto& options = arguments.options;
  auto target = arguments.target;
  if (target.seconds > 0) target.seconds = std::max(1e-3, target.seconds - spent_s);
  auto const choice =
      study::choose_setting(evaluated.scene, overrides_of(arguments.scene), options, target);
  if (interrupted()) return 130;
  if (!choice) return fail(choice.error(), 1);
  if (choice->bands && !arguments.scene.bands) arguments.scene.bands = choice->bands;
  if (!choice->dispersion.empty()) arguments.scene.dispersion = choice->dispersion;
  if (!choice->representation.empty()) arguments.scene.representation = choice->representation;
  options.anti_aliasing = choice->aa;
  if (arguments.scene.quiet) return 0;
  fmt::print(stderr,
             "abbe: {}: expected error {:.3g} (mean CIEDE2000), about {:.2g} s; the {} of {} "
             "settings tried on {:.2g} % of the picture\n",
             choice->text, choice->expected_delta_e, choice->expected_s,
             target.seconds > 0 ? "closest in the time"
             : choice->reached  ? "one with the fewest rays"
                                : "closest",
             choice->probes, 100 * choice->probe_share);
  if (!choice->reached)
    fmt::print(stderr, "abbe: the {} cannot be reached with what may be chosen\n",
               target.seconds > 0 ? "time" : "error");
  else if (target.delta_e > 0 && choice->expected_delta_e < 0.75 * target.delta_e)
    fmt::print(stderr, "abbe: nothing cheaper is less exact than asked for\n");
  return 0;
}

int render_scene(Arguments& arguments) {
  if (arguments.output.empty())
    arguments.output = std::filesystem::path(arguments.scene.scene).stem().string() + ".png";
  auto const writable = image::check_destination(arguments.output);
  if (!writable) return fail(writable.error(), writable.error().code == "E0512" ? 2 : 3);
  if (!arguments.cost_map.empty()) {
    auto const map = image::check_destination(arguments.cost_map);
    if (!map) return fail(map.error(), map.error().code == "E0512" ? 2 : 3);
  }
  if (int const bad =
          check_region(arguments.options.region, arguments.scene.width, arguments.scene.height))
    return bad;
  if (int const bad = check_anti_aliasing(arguments.options.anti_aliasing)) return bad;

  Stopwatch const all;
  int status = 0;
  auto const evaluated = load_scene(arguments.scene, status);
  if (!evaluated) return status;
  render::RenderOptions& options = arguments.options;
  options.width = arguments.scene.width;
  options.height = arguments.scene.height;
  options.stop = &interrupted();
  if (arguments.target.delta_e > 0 || arguments.target.seconds > 0)
    if (int const failed = choose(arguments, *evaluated, all.wall_s())) return failed;
  auto const plan = plan_scene(*evaluated, arguments.scene, status);
  if (!plan) return status;

  options.spectral_output = arguments.scene.spectral;
  std::vector<float> rays_of_pixels;
  if (!arguments.cost_map.empty()) options.rays_of_pixels = &rays_of_pixels;
  auto const checkpoint = make_checkpoint(arguments, *evaluated);
  if (arguments.resume)
    if (int const failed = resume(arguments, *checkpoint)) return failed;
  options.checkpoint = checkpoint.get();
  ProgressBar bar(arguments.scene.quiet);
  options.on_progress = [&bar](render::Progress const& progress) { bar.show(progress); };
  Output output(arguments, *plan);
  options.on_rows = [&output](image::Image const& rows) { return output.write(rows); };
  RenderStats stats{arguments.scene.scene, all.wall_s(), all.cpu_s()};
  auto const result = render::render(evaluated->scene, *plan, options);
  bar.finish();
  if (result.interrupted) return say_interrupted(arguments, checkpoint.get());
  if (result.bad_sample) {
    fmt::print(stderr, "abbe render: {}", bad_sample_text(*result.bad_sample));
    if (checkpoint) checkpoint->remove();
    return 1;
  }
  if (!output.finish(result)) return fail(*output.error(), 3);
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
  }
  return 0;
}

} // namespace

int run_render(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Renders a scene.", "abbe render");
  add_options(app, arguments);
  if (int const status = parse_arguments(app, argc, argv); status >= 0) return status;
  arguments.target.keep_aa = app.count("--aa") + app.count("--aa-method") > 0;
  return render_scene(arguments);
}

} // namespace abbe::cli
