// SPDX-License-Identifier: MIT
#include "study/prober.hpp"

#include "base/stopwatch.hpp"
#include "plan/palette.hpp"
#include "render/passes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <thread>

namespace abbe::study {
namespace {

/// Samples of a half of the reference, round by round; all of them count.
constexpr std::array reference_depths{4, 6, 8, 11, 16};
/// Where the time is given: it begins with what takes little.
constexpr std::array quick_depths{2, 2, 3, 4, 6, 8, 11, 16};
/// Peaks of measured lamps, in steps of 5 nm, are lines for wider bands, which changes them.
constexpr int reference_bands = 32, reference_bands_with_lines = 96;
constexpr int fewest_patches = 16;
constexpr int least_side = 4;
constexpr int reference_rays_a_split = 4;
/// Patches that tell how long all of the picture takes.
constexpr int most_calibrating = 400;
/// Of the grids that reckon() looks at.
constexpr int shallow = 2, less_shallow = 3;

int samples_of(int depth) {
  return depth * depth + 1;
}

} // namespace

Prober::Prober(scene::Scene const& scene, plan::Overrides const& overrides,
               render::RenderOptions const& options, bool keep_aa)
    : scene_(scene), overrides_(overrides), options_(options), keep_aa_(keep_aa) {
  options_.on_progress = nullptr;
  options_.on_rows = nullptr;
  options_.checkpoint = nullptr;
  options_.rays_of_pixels = nullptr;
  options_.spectral_output = false;
  threads_ = options_.threads > 0
                 ? options_.threads
                 : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  set_patches(patch_count);
}

void Prober::set_patches(int count, int side) {
  patches_ = spread_patches(options_.width, options_.height, count, side,
                            side != patch_side || count != patch_count);
  // Every fourth goes first.
  std::vector<render::Region> ordered;
  for (std::size_t first : {0, 2, 1, 3})
    for (std::size_t i = first; i < patches_.regions.size(); i += 4)
      ordered.push_back(patches_.regions[i]);
  patches_.regions = std::move(ordered);
  some_ = patches_;
  if (patches_.regions.size() < fewest_patches) return;
  some_.regions.resize(patches_.regions.size() / 4);
  some_.pixels = 0;
  for (auto const& r : some_.regions) some_.pixels += (r.x1 - r.x0) * (r.y1 - r.y0);
}

std::optional<Error> Prober::plan() {
  auto const made = plan::make_plan(scene_, overrides_);
  if (!made) return made.error();
  spectral_ = made->spectral.has_value();
  disperses_ = made->has(plan::Effect::Dispersion) || made->has(plan::Effect::StochasticDispersion);
  if (spectral_) {
    auto const& bands = made->spectral->bands;
    given_bands_ = bands.count();
    auto const kind = scene_.settings.spectral.representation.kind;
    using Kind = scene::Representation::Kind;
    bool const free =
        !overrides_.representation && (kind == Kind::Bands || kind == Kind::Composite);
    composite_ = free && !plan::find_lines_nm(scene_, bands).empty();
  }
  // What is no work on pixels: of the scene, and of each patch.
  auto const cpu_s = [&](std::vector<render::Region> const& regions) {
    Stopwatch const since;
    render::render_regions(scene_, *made, options_, regions);
    return since.cpu_s();
  };
  auto points = patches_.regions;
  for (auto& r : points) {
    r.x1 = r.x0 + 1;
    r.y1 = r.y0 + 1;
  }
  cpu_s(points); // the first time, tables are made
  prepare_s_ = cpu_s({});
  a_patch_s_ = std::max(0.0, cpu_s(points) - prepare_s_) / static_cast<double>(points.size());
  return std::nullopt;
}

plan::Overrides Prober::overrides_of(Place const& place) const {
  auto overrides = overrides_;
  if (place.bands > 0) overrides.bands = place.bands;
  if (composite_) {
    overrides.representation.emplace();
    overrides.representation->kind = scene::Representation::Kind::Composite;
  }
  if (place.way->mode) overrides.dispersion = place.way->mode(place.way->steps[place.step]);
  return overrides;
}

render::AntiAliasing Prober::aa_of(Place const& place) const {
  auto aa = options_.anti_aliasing;
  if (keep_aa_) return aa;
  if (place.aa.depth > 0 && place.aa.threshold <= 0) {
    int const samples = place.aa.depth * place.aa.depth;
    return render::AntiAliasing::of({samples, samples});
  }
  aa.method = place.aa.depth > 0 ? 1 : 0;
  if (place.aa.depth > 0) {
    aa.depth = place.aa.depth;
    aa.threshold = place.aa.threshold;
    aa.jitter = 1; // thin lines fall through a grid
  }
  return aa;
}

Probe Prober::probe(plan::Overrides const& overrides, render::AntiAliasing const& aa,
                    std::uint64_t seed, Patches const& patches) {
  auto const plan = plan::make_plan(scene_, overrides);
  if (!plan) return {};
  auto options = options_;
  options.anti_aliasing = aa;
  options.seed = seed;
  Stopwatch const since;
  auto made = render_patches(scene_, *plan, options, patches);
  used_s_ += prepare_s_ + std::max(0.0, since.cpu_s() - prepare_s_) / threads_;
  waited_s_ += made.wall_s;
  if (used_s_ > 0) load_ = std::max(1.0, waited_s_ / used_s_);
  return made;
}

plan::Overrides Prober::reference_overrides() const {
  auto overrides = overrides_;
  if (composite_) overrides = overrides_of({&way_of_the_scene(), 0, 0, {}});
  if (spectral_ && !overrides.bands)
    overrides.bands =
        std::max(composite_ ? reference_bands_with_lines : reference_bands, given_bands_);
  if (disperses_ && !overrides_.dispersion) {
    auto& mode = overrides.dispersion.emplace();
    mode.kind = scene::DispersionMode::Kind::Stochastic; // what all but `none` converge to
    mode.comb.teeth = reference_rays_a_split;
  } else if (disperses_ && overrides_.dispersion->kind != scene::DispersionMode::Kind::None) {
    overrides.dispersion->kind = scene::DispersionMode::Kind::Stochastic;
    overrides.dispersion->comb = {};
    overrides.dispersion->comb.teeth = reference_rays_a_split;
  }
  return overrides;
}

void Prober::fit_patches(double seconds) {
  auto const few =
      spread_patches(options_.width, options_.height, fewest_patches, least_side, true);
  auto const made = probe(reference_overrides(), {}, options_.seed, few);
  double const around = prepare_s_ + a_patch_s_ * static_cast<double>(few.regions.size());
  double const a_pixel_s = std::max(0.0, made.cpu_s - around) / few.pixels;
  double const pixels = seconds * threads_ / load_
                        / std::max(1e-12, 2 * samples_of(quick_depths.front()) * a_pixel_s);
  if (pixels >= patches_.pixels) return;
  auto const squares = [&](int side) { return static_cast<int>(pixels / (side * side)); };
  int const side = squares(patch_side) >= 2 * fewest_patches ? patch_side : least_side;
  set_patches(std::max(fewest_patches, squares(side)), side);
}

void Prober::make_reference(double noise, double seconds) {
  auto const overrides = reference_overrides();
  Stopwatch const since;
  std::vector<Vec3> halves[2];
  int samples = 0;
  double a_sample_s = 0;
  std::span<int const> const depths =
      seconds > 0 ? std::span<int const>(quick_depths) : std::span<int const>(reference_depths);
  for (std::size_t round = 0; round < depths.size(); ++round) {
    int const more = depths[round] * depths[round];
    auto const aa = render::AntiAliasing::of({more, more});
    if (seconds > 0 && since.wall_s() + a_sample_s * more > seconds && round > 0) break;
    for (std::uint64_t half = 0; half < 2; ++half) {
      auto const made = probe(overrides, aa, options_.seed + 1 + 2 * round + half, patches_);
      if (made.colours.empty()) return; // stopped
      auto& sum = halves[half];
      sum.resize(made.colours.size(), Vec3(0));
      for (std::size_t i = 0; i < sum.size(); ++i)
        sum[i] += (made.colours[i] - sum[i]) * (double(more) / (samples + more));
      reference_rays_ += static_cast<double>(made.rays) * scale(patches_);
    }
    samples += more;
    a_sample_s = since.wall_s() / samples;
    reference_.resize(halves[0].size());
    for (std::size_t i = 0; i < reference_.size(); ++i)
      reference_[i] = (halves[0][i] + halves[1][i]) * 0.5;
    // The halves' errors are alike and independent: their mean is off by half of their difference.
    noise_ = 0.5 * mean_delta_e(halves[0], halves[1]);
    if (noise_ <= noise) break;
  }
}

/// Making the scene ready is done once, on one thread.
double Prober::seconds_of(Probe const& made, Patches const& patches) const {
  double const around = prepare_s_ + a_patch_s_ * static_cast<double>(patches.regions.size());
  return prepare_s_ + std::max(0.0, made.cpu_s - around) * scale(patches) / threads_;
}

Seen Prober::look(Place const& place, Patches const& patches) {
  auto options = options_;
  options.anti_aliasing = aa_of(place);
  Probe made;
  for (int pass = 0; pass < place.passes; ++pass) {
    auto const of_pass = render::options_of_pass(options, pass);
    auto const more = probe(overrides_of(place), of_pass.anti_aliasing, of_pass.seed, patches);
    if (pass == 0) made.colours.resize(more.colours.size(), Vec3(0));
    if (more.colours.empty()) made.colours.clear(); // stopped
    for (std::size_t i = 0; i < made.colours.size(); ++i)
      made.colours[i] += more.colours[i] / static_cast<double>(place.passes);
    made.rays += more.rays;
    made.cpu_s += more.cpu_s;
  }
  double const scale_up = scale(patches);
  Seen seen{std::numeric_limits<double>::infinity(), static_cast<double>(made.rays) * scale_up,
            seconds_of(made, patches)};
  if (made.colours.empty() || made.colours.size() > reference_.size()) return seen;
  double const off = mean_delta_e(std::span(reference_).first(made.colours.size()), made.colours);
  // Independent errors add in squares: the reference's own is taken off.
  seen.delta_e = std::sqrt(std::max(0.0, off * off - noise_ * noise_));
  return seen;
}

Seen const& Prober::see(Place const& place) {
  auto const known = seen_.find(place);
  return known != seen_.end() ? known->second
                              : seen_.emplace(place, look(place, some_)).first->second;
}

Seen const& Prober::see_all(Place const& place) {
  if (some_.regions.size() == patches_.regions.size()) return see(place);
  auto const known = seen_all_.find(place);
  return known != seen_all_.end() ? known->second
                                  : seen_all_.emplace(place, look(place, patches_)).first->second;
}

/// With one sample a pixel.
Place Prober::once(Place place) const {
  place.aa = {};
  place.passes = 1;
  return place;
}

void Prober::calibrate(Place const& place, double seconds) {
  Place const off = once(place);
  double const expected_s = std::max(1e-9, load_ * see(off).seconds);
  double const patches = seconds / expected_s * pixels() / (patch_side * patch_side);
  int const count = static_cast<int>(std::min<double>(most_calibrating, patches));
  if (count < fewest_patches) return;
  many_[off] = look(off, spread_patches(options_.width, options_.height, count, patch_side, true));
}

Seen const& Prober::middle(Place const& place) {
  auto const many = many_.find(once(place));
  return many != many_.end() ? many->second : see(once(place));
}

bool Prober::repeats(Place const& place) const {
  auto const plan = plan::make_plan(scene_, overrides_of(place));
  return plan && render::passes_differ(*plan, aa_of(place));
}

/// Of anti-aliasing that is not given.
Seen Prober::one_pass(Place place) {
  int const depth = place.aa.depth;
  Place const off = once(place);
  Seen const& middle = see(off);
  place.passes = 1;
  place.aa.depth = depth <= shallow ? shallow : less_shallow;
  Seen const& grid = see(place);
  int const probed = place.aa.depth * place.aa.depth;
  // Samples of a grid, by those that were made.
  double const samples = static_cast<double>(depth * depth) / probed;
  auto const many = many_.find(off);
  if (aa_of(place).by_samples()) { // of every pixel, and no others
    if (many == many_.end()) return {0, grid.rays * samples, grid.seconds * samples};
    double const all = static_cast<double>(depth * depth);
    return {0, many->second.rays * all, many->second.seconds * all};
  }
  if (many == many_.end())
    return {0, middle.rays + std::max(0.0, grid.rays - middle.rays) * samples,
            middle.seconds + std::max(0.0, grid.seconds - middle.seconds) * samples};
  // Many patches tell what a sample takes, few how many are made: all, and the middle again, at
  // most.
  double const more = std::clamp(grid.rays / std::max(1.0, middle.rays) - 1, 0.0, probed + 1.0);
  Seen const& whole = many->second;
  return {0, whole.rays * (1 + more * samples), whole.seconds * (1 + more * samples)};
}

Seen Prober::reckon(Place const& place) {
  auto few = place, more = place;
  few.passes = more.passes = 1;
  double few_samples = 1, more_samples = 2, samples = place.passes;
  double rays = 0, seconds = 0;
  if (keep_aa_) {
    more.passes = 2;
    rays = middle(place).rays * place.passes;
    seconds = middle(place).seconds * place.passes;
  } else {
    few.aa.depth = shallow;
    more.aa.depth = less_shallow;
    few_samples = samples_of(shallow);
    more_samples = samples_of(less_shallow);
    // The ray through the middle counts in the first pass, and tells which pixels are sampled
    // again. Samples that are in all pixels have none.
    bool const by_samples = aa_of(place).by_samples();
    samples = place.passes * place.aa.depth * place.aa.depth + (by_samples ? 0 : 1);
    Seen const one = one_pass(place);
    rays = one.rays * place.passes;
    seconds = one.seconds * place.passes;
  }
  // Of the error's square, what falls with the number of samples, and what does not.
  double const few_e = see(few).delta_e, more_e = see(more).delta_e;
  double const falls =
      std::max(0.0, (few_e * few_e - more_e * more_e) / (1 / few_samples - 1 / more_samples));
  double const stays = std::max(0.0, more_e * more_e - falls / more_samples);
  return {std::sqrt(stays + falls / samples), rays, seconds};
}

} // namespace abbe::study
