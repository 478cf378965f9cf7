// SPDX-License-Identifier: MIT
#include "study/target.hpp"

#include "study/patches.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <thread>

namespace abbe::study {
namespace {

using Kind = scene::DispersionMode::Kind;

/// Steps of anti-aliasing, from none to every pixel.
struct AaStep {
  int depth;
  double threshold;
};
constexpr std::array aa_steps{AaStep{0, 0},    AaStep{2, 0.3},  AaStep{3, 0.3},
                              AaStep{3, 0.1},  AaStep{3, 0.03}, AaStep{4, 0.01},
                              AaStep{5, 1e-3}, AaStep{7, 1e-3}, AaStep{9, 1e-3}};
constexpr int most_bands = 512;
constexpr int first_bands = 4;
/// What counts as landed: of the target.
constexpr double land_low = 0.88, land_high = 1.05;
constexpr int most_halvings = 7;
/// Choosing may take this much of a time; the rest is for the picture.
constexpr double probing_share = 0.3;
/// The highest threshold: no pixel is sampled again.
constexpr double no_threshold = 3;

/// A point of the search.
struct Place {
  std::string mode; ///< "" as the scene has it
  int bands = 0;    ///< 0: r g b, or as the scene has it
  AaStep aa{0, 0};
  bool operator<(Place const& other) const {
    return std::tie(mode, bands, aa.depth, aa.threshold)
           < std::tie(other.mode, other.bands, other.aa.depth, other.aa.threshold);
  }
};

struct Seen {
  double delta_e = 0, rays = 0, seconds = 0; ///< of the whole picture, expected
};

class Chooser {
public:
  Chooser(scene::Scene const& scene, plan::Overrides const& overrides,
          render::RenderOptions const& options, Target const& target)
      : scene_(scene),
        overrides_(overrides),
        options_(options),
        target_(target),
        patches_(spread_patches(options.width, options.height)) {
    options_.on_progress = nullptr;
    options_.on_rows = nullptr;
    options_.checkpoint = nullptr;
    options_.rays_of_pixels = nullptr;
    options_.spectral_output = false;
    options_.tile_size = patches_.regions.size() == 1 ? 16 : 5;
    threads_ = options_.threads > 0
                   ? options_.threads
                   : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    scale_ = static_cast<double>(options_.width) * options_.height / patches_.pixels;
  }

  Result<Choice> choose() {
    auto const plan = plan::make_plan(scene_, overrides_);
    if (!plan) return plan.error();
    spectral_ = plan->spectral.has_value();
    disperses_ =
        plan->has(plan::Effect::Dispersion) || plan->has(plan::Effect::StochasticDispersion);
    given_bands_ = plan->spectral ? plan->spectral->count() : 0;
    make_reference();
    std::vector<std::string> modes{""};
    if (disperses_ && !overrides_.dispersion) modes = {"none", "stochastic", "deterministic"};
    for (auto const& mode : modes) climb(mode);
    return result();
  }

private:
  double elapsed_s() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }
  bool stopped() const {
    return (options_.stop && options_.stop->load())
           || (target_.seconds > 0 && elapsed_s() > probing_share * target_.seconds);
  }

  Probe probe(Place const& place) {
    auto overrides = overrides_;
    if (place.bands > 0) overrides.bands = place.bands;
    if (!place.mode.empty()) {
      scene::DispersionMode mode;
      mode.kind = place.mode == "none"            ? Kind::None
                  : place.mode == "deterministic" ? Kind::Deterministic
                                                  : Kind::Stochastic;
      overrides.dispersion = mode;
    }
    auto const plan = plan::make_plan(scene_, overrides);
    if (!plan) return {};
    auto options = options_;
    options.anti_aliasing = aa_of(place);
    return render_patches(scene_, *plan, options, patches_);
  }

  render::AntiAliasing aa_of(Place const& place) const {
    auto aa = options_.anti_aliasing;
    if (target_.keep_aa) return aa;
    aa.method = place.aa.depth > 0 ? 1 : 0;
    if (place.aa.depth > 0) {
      aa.depth = place.aa.depth;
      aa.threshold = place.aa.threshold;
    }
    return aa;
  }

  /// Many samples a pixel, each with its own jittered wavelengths.
  void make_reference() {
    Place place;
    // Lamps with lines need the scene's own number of bands to be seen at all.
    if (spectral_ && !overrides_.bands) place.bands = std::max(disperses_ ? 8 : 64, given_bands_);
    if (disperses_ && !(overrides_.dispersion && overrides_.dispersion->kind == Kind::None))
      place.mode = "stochastic"; // what all but `none` converge to
    // Its own noise is to be well below what is asked for.
    place.aa = {target_.delta_e > 0 && target_.delta_e < 1 ? 7 : 6, 0};
    if (target_.seconds > 0) place.aa.depth = 4;
    auto const keep = std::exchange(target_.keep_aa, false);
    auto const made = probe(place);
    reference_ = made.colours;
    reference_cost_ = {0, static_cast<double>(made.rays) * scale_, made.cpu_s * scale_ / threads_};
    target_.keep_aa = keep;
  }

  Seen const& see(Place const& place) {
    auto const known = seen_.find(place);
    if (known != seen_.end()) return known->second;
    auto const made = probe(place);
    Seen seen{std::numeric_limits<double>::infinity(), static_cast<double>(made.rays) * scale_,
              made.cpu_s * scale_ / threads_};
    if (made.colours.size() == reference_.size() && !reference_.empty())
      seen.delta_e = mean_delta_e(reference_, made.colours);
    return seen_.emplace(place, seen).first->second;
  }

  /// What it costs: rays, that are the same in each run, or seconds.
  double cost(Seen const& seen) const { return target_.seconds > 0 ? seen.seconds : seen.rays; }
  double time_left() const { return target_.seconds - elapsed_s(); }
  bool good(Seen const& seen) const { return seen.delta_e <= land_high * target_.delta_e; }

  std::optional<Place> more_bands(Place place) const {
    if (place.bands == 0 || place.mode == "none" || overrides_.bands || place.bands >= most_bands)
      return std::nullopt;
    place.bands *= 2;
    return place;
  }
  std::optional<Place> finer_aa(Place place) const {
    if (target_.keep_aa) return std::nullopt;
    for (std::size_t i = 0; i + 1 < aa_steps.size(); ++i)
      if (aa_steps[i].depth == place.aa.depth && aa_steps[i].threshold == place.aa.threshold) {
        place.aa = aa_steps[i + 1];
        return place;
      }
    return std::nullopt;
  }

  void climb(std::string const& mode) {
    Place at{mode, 0, {0, 0}};
    if (spectral_) at.bands = overrides_.bands ? 0 : mode == "none" ? 8 : first_bands;
    consider(at);
    while (!stopped() && !done(see(at))) {
      std::optional<Place> best;
      double best_gain = 0;
      for (auto const& next : {more_bands(at), finer_aa(at)}) {
        if (!next || stopped() || cost(see(at)) > 0.25 * cost(reference_cost_)) continue;
        Seen const& seen = see(*next);
        double const gain = std::log(see(at).delta_e / std::max(1e-9, seen.delta_e))
                            / std::max(0.05, std::log(cost(seen) / cost(see(at))));
        if (!best || gain > best_gain) {
          best = next;
          best_gain = gain;
        }
      }
      // Nothing can be told of what is as fine as the reference; dearer than what is good: no.
      if (!best || cost(see(*best)) > 0.5 * cost(reference_cost_)
          || (best_ && good(see(*best_)) && cost(see(*best)) >= cost(see(*best_))))
        break;
      if (target_.seconds > 0 && see(*best).seconds > time_left()) {
        land(at, *best);
        return;
      }
      Place const before = at;
      at = *best;
      consider(at);
      if (target_.delta_e > 0 && good(see(at))) land(before, at);
    }
  }

  bool done(Seen const& seen) const { return target_.delta_e > 0 && good(seen); }

  /// Between a place that is not good enough (or too cheap) and one that is (or too dear).
  void land(Place const& coarse, Place const& fine) {
    bool const bands = fine.bands != coarse.bands;
    double lo = bands ? std::log(coarse.bands) : std::log(std::max(1e-3, fine.aa.threshold));
    double hi = bands ? std::log(fine.bands) : std::log(no_threshold);
    for (int i = 0; i < most_halvings && !stopped(); ++i) {
      double const middle = 0.5 * (lo + hi);
      Place place = fine;
      if (bands) {
        place.bands = static_cast<int>(std::lround(std::exp(middle)));
        if (place.bands == coarse.bands || place.bands == fine.bands) break;
      } else {
        place.aa.threshold = std::exp(middle);
      }
      Seen const& seen = see(place);
      bool const enough =
          target_.seconds > 0 ? seen.seconds > time_left() : seen.delta_e <= target_.delta_e;
      if (target_.seconds > 0 ? !enough : good(seen)) consider(place);
      bool const landed = target_.seconds > 0
                              ? seen.seconds < time_left() && seen.seconds > 0.8 * time_left()
                              : seen.delta_e >= land_low * target_.delta_e && good(seen);
      if (landed) break;
      (enough == bands ? hi : lo) = middle; // more bands are finer, a higher threshold coarser
    }
  }

  void consider(Place const& place) {
    Seen const& seen = see(place);
    if (!best_) {
      best_ = place;
      return;
    }
    Seen const& best = see(*best_);
    bool better = seen.delta_e < best.delta_e;
    if (target_.seconds > 0)
      better = better && seen.seconds <= time_left();
    else if (good(seen) || good(best))
      better = good(seen) && (!good(best) || seen.rays < best.rays);
    if (better) best_ = place;
  }

  Choice result() {
    Choice choice;
    Seen const& seen = see(*best_);
    if (spectral_) choice.bands = best_->bands > 0 ? best_->bands : given_bands_;
    choice.dispersion = best_->mode;
    choice.aa = aa_of(*best_);
    choice.expected_delta_e = seen.delta_e;
    choice.expected_s = seen.seconds;
    choice.reached = target_.seconds > 0 ? seen.seconds <= std::max(0.0, time_left()) : good(seen);
    choice.probes = static_cast<int>(seen_.size()) + 1;
    choice.probe_share = 1 / scale_;
    if (!choice.dispersion.empty()) choice.text += choice.dispersion + ", ";
    if (choice.bands) choice.text += fmt::format("{} bands, ", *choice.bands);
    choice.text += choice.aa.method == 0 ? std::string("no anti-aliasing")
                                         : fmt::format("aa {} (threshold {:.3g})", choice.aa.depth,
                                                       choice.aa.threshold);
    return choice;
  }

  scene::Scene const& scene_;
  plan::Overrides overrides_;
  render::RenderOptions options_;
  Target target_;
  Patches patches_;
  bool spectral_ = false, disperses_ = false;
  int given_bands_ = 0, threads_ = 1;
  double scale_ = 1;
  std::vector<Vec3> reference_;
  Seen reference_cost_;
  std::map<Place, Seen> seen_;
  std::optional<Place> best_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

} // namespace

Result<Choice> choose_setting(scene::Scene const& scene, plan::Overrides const& overrides,
                              render::RenderOptions const& options, Target const& target) {
  return Chooser(scene, overrides, options, target).choose();
}

} // namespace abbe::study
