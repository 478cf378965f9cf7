// SPDX-License-Identifier: MIT
#pragma once

#include "base/result.hpp"
#include "base/stopwatch.hpp"
#include "image/image.hpp"
#include "plan/plan.hpp"
#include "render/render.hpp"
#include "scene/scene.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace abbe::job {

/// Where a picture goes, some rows at a time.
class Sink {
public:
  virtual ~Sink() = default;
  /// The next finished rows, from the top, linear (image::Image); by one thread at a time, while
  /// others go on with the rows below.
  /// @param passes that the picture is the mean of
  /// @error ends the job, which returns it
  virtual image::Status take(image::Image const& rows, int passes) = 0;
  /// After the last row; not called when the job ends before.
  /// @error as take()
  virtual image::Status finish(render::RenderResult const& result) = 0;
};

/// The file of finished tiles that an interrupted render goes on from (render/checkpoint.hpp).
struct Keeping {
  enum class When {
    Never,
    AfterAWhile, ///< once the render has run for 5 s: no more is lost
    FromTheFirst ///< tile on
  };
  When when = When::Never;
  std::filesystem::path path;
  /// A hash of what the pixels depend on beside the options and the program: of the scene, and of
  /// how it was planned.
  std::uint64_t scene_identity = 0;
  bool resume = false; ///< goes on from what is there
};

/// A time of the clock within which passes are made, as many as fit.
struct Deadline {
  double seconds = 0;
  Stopwatch since; ///< when they begin to count
};

struct Options {
  /// Size, threads, seed, anti-aliasing, passes, `stop` (any thread or signal handler may set it),
  /// `on_progress`. @pre on_rows, passes_wanted, rays_of_pixels and checkpoint are not set: they
  /// are the job's own
  render::RenderOptions render;
  Keeping keeping;                  ///< @pre Never with a deadline or count_rays
  std::optional<Deadline> deadline; ///< instead of RenderOptions::passes
  bool count_rays = false;          ///< of each pixel (Outcome::rays_of_pixels): slower
  /// Told before the first row: how many tiles need not be made again. 0: there is no checkpoint.
  std::function<void(std::size_t tiles)> on_resumed;
};

/// How a job ended.
struct Outcome {
  enum class End {
    Done,        ///< the sink has the picture
    Interrupted, ///< by RenderOptions::stop
    BadSample,   ///< there is no picture because of RenderResult::bad_sample
    NotResumed,  ///< `error` says why it cannot be gone on from: E0520, E0521
    NotTaken     ///< `error` is the sink's, or E0710: light that is not a number or infinite
  } end = End::Done;
  render::RenderResult result; ///< its image is empty: the sink has had it
  std::optional<Error> error;
  bool in_passes = false; ///< several passes were made, or could have been
  /// The checkpoint that Keeping::resume can go on from; empty: there is none.
  std::filesystem::path resumable;
  std::string not_kept;              ///< why there could be no checkpoint; empty: there could
  std::vector<float> rays_of_pixels; ///< row by row of the region
  double wall_s = 0, cpu_s = 0;      ///< to make ready, trace and hand on, all threads
};

/// Makes the picture of a scene and hands it to a sink. Returns within the time of a few pixels of
/// each thread after RenderOptions::stop is set. The same bytes for any number of threads, and
/// however often it was interrupted and resumed.
/// @param scene given up while the rays' own structures are made, to halve the memory
Outcome run(scene::Scene&& scene, plan::Plan const& plan, Options const& options, Sink& sink);

/// Is there memory for the sums of several passes? Of what this process may allocate
/// (RLIMIT_DATA).
bool passes_fit(plan::Plan const& plan, render::RenderOptions const& options);

} // namespace abbe::job
