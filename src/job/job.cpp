// SPDX-License-Identifier: MIT
#include "job/job.hpp"

#include "job/identity.hpp"
#include "job/pass_clock.hpp"
#include "render/checkpoint.hpp"
#include "render/passes.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <sys/resource.h>
#include <utility>

namespace abbe::job {
namespace {

/// Of Keeping::When::AfterAWhile.
constexpr double a_while_s = 5;

using End = Outcome::End;

std::unique_ptr<render::Checkpoint> make_checkpoint(Options const& options) {
  auto const& keeping = options.keeping;
  if (keeping.when == Keeping::When::Never) return nullptr;
  return std::make_unique<render::Checkpoint>(
      keeping.path, keeping.when == Keeping::When::AfterAWhile ? a_while_s : 0,
      [&] { return picture_identity(keeping.scene_identity, options.render); });
}

Outcome failed(End end, Error error) {
  Outcome out;
  out.end = end;
  out.error = std::move(error);
  return out;
}

/// What is left to be done when the rays are traced.
void conclude(Outcome& out, render::Checkpoint* checkpoint, Sink& sink) {
  if (checkpoint) out.not_kept = checkpoint->problem();
  if (out.result.interrupted)
    out.end = End::Interrupted;
  else if (out.result.bad_sample)
    out.end = End::BadSample;
  else if (out.error)
    out.end = End::NotTaken;
  else if (auto const done = sink.finish(out.result); !done) {
    out.end = End::NotTaken;
    out.error = done.error();
  }
  if (!checkpoint) return;
  bool const useless = out.error && out.error->code == "E0710"; // its tiles hold the same
  if (out.end == End::Done || out.end == End::BadSample || useless)
    checkpoint->remove();
  else if (checkpoint->written())
    out.resumable = checkpoint->path();
}

/// No picture holds light that is not a number or infinite. @param above rows handed on before
std::optional<Error> look_for_infinite(image::Image const& rows, render::Region const& region,
                                       int above) {
  auto const bad = std::find_if(rows.rgb.begin(), rows.rgb.end(),
                                [](float value) { return !std::isfinite(value); });
  if (bad == rows.rgb.end()) return std::nullopt;
  auto const pixel = static_cast<int>((bad - rows.rgb.begin()) / 3);
  return Error{"E0710",
               fmt::format("the light of pixel {}, {} is {}: --check-finite tells which "
                           "path made it",
                           region.x0 + pixel % rows.width, region.y0 + above + pixel / rows.width,
                           std::isnan(*bad) ? "not a number" : "infinite")};
}

/// What this process may allocate, bytes.
double memory_limit() {
  rlimit limit{};
  if (getrlimit(RLIMIT_DATA, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
    return std::numeric_limits<double>::infinity();
  return static_cast<double>(limit.rlim_cur);
}

} // namespace

Outcome run(scene::Scene&& scene, plan::Plan const& plan, Options const& options, Sink& sink) {
  auto const& asked = options.render;
  ABBE_ASSERT(!asked.on_rows && !asked.passes_wanted && !asked.rays_of_pixels && !asked.checkpoint);
  ABBE_ASSERT(options.keeping.when == Keeping::When::Never
              || (!options.deadline && !options.count_rays));
  Stopwatch const since;
  auto const checkpoint = make_checkpoint(options);
  if (checkpoint && options.keeping.resume) {
    auto const tiles = checkpoint->resume();
    if (!tiles) return failed(End::NotResumed, tiles.error());
    if (options.on_resumed) options.on_resumed(*tiles);
  }
  Outcome out;
  bool const by_clock = options.deadline && render::passes_differ(plan, asked.anti_aliasing)
                        && passes_fit(plan, asked);
  int passes = asked.passes;
  out.in_passes = passes > 1 || by_clock;
  auto made = asked;
  made.checkpoint = checkpoint.get();
  if (options.count_rays) made.rays_of_pixels = &out.rays_of_pixels;
  if (by_clock)
    made.passes_wanted = [&passes, clock = PassClock(*options.deadline)](int done) {
      passes = done;
      return clock.wanted(done);
    };
  int above = 0;
  made.on_rows = [&](image::Image const& rows) {
    out.error = look_for_infinite(rows, asked.pixels(), above);
    above += rows.height;
    if (out.error) return false;
    auto const taken = sink.take(rows, passes);
    if (!taken) out.error = taken.error();
    return bool(taken);
  };
  out.result = render::render(std::move(scene), plan, made);
  conclude(out, checkpoint.get(), sink);
  out.wall_s = since.wall_s();
  out.cpu_s = since.cpu_s();
  return out;
}

bool passes_fit(plan::Plan const& plan, render::RenderOptions const& options) {
  return render::bytes_of_sums(plan, options) < memory_limit();
}

} // namespace abbe::job
