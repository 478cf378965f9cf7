// SPDX-License-Identifier: MIT
#include "study/search.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace abbe::study {
namespace {

/// From none to many samples in every pixel.
constexpr std::array aa_steps{AaStep{0, 0},  AaStep{2, 0.3}, AaStep{3, 0.1}, AaStep{3, 0.01},
                              AaStep{3, 0},  AaStep{4, 0},   AaStep{6, 0},   AaStep{8, 0},
                              AaStep{11, 0}, AaStep{16, 0},  AaStep{23, 0},  AaStep{32, 0}};
/// What counts as landed: of the target.
constexpr double land_low = 0.85, land_high = 0.97;
constexpr double most_over = 1.06; ///< of all patches
constexpr int most_aims = 4;
constexpr int most_halvings = 5;
/// The highest threshold: no pixel is sampled again.
constexpr double no_threshold = 3, least_threshold = 1e-3;
/// A gain that is less than this for twice the rays, three times in a row, is none.
constexpr double least_gain = 0.02;

class ErrorSearch {
public:
  ErrorSearch(Question const& question, double wanted) : q_(question), wanted_(wanted) {}

  Place run() {
    for (auto const* way : q_.open_ways()) climb(q_.first_place(*way));
    return *best_;
  }

private:
  Seen const& see(Place const& place) const { return q_.prober.see(place); }
  bool good(Seen const& seen) const { return seen.delta_e <= wanted_; }
  bool too_dear(Seen const& seen) const {
    return seen.rays > q_.prober.reference_rays()
           || (best_ && good(see(*best_)) && seen.rays >= see(*best_).rays);
  }

  std::optional<Place> finer_aa(Place place) const {
    auto const at = std::find(aa_steps.begin(), aa_steps.end(), place.aa);
    if (q_.target.keep_aa || at == aa_steps.end() || at + 1 == aa_steps.end()) return std::nullopt;
    place.aa = *(at + 1);
    return place;
  }

  /// From the cheapest setting on, of the next steps the one that lowers the error most for its
  /// rays.
  void climb(Place at) {
    consider(at);
    int idle = 0;
    while (!q_.stopped() && !good(see(at)) && idle < 3) {
      std::optional<Place> best;
      double best_gain = 0;
      for (auto const& next : {q_.more_bands(at), q_.next_step(at), finer_aa(at)}) {
        if (!next || q_.stopped()) continue;
        Seen const& seen = see(*next);
        double const gain = std::log(see(at).delta_e / std::max(1e-9, seen.delta_e))
                            / std::max(0.05, std::log(seen.rays / see(at).rays));
        if (!best || gain > best_gain) {
          best = next;
          best_gain = gain;
        }
      }
      if (!best || too_dear(see(*best))) break;
      idle = best_gain < least_gain ? idle + 1 : 0;
      Place const before = at;
      at = *best;
      consider(at);
      if (good(see(at))) land(before, at);
    }
  }

  /// Between a place that is not good enough and one that is.
  void land(Place const& coarse, Place const& fine) {
    if (fine.step != coarse.step) return;
    enum class By { Bands, Depth, Threshold };
    By const by = fine.bands != coarse.bands ? By::Bands
                  : fine.aa.depth > coarse.aa.depth + 1 && fine.aa.threshold == coarse.aa.threshold
                      ? By::Depth
                      : By::Threshold;
    double lo = by == By::Bands   ? std::log(coarse.bands)
                : by == By::Depth ? std::log(coarse.aa.depth)
                                  : std::log(no_threshold);
    double hi = by == By::Bands   ? std::log(fine.bands)
                : by == By::Depth ? std::log(fine.aa.depth)
                                  : std::log(std::max(least_threshold, fine.aa.threshold));
    for (int i = 0; i < most_halvings && !q_.stopped(); ++i) {
      double const middle = std::exp(0.5 * (lo + hi));
      auto const whole = static_cast<int>(std::lround(middle));
      Place place = fine;
      if (by == By::Bands) {
        if (whole == coarse.bands || whole == fine.bands) break;
        place.bands = whole;
      } else if (by == By::Depth) {
        if (whole == coarse.aa.depth || whole == fine.aa.depth) break;
        place.aa.depth = whole;
      } else {
        place.aa.threshold = middle;
      }
      Seen const& seen = see(place);
      consider(place);
      if (good(seen) && seen.delta_e >= land_low * wanted_) break;
      (good(seen) ? hi : lo) = 0.5 * (lo + hi);
    }
  }

  void consider(Place const& place) {
    if (!best_) {
      best_ = place;
      return;
    }
    Seen const& seen = see(place);
    Seen const& best = see(*best_);
    bool better = seen.delta_e < best.delta_e;
    if (good(seen) || good(best)) better = good(seen) && (!good(best) || seen.rays < best.rays);
    if (better) best_ = place;
  }

  Question const& q_;
  double wanted_;
  std::optional<Place> best_;
};

} // namespace

Answer search_for_error(Question const& question) {
  double const target = question.target.delta_e;
  double wanted = land_high * target;
  Answer best;
  // What a part of the patches says is held against all of them, and the search aims anew.
  for (int i = 0; i < most_aims; ++i) {
    Place const place = ErrorSearch(question, wanted).run();
    Seen const seen = question.prober.see_all(place);
    bool const reached = seen.delta_e <= most_over * target;
    bool const better = i == 0
                        || (reached ? !best.reached || seen.rays < best.seen.rays
                                    : !best.reached && seen.delta_e < best.seen.delta_e);
    if (better) best = {place, seen, reached};
    if (question.stopped() || !(seen.delta_e > 0)) break;
    if (reached && seen.delta_e >= land_low * target) break;
    double const next = wanted * target / seen.delta_e;
    if (next > 4 * target) break; // the cheapest setting is more exact than asked for
    wanted = next;
  }
  return best;
}

} // namespace abbe::study
