// SPDX-License-Identifier: MIT
#pragma once

#include "image/image.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"
#include "transport/path_record.hpp"
#include "transport/ray_counts.hpp"

#include <atomic>
#include <functional>
#include <optional>

namespace abbe::render {

using transport::BadSample, transport::PathStep, transport::RayCounts;

/// How many samples a pixel gets, and where: the points of base/sobol.hpp. `least` each; where the
/// pixel as displayed is not yet known to a standard error of `error` (root of the mean square over
/// r, g and b, of 0 to 1; shown_error.hpp), twice as many, and so on up to `most`.
using Samples = scene::SampleSettings;

/// POV-Ray's two methods of anti-aliasing, and our own. Method 1 re-samples pixels that differ from
/// a neighbour on a depth x depth grid; method 2 starts at the pixel's corners and subdivides up to
/// `depth` - 1 times; method 3 goes by `samples` alone.
struct AntiAliasing {
  int method = 0; ///< 0 off, 1, 2, 3
  int depth = 3;
  double threshold = 0.3;
  double jitter = 0; ///< of the sub-pixel positions, 0..1
  /// Method 1: the ray through the middle counts, beside the grid, in pixels that are sampled
  /// again.
  bool middle_counts = true;
  Samples samples; ///< of method 3

  static AntiAliasing of(Samples const& samples) {
    AntiAliasing aa;
    aa.method = 3;
    aa.samples = samples;
    return aa;
  }
  bool by_samples() const { return method == 3; }
  /// Tiles are worked on twice: what is to be sampled again shows in the picture so far.
  bool looks_again() const { return method == 1 || (by_samples() && samples.least < samples.most); }
};

struct Region {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0; ///< pixels, x1 and y1 not included
};

struct Progress {
  double share = 0;       ///< of the work, 0..1
  std::uint64_t rays = 0; ///< so far
};

class Checkpoint;

struct RenderOptions {
  int width = 640;
  int height = 480;
  int threads = 0; ///< 0: all cores
  AntiAliasing anti_aliasing;
  /// The picture is the mean of so many of these (render/passes.hpp).
  int passes = 1;
  /// Asked after each of them, with how many there are: how many shall there be?
  /// @pre no checkpoint
  std::function<int(int done)> passes_wanted;
  std::uint64_t seed = 0;
  std::optional<int> max_trace_level; ///< instead of the scene's
  bool spectral_output = false;
  std::optional<Region> region;
  int tile_size = 0; ///< pixels across a tile; 0: as it suits the size
  std::function<void(Progress const&)> on_progress; ///< called from one thread at a time
  std::atomic<bool> const* stop = nullptr;          ///< set: leave soon
  /// Look at every sample: the first (in rows) whose light is not a number, infinite (as a float)
  /// or negative ends the work. Negative light is right in scenes that ask for it
  /// (negative_light_is_wrong).
#ifdef NDEBUG
  bool check_finite = false;
#else
  bool check_finite = true;
#endif
  /// Takes the finished rows, from the top, some at a time, by one thread at a time while others go
  /// on; false: leave. When it is set,
  /// RenderResult::image stays empty and memory does not grow with the picture's height.
  std::function<bool(image::Image const& rows)> on_rows;
  /// About how much memory the rows in work may take.
  std::size_t rows_bytes = std::size_t{32} << 20;
  /// Filled with the number of rays of each pixel of the region, row by row (cost map).
  /// @pre no checkpoint: tiles taken from one have no such record
  std::vector<float>* rays_of_pixels = nullptr;
  /// Finished tiles are kept in it, and taken from it. Must have been resumed, if at all.
  Checkpoint* checkpoint = nullptr;

  /// What is rendered: the region, or all.
  Region pixels() const {
    return region.value_or(Region{0, 0, width, height});
  }
};

struct RenderResult {
  image::Image image;
  RayCounts counts;
  /// Bounds of the light that is missing where paths end, in units of the picture's values
  /// (1: white): the mean of all samples, and of the sample that misses most. For surfaces that
  /// pass on no more than arrives.
  double missing_mean = 0, missing_most = 0;
  int passes = 1; ///< that were made
  bool interrupted = false;
  /// With check_finite: there is no picture because of this.
  std::optional<BadSample> bad_sample;
};

/// The picture of a scene. The same bytes for any number of threads, any tile size and any
/// rows_bytes, and whether or not tiles come from a checkpoint.
RenderResult render(scene::Scene const& scene, plan::Plan const& plan,
                    RenderOptions const& options);
/// The same, once: the scene's objects are given up while the rays' own structures are made, and a
/// large scene takes half the memory.
RenderResult render(scene::Scene&& scene, plan::Plan const& plan, RenderOptions const& options);

/// Parts of one pass of it, each as RenderOptions::region would give it, with the scene made ready
/// once; each on one thread, `threads` at a time.
/// @pre nothing of the options takes what is made: on_rows, on_progress, rays_of_pixels, checkpoint
std::vector<RenderResult> render_regions(scene::Scene const& scene, plan::Plan const& plan,
                                         RenderOptions options, std::vector<Region> const& regions);

} // namespace abbe::render
