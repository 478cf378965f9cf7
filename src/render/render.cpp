// SPDX-License-Identifier: MIT
#include "render/render.hpp"

#include "render/camera.hpp"
#include "render/pixel_sampler.hpp"
#include "render/working_space.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <limits>
#include <mutex>

namespace abbe::render {
namespace {

/// The picture being made: tiles in any order, each pixel written by the one thread that has its
/// tile.
class Frame {
public:
  /// @param space of the channels when they are r g b
  Frame(Stage const& stage, RenderOptions const& options, WorkingSpace const& space)
      : stage_(stage),
        options_(options),
        space_(space),
        region_(options.region.value_or(Region{0, 0, options.width, options.height})),
        tracers_([&stage] { return Tracer(stage); }) {
    result_.image = image::make_image(region_.x1 - region_.x0, region_.y1 - region_.y0);
    auto const pixels = result_.image.pixels();
    if (options.spectral_output) {
      result_.image.bands.resize(pixels * static_cast<std::size_t>(stage.channels));
      auto const centers = stage.bands->centers();
      auto const edges = stage.bands->edges();
      result_.image.band_centres_nm.assign(centers.begin(), centers.end());
      result_.image.band_edges_nm.assign(edges.begin(), edges.end());
    }
  }

  RenderResult run() {
    if (options_.anti_aliasing.method == 2) {
      for_each_pixel(
          [this](PixelSampler& sampler, int x, int y) { put(x, y, sampler.subdivided(x, y)); }, 0,
          1);
    } else if (options_.anti_aliasing.method == 1) {
      double const first = 1.0 / 3;
      for_each_pixel(
          [this](PixelSampler& sampler, int x, int y) { put(x, y, sampler.centre(x, y)); }, 0,
          first);
      if (!wrong_) refine(first);
    } else {
      for_each_pixel(
          [this](PixelSampler& sampler, int x, int y) { put(x, y, sampler.centre(x, y)); }, 0, 1);
    }
    if (wrong_) result_.bad_sample = look_into(*wrong_);
    CutLight cut;
    for (auto const& tracer : tracers_) {
      result_.counts.add(tracer.counts());
      cut.add(tracer.cut_light());
    }
    double const samples = std::max(1.0, static_cast<double>(result_.counts.camera));
    result_.missing_mean =
        static_cast<double>(cut.sum) * CutLight::unit / samples * stage_.brightest;
    result_.missing_most = cut.worst_sample * stage_.brightest;
    result_.interrupted = stopped();
    if (!stage_.bands && !space_.is_linear())
      for (auto& value : result_.image.rgb) value = static_cast<float>(space_.to_linear(value));
    return std::move(result_);
  }

private:
  struct WrongPixel {
    PixelSampler::Wrong wrong;
    int x, y;
  };

  bool stopped() const { return options_.stop && options_.stop->load(std::memory_order_relaxed); }

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - region_.y0) * static_cast<std::size_t>(result_.image.width)
           + static_cast<std::size_t>(x - region_.x0);
  }

  void put(int x, int y, Sampled const& sampled) {
    auto const at = index(x, y);
    for (int c = 0; c < 3; ++c)
      result_.image.rgb[3 * at + static_cast<std::size_t>(c)] = static_cast<float>(sampled.rgb[c]);
    for (std::size_t c = 0; c < sampled.bands.size(); ++c)
      result_.image.bands[at * sampled.bands.size() + c] =
          static_cast<float>(sampled.bands[c] * stage_.bands->d65_radiance(static_cast<int>(c)));
  }

  Vec3 rgb(int x, int y) const {
    auto const at = 3 * index(x, y);
    auto const& values = result_.image.rgb;
    return {values[at], values[at + 1], values[at + 2]};
  }

  /// Method 1: a pixel that differs from its left or upper neighbour is sampled again, and so is
  /// the neighbour. Marks are made from the centre samples alone, so the order does not matter.
  void refine(double done_share) {
    std::vector<std::uint8_t> marks(result_.image.pixels(), 0);
    {
      Tracer tracer(stage_);
      PixelSampler const judge(stage_, options_, tracer);
      for (int y = region_.y0; y < region_.y1; ++y)
        for (int x = region_.x0; x < region_.x1; ++x) {
          if (x > region_.x0 && judge.differ(rgb(x, y), rgb(x - 1, y)))
            marks[index(x, y)] = marks[index(x - 1, y)] = 1;
          if (y > region_.y0 && judge.differ(rgb(x, y), rgb(x, y - 1)))
            marks[index(x, y)] = marks[index(x, y - 1)] = 1;
        }
    }
    for_each_pixel(
        [&](PixelSampler& sampler, int x, int y) {
          if (marks[index(x, y)]) put(x, y, sampler.refined(x, y, sampler.centre(x, y)));
        },
        done_share, 1 - done_share);
  }

  template <class Work>
  void for_each_pixel(Work const& work, double done_share, double share) {
    int const size = std::max(1, options_.tile_size);
    int const across = (region_.x1 - region_.x0 + size - 1) / size;
    int const down = (region_.y1 - region_.y0 + size - 1) / size;
    std::atomic<int> finished{0};
    int const cores =
        options_.threads > 0 ? options_.threads : tbb::this_task_arena::max_concurrency();
    tbb::global_control const limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(cores));
    tbb::task_arena arena(cores);
    arena.execute([&] {
      tbb::parallel_for(0, across * down, [&](int tile) {
        if (stopped()) return;
        Tracer& tracer = tracers_.local();
        PixelSampler sampler(stage_, options_, tracer);
        std::uint64_t const before = tracer.counts().total();
        int const x0 = region_.x0 + tile % across * size, y0 = region_.y0 + tile / across * size;
        for (int y = y0; y < std::min(y0 + size, region_.y1); ++y) {
          if (stopped()) return;
          for (int x = x0; x < std::min(x0 + size, region_.x1); ++x) {
            if (index(x, y) > first_wrong_.load(std::memory_order_relaxed)) break;
            work(sampler, x, y);
            if (sampler.wrong()) return keep(*sampler.wrong(), x, y);
          }
        }
        rays_ += tracer.counts().total() - before;
        report(done_share + share * ++finished / (across * down));
      });
    });
  }

  /// The first in rows stays, whatever the order in which they were found.
  void keep(PixelSampler::Wrong const& wrong, int x, int y) {
    std::lock_guard const lock(wrong_mutex_);
    if (wrong_ && index(x, y) > first_wrong_) return;
    first_wrong_ = index(x, y);
    wrong_ = {wrong, x, y};
  }

  /// Traces the sample again, with a record of its path.
  BadSample look_into(WrongPixel const& found) const {
    auto const& [wrong, x, y] = found;
    Tracer tracer(stage_);
    PathRecorder recorder(stage_, negative_light_is_wrong(stage_));
    tracer.record(recorder);
    auto const ray = camera_ray(stage_.camera, wrong.x, wrong.y, options_.width, options_.height);
    std::vector<double> bands(options_.spectral_output ? static_cast<std::size_t>(stage_.channels)
                                                       : 0);
    tracer.sample(ray, wrong.key, bands);
    recorder.end(tracer);
    return {wrong.kind, x, y, wrong.key.number, wrong.rgb, recorder.path()};
  }

  void report(double share) {
    if (!options_.on_progress) return;
    std::unique_lock const lock(progress_, std::try_to_lock);
    if (lock) options_.on_progress({share, rays_.load()});
  }

  Stage const& stage_;
  RenderOptions const& options_;
  WorkingSpace space_;
  Region region_;
  RenderResult result_;
  tbb::enumerable_thread_specific<Tracer> tracers_;
  std::atomic<std::uint64_t> rays_{0};
  std::mutex progress_;
  std::atomic<std::size_t> first_wrong_{std::numeric_limits<std::size_t>::max()};
  std::optional<WrongPixel> wrong_;
  std::mutex wrong_mutex_;
};

} // namespace

RenderResult render(scene::Scene const& scene, plan::Plan const& plan,
                    RenderOptions const& options) {
  ABBE_ASSERT(options.width > 0 && options.height > 0);
  ABBE_ASSERT(!options.spectral_output || plan.bands);
  Stage const stage = compile(scene, plan);
  return Frame(stage, options, WorkingSpace(scene.settings)).run();
}

} // namespace abbe::render
