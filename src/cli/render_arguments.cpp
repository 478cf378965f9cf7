// SPDX-License-Identifier: MIT
#include "cli/render_arguments.hpp"

#include "cli/say.hpp"
#include "job/job.hpp"
#include "render/passes.hpp"

#include <charconv>
#include <fmt/format.h>

namespace abbe::cli {
namespace {

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

/// "N" or "A..B".
std::string set_samples(std::string const& text, render::AntiAliasing& aa) {
  render::Samples samples = aa.samples;
  char const* const end = text.data() + text.size();
  auto const [stop, failed] = std::from_chars(text.data(), end, samples.least);
  bool good = failed == std::errc();
  if (good && stop == end) {
    samples.most = samples.least;
  } else if (good && end - stop > 2 && stop[0] == '.' && stop[1] == '.') {
    auto const [last, wrong] = std::from_chars(stop + 2, end, samples.most);
    good = wrong == std::errc() && last == end;
  } else {
    good = false;
  }
  constexpr int limit = render::Samples::most_of_all;
  if (!good || samples.least < 1 || samples.most < samples.least || samples.most > limit)
    return fmt::format("expected N or A..B, numbers of samples from 1 to {}, got '{}'", limit,
                       text);
  aa.method = 3;
  aa.samples = samples;
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

std::string set_frames(std::string const& text, int& first, int& last) {
  char const* const end = text.data() + text.size();
  auto const [dots, failed] = std::from_chars(text.data(), end, first);
  bool const two = failed == std::errc() && end - dots > 2 && dots[0] == '.' && dots[1] == '.';
  if (two) {
    auto const [stop, wrong] = std::from_chars(dots + 2, end, last);
    if (wrong == std::errc() && stop == end && first >= 0 && first <= last && last < 1000000)
      return "";
  }
  return "expected A..B, numbers of frames from 0 on, got '" + text + "'";
}

int check_region(std::optional<render::Region> const& region, int width, int height) {
  if (!region) return 0;
  if (region->x0 >= 0 && region->y0 >= 0 && region->x0 < region->x1 && region->y0 < region->y1
      && region->x1 <= width && region->y1 <= height)
    return 0;
  say("abbe render: --region {},{},{},{} is not a part of the {} x {} picture\n", region->x0,
      region->y0, region->x1, region->y1, width, height);
  return 2;
}

/// Subdivision makes 4^(depth - 1) cells of a pixel.
int check_anti_aliasing(render::AntiAliasing const& aa) {
  constexpr int deepest = 9;
  if (aa.method != 2 || aa.depth <= deepest) return 0;
  say("abbe render: --aa {} is too deep for --aa-method 2; the most is {}\n", aa.depth, deepest);
  return 2;
}

} // namespace

int render_failed(Error const& error, int status) {
  say("abbe render: error[{}]: {}\n", error.code, error.message);
  return status;
}

void add_options(CommandLine& app, RenderArguments& arguments) {
  auto& options = arguments.options;
  arguments.scene.add_to(app, true);
  app.add_option(
         "-o,--output", arguments.output,
         "OUT.exr, .hdr, .tif (LogLuv), .png, .ppm, .tga, .bmp or .jpg (default: SCENE.png)")
      .check([](std::string const& name) {
        return name.empty() ? std::string("the name is empty") : std::string();
      });
  app.add_option("-j,--threads", options.threads, "threads (default: one a core)").range(1, 1024);
  app.add_option("--aa", arguments.anti_aliasing,
                 "anti-aliasing: up to N x N rays where pixels differ")
      .type_name("off|N")
      .check(
          [&](std::string const& text) { return set_anti_aliasing(text, options.anti_aliasing); })
      .show_default();
  app.add_option("--aa-method", options.anti_aliasing.method,
                 "1: grid in pixels that differ from a neighbour; 2: subdivision from the corners, "
                 "N - 1 times")
      .range(1, 2);
  app.add_option("--aa-threshold", options.anti_aliasing.threshold, "how much counts as different")
      .range(0.0, 3.0)
      .show_default();
  app.add_option("--aa-jitter", options.anti_aliasing.jitter,
                 "how far the rays of method 1 lie from the middle of their cells, of the cells")
      .range(0.0, 1.0)
      .show_default();
  app.add_option("--samples", arguments.samples,
                 "rays of each pixel, evenly apart; A..B: from A on, more where the pixel is not "
                 "yet known to --samples-error (default: as the scene says)")
      .type_name("N|A..B")
      .check([&](std::string const& text) { return set_samples(text, options.anti_aliasing); })
      .excludes("--aa")
      .excludes("--aa-method");
  app.add_option("--samples-error", arguments.samples_error,
                 fmt::format("standard error of a pixel as displayed, from 0 to 1, that is good "
                             "enough (default: {}, or as the scene says)",
                             render::Samples::default_error))
      .range(0.0, 1.0);
  app.add_option(
         "--error", arguments.target.delta_e,
         "choose mode, bands and anti-aliasing for this mean CIEDE2000 (those given are kept)")
      .type_name("DE")
      .range(0.01, 50.0);
  app.add_option("--time", arguments.time_text,
                 "choose them for this time of the clock: seconds, or as 30s, 5m")
      .type_name("TIME")
      .check(
          [&](std::string const& text) { return parse_duration(text, arguments.target.seconds); })
      .excludes("--error");
  app.add_option("--passes", options.passes,
                 "the mean of so many pictures with random numbers of their own")
      .range(1, 1000000)
      .show_default()
      .excludes("--error")
      .excludes("--time");
  app.add_option("--seed", options.seed, "of all random numbers").show_default();
  app.add_option("--region", arguments.region, "render this part only; x1, y1 not included")
      .type_name("x0,y0,x1,y1")
      .check([&](std::string const& text) { return set_region(text, options.region); });
  app.add_option("--tile", options.tile_size,
                 "pixels across a tile (default: 32, fewer in small pictures)")
      .range(1, 4096);
  app.add_option("--exposure", arguments.exposure_ev, "stops, of PNG output").show_default();
  app.add_option("--gamut", arguments.gamut,
                 "of PNG output: clip, standard or hue (see abbe tonemap --help); auto: standard "
                 "where colours are spectra, else clip")
      .one_of({"auto", "clip", "standard", "hue"})
      .show_default();
  app.add_flag("--half", arguments.half, "16-bit EXR");
  app.add_flag("--alpha", arguments.alpha,
               "an alpha channel: how much of the background each pixel covers");
  app.add_option("--frames", arguments.frames,
                 "a series of pictures OUTn.png: frame_number from A to B, clock from 0 to 1")
      .type_name("A..B")
      .check([&](std::string const& text) {
        return set_frames(text, arguments.first_frame, arguments.last_frame);
      })
      .excludes("--error")
      .excludes("--time");
  app.add_flag("--check-finite", options.check_finite,
               "end at the first sample that is not a number, infinite or negative, and say which "
               "path made it");
  app.add_option("--max-trace-level", options.max_trace_level,
                 "paths end after as many surfaces (default: the scene's)")
      .range(1, 1000);
  app.add_option("--stats", arguments.stats, "write seconds and rays by kind to FILE, as JSON")
      .type_name("FILE");
  auto const cost_map =
      app.add_option("--cost-map", arguments.cost_map,
                     "write the number of rays of each pixel to FILE.exr; keeps no checkpoint")
          .type_name("FILE");
  auto const resume =
      app.add_flag("--resume", arguments.resume,
                   "go on from OUT.abbe-checkpoint, which an interrupted render left")
          .excludes(cost_map);
  auto const always = app.add_flag("--checkpoint", arguments.checkpoint,
                                   "keep finished tiles from the first on (default: after 5 s)")
                          .excludes(cost_map);
  app.add_flag("--no-checkpoint", arguments.no_checkpoint, "keep none")
      .excludes(resume)
      .excludes(always);
}

int check(RenderArguments const& arguments) {
  if (!arguments.frames.empty()
      && (arguments.scene.clock || !arguments.stats.empty() || !arguments.cost_map.empty()
          || arguments.resume)) {
    say("abbe render: --frames makes several pictures: --clock, --stats, --cost-map and --resume "
        "are for one\n");
    return 2;
  }
  auto const& options = arguments.options;
  if (int const bad = check_region(options.region, arguments.scene.width, arguments.scene.height))
    return bad;
  if (arguments.target.seconds > 0 && (arguments.resume || arguments.checkpoint)) {
    say("abbe render: --time goes by the clock and keeps no checkpoint; the setting "
        "that it tells at the end can be rendered with one\n");
    return 2;
  }
  return check_anti_aliasing(options.anti_aliasing);
}

int settle_samples(RenderArguments& arguments, scene::Settings const& settings) {
  auto& aa = arguments.options.anti_aliasing;
  if (!arguments.aa_given && settings.samples) aa = render::AntiAliasing::of(*settings.samples);
  if (!arguments.samples_error) return 0;
  if (!aa.by_samples() || aa.samples.least == aa.samples.most) {
    say("abbe render: --samples-error needs a range of samples: --samples A..B\n");
    return 2;
  }
  aa.samples.error = *arguments.samples_error;
  return 0;
}

int check_passes(RenderArguments const& arguments, plan::Plan const& plan) {
  auto const& options = arguments.options;
  if (options.passes == 1) return 0;
  if (!render::passes_differ(plan, options.anti_aliasing)) {
    say("abbe render: --passes {}: each would be the same picture; passes need "
        "random numbers: --aa N --aa-jitter 1, or a stochastic mode of dispersion\n",
        options.passes);
    return 2;
  }
  if (job::passes_fit(plan, options)) return 0;
  return render_failed(
      {"E0706", fmt::format("--passes {} holds the sums of the whole picture: {:.3g} GB, more "
                            "than there is; make it in parts with --region, or in one pass",
                            options.passes, render::bytes_of_sums(plan, options) * 1e-9)},
      1);
}

} // namespace abbe::cli
