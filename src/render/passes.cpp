// SPDX-License-Identifier: MIT
#include "render/passes.hpp"

#include "base/random.hpp"
#include "render/frame.hpp"

#include <algorithm>

namespace abbe::render {
namespace {

/// Apart from the keys of rows, which are children of the seed's too.
constexpr std::uint64_t passes_key = 0x506173736573ULL;

/// Of all passes, pixel by pixel.
class Sums {
public:
  Sums(int width, int height, std::size_t bands)
      : width_(width),
        height_(height),
        rgb_(3 * static_cast<std::size_t>(width) * height),
        bands_(bands * static_cast<std::size_t>(width) * height) {}

  void begin_pass() { row_ = 0; }
  void add(image::Image const& rows) {
    add(rgb_, rows.rgb, row_);
    add(bands_, rows.bands, row_);
    row_ += rows.height;
    centres_nm_ = rows.band_centres_nm;
    edges_nm_ = rows.band_edges_nm;
  }

  /// Rows of the mean.
  image::Image mean(int first, int count, int passes) const {
    image::Image rows = image::make_image(width_, count);
    rows.bands.resize(per_row(bands_) * static_cast<std::size_t>(count));
    divide(rgb_, rows.rgb, first, passes);
    divide(bands_, rows.bands, first, passes);
    rows.band_centres_nm = centres_nm_;
    rows.band_edges_nm = edges_nm_;
    return rows;
  }

private:
  std::size_t per_row(std::vector<double> const& sums) const {
    return sums.size() / static_cast<std::size_t>(height_);
  }
  void add(std::vector<double>& sums, std::vector<float> const& values, int row) const {
    double* const at = sums.data() + per_row(sums) * static_cast<std::size_t>(row);
    for (std::size_t i = 0; i < values.size(); ++i) at[i] += static_cast<double>(values[i]);
  }
  void divide(std::vector<double> const& sums, std::vector<float>& out, int row, int passes) const {
    double const* const at = sums.data() + per_row(sums) * static_cast<std::size_t>(row);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = static_cast<float>(at[i] / passes);
  }

  int width_, height_, row_ = 0;
  std::vector<double> rgb_, bands_;
  std::vector<double> centres_nm_, edges_nm_;
};

/// Adds what a pass tells beside its picture.
void add_report(RenderResult& all, RenderResult const& pass) {
  double const before = static_cast<double>(all.counts.camera);
  double const more = static_cast<double>(pass.counts.camera);
  all.missing_mean =
      (all.missing_mean * before + pass.missing_mean * more) / std::max(1.0, before + more);
  all.missing_most = std::max(all.missing_most, pass.missing_most);
  all.counts.add(pass.counts);
  all.interrupted = pass.interrupted;
  all.bad_sample = pass.bad_sample;
}

} // namespace

RenderOptions options_of_pass(RenderOptions const& options, int pass) {
  RenderOptions out = options;
  out.passes = 1;
  out.passes_wanted = nullptr;
  if (pass == 0) return out;
  out.seed =
      RandomKey(options.seed).child(passes_key).child(static_cast<std::uint64_t>(pass)).bits();
  out.anti_aliasing.middle_counts = false;
  return out;
}

bool passes_differ(plan::Plan const& plan, AntiAliasing const& anti_aliasing) {
  return plan.has(plan::Effect::StochasticDispersion) || plan.has(plan::Effect::AreaLights)
         || anti_aliasing.by_samples() || (anti_aliasing.method == 1 && anti_aliasing.jitter > 0);
}

double bytes_of_sums(plan::Plan const& plan, RenderOptions const& options) {
  Region const region = options.pixels();
  double const pixels = static_cast<double>(region.x1 - region.x0) * (region.y1 - region.y0);
  double const bands = options.spectral_output ? plan.spectral->bands.count() : 0;
  return pixels * (3 + bands) * sizeof(double);
}

RenderResult make_passes(Stage const& stage, RenderOptions const& options,
                         plan::WorkingSpace const& space) {
  Region const region = options.pixels();
  int const height = region.y1 - region.y0;
  std::size_t const bands = options.spectral_output ? stage.film_bands() : 0;
  Sums sums(region.x1 - region.x0, height, bands);
  RenderResult all;
  int wanted = options.passes, pass = 0;
  for (; pass < wanted; ++pass) {
    RenderOptions one = options_of_pass(options, pass);
    one.passes = options.passes; // for the checkpoint
    one.on_rows = [&](image::Image const& rows) {
      sums.add(rows);
      return true;
    };
    if (options.on_progress)
      one.on_progress = [&](Progress const& progress) {
        options.on_progress({(pass + progress.share) / wanted, all.counts.total() + progress.rays});
      };
    sums.begin_pass();
    add_report(all, make_frame(stage, one, space, false, pass));
    all.passes = pass;
    if (all.interrupted || all.bad_sample) return all;
    if (options.passes_wanted) wanted = options.passes_wanted(pass + 1);
  }
  all.passes = pass;
  auto const finished = [&](int first, int count) {
    image::Image rows = sums.mean(first, count, pass);
    make_linear(rows, stage, space);
    return rows;
  };
  if (!options.on_rows) {
    all.image = finished(0, height);
    return all;
  }
  std::size_t const row_bytes =
      (3 + bands) * sizeof(float) * static_cast<std::size_t>(region.x1 - region.x0);
  int const some = static_cast<int>(
      std::clamp<std::size_t>(options.rows_bytes / row_bytes, 1, static_cast<std::size_t>(height)));
  for (int row = 0; row < height; row += some)
    if (!options.on_rows(finished(row, std::min(some, height - row)))) break;
  return all;
}

} // namespace abbe::render
