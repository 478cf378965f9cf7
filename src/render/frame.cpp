// SPDX-License-Identifier: MIT
#include "render/frame.hpp"

#include "render/checkpoint.hpp"
#include "render/each.hpp"
#include "render/first_look.hpp"
#include "render/marks.hpp"
#include "render/pixel_sampler.hpp"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <limits>
#include <mutex>

namespace abbe::render {
namespace {

/// Some rows of tiles in work.
struct Strip {
  int y0 = 0, y1 = 0;       ///< pixels
  int tile0 = 0, tile1 = 0; ///< rows of tiles
  image::Image image;
  std::vector<std::uint8_t> marks; ///< pixels to be sampled again
  FirstLook look;                  ///< method 3, where pixels are sampled again
};

/// The picture being made: strip by strip, the tiles of a strip in any order, each pixel written by
/// the one thread that has its tile.
class Frame {
public:
  Frame(Stage const& stage, RenderOptions const& options, plan::WorkingSpace const& space,
        bool linear, int pass)
      : stage_(stage),
        options_(options),
        space_(space),
        linear_(linear),
        region_(options.pixels()),
        size_(tile_size(options)),
        across_((region_.x1 - region_.x0 + size_.across - 1) / size_.across),
        down_((region_.y1 - region_.y0 + size_.down - 1) / size_.down),
        first_phase_(static_cast<std::uint32_t>(pass) * phases()),
        workers_([this] { return Worker(*this); }) {
    std::size_t floats = 3;
    if (options.spectral_output) floats += stage.film_bands();
    if (looks()) floats += 7;
    std::size_t const row_of_tiles = floats * sizeof(float) * static_cast<std::size_t>(size_.down)
                                     * static_cast<std::size_t>(width());
    strip_rows_ = static_cast<int>(std::clamp<std::size_t>(options.rows_bytes / row_of_tiles, 1,
                                                           static_cast<std::size_t>(down_)));
  }

  std::uint32_t tiles() const {
    return static_cast<std::uint32_t>(across_) * static_cast<std::uint32_t>(down_);
  }
  /// How often tiles are worked on.
  std::uint32_t phases() const { return options_.anti_aliasing.looks_again() ? 2 : 1; }

  RenderResult run() {
    bool const again = options_.anti_aliasing.looks_again();
    first_share_ = !again ? 1 : grid_alone() ? 0 : 1.0 / 3;
    Strip strip = sampled_strip(0);
    std::vector<float> above; // the last row of the strip before, as first sampled
    while (!stopped()) {
      int const behind = strip.tile1;
      Strip next;
      if (again) {
        if (behind < down_) next = sampled_strip(behind);
        if (wrong_) break;
        mark(strip, above, next.image.rgb);
        above.assign(strip.image.rgb.end() - static_cast<std::ptrdiff_t>(row_floats()),
                     strip.image.rgb.end());
        refine(strip);
      }
      if (stopped() || wrong_ || !finish(strip) || behind == down_) break;
      if (!again) {
        strip = {}; // before the next takes its memory
        next = sampled_strip(behind);
      }
      strip = std::move(next);
    }
    if (wrong_) result_.bad_sample = look_into(*wrong_);
    add_counts();
    result_.interrupted = stopped();
    return std::move(result_);
  }

private:
  bool stopped() const { return options_.stop && options_.stop->load(std::memory_order_relaxed); }
  /// In the whole picture.
  std::size_t number(Pixel const& pixel) const {
    return static_cast<std::size_t>(pixel.y - region_.y0) * static_cast<std::size_t>(width())
           + static_cast<std::size_t>(pixel.x - region_.x0);
  }
  int width() const { return region_.x1 - region_.x0; }

  bool subdivides() const { return options_.anti_aliasing.method == 2; }
  bool by_samples() const { return options_.anti_aliasing.by_samples(); }
  bool looks() const { return by_samples() && options_.anti_aliasing.looks_again(); }
  /// Every pixel is sampled again, and its first sample does not count: it need not be made.
  bool grid_alone() const {
    auto const& aa = options_.anti_aliasing;
    bool const has_neighbours = width() > 1 || region_.y1 - region_.y0 > 1;
    return aa.method == 1 && !aa.middle_counts && aa.threshold <= 0 && has_neighbours;
  }

  Strip make_strip(int tile0) const {
    Strip strip;
    strip.tile0 = tile0;
    strip.tile1 = std::min(tile0 + strip_rows_, down_);
    strip.y0 = region_.y0 + tile0 * size_.down;
    strip.y1 = std::min(region_.y0 + strip.tile1 * size_.down, region_.y1);
    strip.image = image::make_image(width(), strip.y1 - strip.y0);
    if (looks()) strip.look = FirstLook(strip.image.pixels());
    if (options_.spectral_output) {
      strip.image.bands.resize(strip.image.pixels() * stage_.film_bands());
      auto const centers = stage_.bands().centers();
      auto const edges = stage_.bands().edges();
      strip.image.band_centres_nm.assign(centers.begin(), centers.end());
      strip.image.band_edges_nm.assign(edges.begin(), edges.end());
    }
    return strip;
  }

  /// A row of tiles that is finished leaves, while others are in work.
  void hand_on(Strip const& strip, int tile_row) {
    if (refused_ || stopped() || first_wrong_.load(std::memory_order_relaxed) != none) return;
    int const y0 = region_.y0 + tile_row * size_.down;
    int const y1 = std::min(y0 + size_.down, region_.y1);
    image::Image rows = image::make_image(width(), y1 - y0);
    auto const take = [&](std::vector<float> const& from, std::vector<float>& to) {
      auto const per_row = static_cast<std::ptrdiff_t>(from.size()) / (strip.y1 - strip.y0);
      auto const begin = from.begin() + per_row * (y0 - strip.y0);
      to.assign(begin, begin + per_row * (y1 - y0));
    };
    take(strip.image.rgb, rows.rgb);
    take(strip.image.bands, rows.bands);
    rows.band_centres_nm = strip.image.band_centres_nm;
    rows.band_edges_nm = strip.image.band_edges_nm;
    if (linear_) make_linear(rows, stage_, space_);
    refused_ = !options_.on_rows(rows);
  }

  /// The strip is finished. @return whether to go on
  bool finish(Strip& strip) {
    if (options_.on_rows) return !refused_;
    image::Image& rows = strip.image;
    if (linear_) make_linear(rows, stage_, space_);
    image::Image& whole = result_.image;
    if (whole.width == 0) {
      whole = std::move(rows);
    } else {
      whole.height += rows.height;
      whole.rgb.insert(whole.rgb.end(), rows.rgb.begin(), rows.rgb.end());
      whole.bands.insert(whole.bands.end(), rows.bands.begin(), rows.bands.end());
    }
    return true;
  }

  void add_counts() {
    CutLight cut = kept_.cut;
    result_.counts = kept_.counts;
    for (Worker const& worker : workers_) {
      result_.counts.add(worker.tracer.counts());
      cut.add(worker.tracer.cut_light());
    }
    auto counted = static_cast<double>(result_.counts.camera);
    if (subdivides()) { // by pixel, not by sample
      cut.sum = kept_.cut.sum + lost_;
      counted = static_cast<double>(width()) * (region_.y1 - region_.y0);
    }
    auto const missing = [&](double lost) { return lost > 0 ? lost * stage_.brightest : 0; };
    result_.missing_mean =
        missing(static_cast<double>(cut.sum) * CutLight::unit / std::max(1.0, counted));
    result_.missing_most = missing(cut.worst_sample);
  }

  std::size_t index(Strip const& strip, int x, int y) const {
    return static_cast<std::size_t>(y - strip.y0) * static_cast<std::size_t>(width())
           + static_cast<std::size_t>(x - region_.x0);
  }

  void put(Strip& strip, std::span<Pixel const> pixels, Sampled const* sampled) const {
    for (std::size_t k = 0; k < pixels.size(); ++k) {
      auto const at = index(strip, pixels[k].x, pixels[k].y);
      for (std::size_t c = 0; c < 3; ++c)
        strip.image.rgb[3 * at + c] = static_cast<float>(sampled[k].rgb[static_cast<int>(c)]);
      put_bands(strip, at, sampled[k].bands, 1, 0);
    }
  }

  void put(Strip& strip, Pixel const& pixel, FirstSamples const& samples) const {
    put(strip, {&pixel, 1}, &samples.mean);
    if (looks()) strip.look.put(index(strip, pixel.x, pixel.y), samples);
  }

  /// Of a pixel of whose first samples the strip has the mean.
  void put(Strip& strip, Pixel const& pixel, KnownPixel const& known) const {
    auto const at = index(strip, pixel.x, pixel.y);
    Vec3 const mean = known.mean();
    for (std::size_t c = 0; c < 3; ++c)
      strip.image.rgb[3 * at + c] = static_cast<float>(mean[static_cast<int>(c)]);
    put_bands(strip, at, known.bands, known.count, options_.anti_aliasing.samples.least);
  }

  /// @param sums of `count` - `before` samples; of so many before, the strip has the mean
  void put_bands(Strip& strip, std::size_t pixel, std::vector<double> const& sums, int count,
                 int before) const {
    for (std::size_t c = 0; c < sums.size(); ++c) {
      float& band = strip.image.bands[pixel * sums.size() + c];
      double const more = sums[c] * stage_.bands().d65_radiance(static_cast<int>(c));
      band = static_cast<float>((static_cast<double>(band) * before + more) / count);
    }
  }

  Strip sampled_strip(int tile0) {
    Strip strip = make_strip(tile0);
    if (grid_alone()) return strip;
    auto const all = [](int, int) { return true; };
    if (by_samples()) {
      auto const least = static_cast<std::size_t>(options_.anti_aliasing.samples.least);
      for_each_tile(strip, 0, least, all, [&](Worker& worker, std::span<Pixel const> pixels) {
        worker.first.resize(std::max(worker.first.size(), pixels.size()));
        worker.sampler.first_samples(pixels, worker.first.data());
        for (std::size_t k = 0; k < pixels.size(); ++k) put(strip, pixels[k], worker.first[k]);
      });
      return strip;
    }
    std::size_t const cells = std::size_t{1} << 2 * (options_.anti_aliasing.depth - 1);
    for_each_tile(strip, 0, subdivides() ? cells : 1, all,
                  [&](Worker& worker, std::span<Pixel const> pixels) {
                    Sampled* const out = worker.room(pixels.size());
                    if (subdivides())
                      worker.sampler.subdivided(pixels, out);
                    else
                      worker.sampler.centres(pixels, out);
                    put(strip, pixels, out);
                  });
    return strip;
  }

  /// Of a thread.
  struct Worker {
    explicit Worker(Frame const& frame)
        : tracer(frame.make_tracer()), sampler(frame.stage_, frame.options_, tracer) {}
    Tracer tracer;
    PixelSampler sampler;
    std::vector<Sampled> sampled;
    std::vector<FirstSamples> first;
    std::vector<KnownPixel> known;

    Sampled* room(std::size_t pixels) {
      sampled.resize(std::max(sampled.size(), pixels));
      return sampled.data();
    }
  };

  Tracer make_tracer(transport::PathRecord* record = nullptr) const {
    Tracer tracer(stage_, stage_.camera->footprint(options_.width, options_.height), record);
    tracer.stop_when(options_.stop);
    if (options_.rays_of_pixels || looks()) tracer.count_rays();
    return tracer;
  }

  /// Which pixels are sampled again. @param above, below the row before the strip and (first) the
  /// one behind it
  void mark(Strip& strip, std::span<float const> above, std::span<float const> below) const {
    if (grid_alone())
      strip.marks.assign(strip.image.pixels(), 1);
    else if (by_samples())
      strip.marks = strip.look.unknown(strip.image.rgb, static_cast<std::size_t>(width()), above,
                                       below.first(std::min(below.size(), row_floats())),
                                       options_.anti_aliasing.samples, space_);
    else
      strip.marks = mark_differences(strip.image.rgb, static_cast<std::size_t>(width()), above,
                                     below.first(std::min(below.size(), row_floats())),
                                     options_.anti_aliasing.threshold);
  }
  std::size_t row_floats() const { return 3 * static_cast<std::size_t>(width()); }

  void refine(Strip& strip) {
    if (by_samples()) return refine_by_samples(strip);
    bool const middle = options_.anti_aliasing.middle_counts;
    auto const depth = static_cast<std::size_t>(options_.anti_aliasing.depth);
    auto const marked = [&](int x, int y) { return strip.marks[index(strip, x, y)] != 0; };
    for_each_tile(strip, 1, depth * depth, marked,
                  [&](Worker& worker, std::span<Pixel const> pixels) {
                    Sampled* const out = worker.room(pixels.size());
                    worker.sampler.refined(pixels, middle, out);
                    put(strip, pixels, out);
                  });
  }

  void refine_by_samples(Strip& strip) {
    auto const marked = [&](int x, int y) { return strip.marks[index(strip, x, y)] != 0; };
    for_each_tile(strip, 1, 1, marked, [&](Worker& worker, std::span<Pixel const> pixels) {
      worker.known.clear();
      for (Pixel const& pixel : pixels) {
        auto const at = index(strip, pixel.x, pixel.y);
        worker.known.push_back(
            strip.look.pixel(at, &strip.image.rgb[3 * at], options_.anti_aliasing.samples));
      }
      worker.sampler.further_samples(pixels, space_, worker.known.data());
      for (std::size_t k = 0; k < pixels.size(); ++k) put(strip, pixels[k], worker.known[k]);
    });
  }

  /// @param each samples of a pixel, about
  /// @param wanted (x, y): is the pixel to be made?
  /// @param work (worker, pixels): makes them, and puts them into the strip
  template <class Wanted, class Work>
  void for_each_tile(Strip& strip, std::uint32_t phase, std::size_t each, Wanted const& wanted,
                     Work const& work) {
    auto const make = [&](int tile) {
      if (stopped() || refused_.load(std::memory_order_relaxed)) return;
      Box const box = box_of(tile);
      if (!options_.checkpoint || !take(strip, box, phase, tile)) {
        Worker& worker = workers_.local();
        Tracer& tracer = worker.tracer;
        PixelSampler& sampler = worker.sampler;
        sampler.start();
        RayCounts const before = tracer.counts();
        CutLight const cut_before = tracer.cut_light();
        std::size_t const most = std::max<std::size_t>(1, tracer.batch() / each);
        bool whole = true;
        for_each_group(box, most, wanted, [&](std::span<Pixel const> pixels) {
          if (stopped()) return whole = false;
          std::size_t const wrong = first_wrong_.load(std::memory_order_relaxed);
          auto const behind = [&](Pixel const& pixel) { return number(pixel) > wrong; };
          if (wrong != none && std::all_of(pixels.begin(), pixels.end(), behind)) return true;
          work(worker, pixels);
          if (stopped()) return whole = false;
          if (sampler.wrong()) keep(*sampler.wrong());
          return true;
        });
        if (!whole || first_wrong_ != none) return;
        rays_ += tracer.counts().total() - before.total();
        lost_ += sampler.lost();
        if (options_.checkpoint)
          keep(strip, box, phase, tile, tracer, sampler.lost(), before, cut_before);
      }
      report(phase);
    };
    int const first = strip.tile0 * across_, last = strip.tile1 * across_;
    int const cores = cores_of(options_);
    if (phase + 1 < phases() || !options_.on_rows) return for_each(first, last, cores, make);
    for_each_in_order(first, last, cores, make, [&](int tile) {
      if ((tile + 1) % across_ == 0) hand_on(strip, tile / across_);
    });
  }

  Box box_of(int tile) const {
    int const x0 = region_.x0 + tile % across_ * size_.across;
    int const y0 = region_.y0 + tile / across_ * size_.down;
    return {x0, y0, std::min(x0 + size_.across, region_.x1), std::min(y0 + size_.down, region_.y1)};
  }

  /// Calls work(array, first, count) for each row of a tile in each array of floats.
  template <class Work>
  void rows_of(Strip& strip, Box const& box, Work const& work) const {
    std::size_t const channels = options_.spectral_output ? stage_.bands().count() : 0;
    for (int y = box.y0; y < box.y1; ++y) {
      auto const first = index(strip, box.x0, y);
      auto const count = static_cast<std::size_t>(box.x1 - box.x0);
      work(strip.image.rgb, 3 * first, 3 * count);
      if (!looks()) continue;
      work(strip.look.squares, 3 * first, 3 * count);
      work(strip.look.rays, first, count);
      if (channels > 0) work(strip.image.bands, channels * first, channels * count);
    }
  }

  /// A tile that the checkpoint has.
  bool take(Strip& strip, Box const& box, std::uint32_t phase, int tile) {
    auto const known =
        options_.checkpoint->find(first_phase_ + phase, static_cast<std::uint32_t>(tile));
    if (!known) return false;
    std::size_t wanted = 0;
    rows_of(strip, box, [&](std::vector<float>&, std::size_t, std::size_t n) { wanted += n; });
    if (known->values.size() != wanted) return false; // forged
    auto from = known->values.begin();
    rows_of(strip, box, [&](std::vector<float>& to, std::size_t first, std::size_t count) {
      std::copy_n(from, count, to.begin() + static_cast<std::ptrdiff_t>(first));
      from += static_cast<std::ptrdiff_t>(count);
    });
    std::lock_guard const lock(taking_);
    kept_.counts.add(known->counts);
    kept_.cut.add(known->cut);
    return true;
  }

  void keep(Strip& strip, Box const& box, std::uint32_t phase, int tile, Tracer const& tracer,
            std::uint64_t lost, RayCounts const& before, CutLight const& cut_before) {
    TileResult result;
    result.counts = tracer.counts();
    result.counts.subtract(before);
    result.cut = tracer.cut_light();
    result.cut.paths -= cut_before.paths;
    result.cut.sum = subdivides() ? lost : result.cut.sum - cut_before.sum;
    rows_of(strip, box, [&](std::vector<float>& from, std::size_t first, std::size_t count) {
      auto const begin = from.begin() + static_cast<std::ptrdiff_t>(first);
      result.values.insert(result.values.end(), begin, begin + static_cast<std::ptrdiff_t>(count));
    });
    options_.checkpoint->keep(first_phase_ + phase, static_cast<std::uint32_t>(tile), result);
  }

  /// The first in rows stays, whatever the order in which they were found.
  void keep(PixelSampler::Wrong const& wrong) {
    std::lock_guard const lock(wrong_mutex_);
    if (wrong_ && number(wrong.pixel) > first_wrong_) return;
    first_wrong_ = number(wrong.pixel);
    wrong_ = wrong;
  }

  /// Traces the sample again, with a record of its path.
  BadSample look_into(PixelSampler::Wrong const& wrong) const {
    transport::PathRecord record(transport::negative_light_is_wrong(stage_));
    Tracer tracer = make_tracer(&record);
    tracer.trace({&wrong.x, &wrong.y, 1, options_.width, options_.height}, {&wrong.key, 1});
    return {wrong.kind, wrong.pixel.x, wrong.pixel.y, wrong.key.number, wrong.rgb, record.path()};
  }

  void report(std::uint32_t phase) {
    auto const finished = ++finished_[phase];
    if (!options_.on_progress) return;
    std::unique_lock const lock(progress_, std::try_to_lock);
    if (!lock) return;
    double const tiles = static_cast<double>(across_) * down_;
    auto const other = static_cast<double>(finished_[1 - phase].load());
    double const mine = static_cast<double>(finished);
    double const done = phase == 0 ? first_share_ * mine + (1 - first_share_) * other
                                   : first_share_ * other + (1 - first_share_) * mine;
    options_.on_progress({done / tiles, rays_.load()});
  }

  Stage const& stage_;
  RenderOptions const& options_;
  plan::WorkingSpace const& space_;
  bool linear_; ///< linear rows are handed on, whatever the numbers of the scene
  Region region_;
  TileSize size_;
  int across_, down_;         ///< tiles
  std::uint32_t first_phase_; ///< of this pass, in the checkpoint
  int strip_rows_ = 1;        ///< rows of tiles in a strip
  double first_share_ = 1;    ///< of the work that the first phase is
  RenderResult result_;
  std::atomic<std::uint64_t> lost_ = 0; ///< PixelSampler::lost() of the tiles made
  TileResult kept_;                     ///< counts of the tiles that the checkpoint had
  tbb::enumerable_thread_specific<Worker> workers_;
  std::atomic<std::uint64_t> rays_{0};
  std::atomic<std::uint64_t> finished_[2]{};
  std::mutex progress_, taking_, wrong_mutex_;
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  std::atomic<std::size_t> first_wrong_{none};
  std::atomic<bool> refused_{false}; ///< rows: nobody wants more
  std::optional<PixelSampler::Wrong> wrong_;
};

/// Fewer tiles than this leave threads idle at the end, or from the beginning.
constexpr int enough_tiles = 64;
/// Rays of neighbouring pixels of a row are traced together.
constexpr int least_across = 8;

} // namespace

TileSize tile_size(RenderOptions const& options) {
  if (options.tile_size > 0) return {options.tile_size, options.tile_size};
  Region const region = options.pixels();
  TileSize size{usual_tile, usual_tile};
  auto const tiles = [&] {
    auto const count = [](int pixels, int each) {
      return std::int64_t{(pixels + each - 1) / each};
    };
    return count(region.x1 - region.x0, size.across) * count(region.y1 - region.y0, size.down);
  };
  while (tiles() < enough_tiles && size.down > 1) size.down /= 2;
  while (tiles() < enough_tiles && size.across > least_across) size.across /= 2;
  return size;
}

void make_linear(image::Image& rows, Stage const& stage, plan::WorkingSpace const& space) {
  if (stage.spectral || space.is_linear()) return;
  space.to_linear(std::span<float>(rows.rgb));
}

RenderResult make_frame(Stage const& stage, RenderOptions const& options,
                        plan::WorkingSpace const& space, bool linear, int pass) {
  Frame frame(stage, options, space, linear, pass);
  if (options.checkpoint && pass == 0)
    options.checkpoint->begin(frame.tiles(),
                              frame.phases() * static_cast<std::uint32_t>(options.passes));
  return frame.run();
}

} // namespace abbe::render
