// SPDX-License-Identifier: MIT
#include "study/search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace abbe::study {
namespace {

/// Of the time: what the picture may be expected to take while choosing goes on, and until when it
/// goes on.
constexpr double picture_share = 0.75, choosing_share = 0.18;
/// Of the picture's time: one pass. Its end misses the time by half of a pass at most.
constexpr double pass_share = 0.25;
/// Of the time: a last look at how long the picture takes.
constexpr double calibrating_share = 0.04;
/// Of a pass: what is not known well costs no more than this.
constexpr int deepest = 8;
constexpr double most_passes = 1e6;
constexpr std::array thresholds{0.0, 0.03, 0.3};
/// Of the time: what counts as within it.
constexpr double most_late = 1.25;

class TimeSearch {
public:
  explicit TimeSearch(Question const& question) : q_(question) {}

  Answer run() {
    double const seconds = q_.target.seconds;
    auto const ways = q_.open_ways();
    for (std::size_t i = 0; i < ways.size(); ++i) {
      double const now = q_.elapsed_s();
      double const left = choosing_share * seconds - now;
      if (found_ && left <= 0) break;
      climb(q_.first_place(*ways[i]),
            now + std::max(0.0, left) / static_cast<double>(ways.size() - i));
    }
    q_.prober.calibrate(best_.place, calibrating_share * seconds);
    best_ = fitted(best_.place, (seconds - q_.elapsed_s()) / q_.prober.load());
    best_.seen.seconds *= q_.prober.load();
    best_.reached = q_.elapsed_s() + best_.seen.seconds <= most_late * seconds;
    return best_;
  }

private:
  Seen const& see(Place const& place) const { return q_.prober.see(place); }

  /// How often one pass fits; the first, and those after it.
  static int passes_in(double seconds, double first_s, double more_s) {
    double const more = std::floor((seconds - first_s) / std::max(1e-9, more_s));
    return 1 + static_cast<int>(std::clamp(more, 0.0, most_passes));
  }

  /// A grid of which some passes fit, and how many; the threshold is that of the place.
  Answer fitted(Place place, double seconds) const {
    place.passes = 1;
    if (q_.target.keep_aa) {
      if (!q_.prober.repeats(place)) return {place, see(place), true};
      double const one_s = q_.prober.reckon(place).seconds;
      place.passes = passes_in(seconds, one_s, one_s);
      return {place, q_.prober.reckon(place), true};
    }
    auto off = place;
    off.aa = {};
    Answer const plain{off, see(off), true};
    if (plain.seen.seconds > seconds) return plain;
    place.aa.depth = 1;
    auto const of_passes = [&](int passes) {
      place.passes = passes;
      return q_.prober.reckon(place);
    };
    for (int depth = 2; depth <= deepest; depth += 1) {
      place.aa.depth = depth;
      double const first_s = of_passes(1).seconds;
      if (of_passes(2).seconds - first_s <= pass_share * seconds) continue;
      place.aa.depth = depth - 1;
      break;
    }
    double const first_s = of_passes(1).seconds;
    if (first_s > seconds) return plain;
    // More samples are better, also where a few patches happen not to say so.
    Seen const seen = of_passes(passes_in(seconds, first_s, of_passes(2).seconds - first_s));
    return {place, seen, true};
  }

  /// From the cheapest setting on, the next step that makes the best picture in the time.
  void climb(Place at, double until) {
    double const seconds = picture_share * q_.target.seconds / q_.prober.load();
    at.aa.threshold = thresholds.front();
    Answer here = fitted(at, seconds);
    consider(here, at.aa.threshold);
    while (!q_.stopped() && q_.elapsed_s() < until) {
      std::optional<Place> next;
      Answer best = here;
      double best_threshold = at.aa.threshold;
      std::vector<std::optional<Place>> nearby{q_.next_step(at), q_.more_bands(at)};
      for (double const threshold : thresholds) {
        if (threshold == at.aa.threshold || q_.target.keep_aa) continue;
        nearby.emplace_back(at)->aa.threshold = threshold;
      }
      for (auto const& place : nearby) {
        if (!place || q_.stopped() || q_.elapsed_s() > until) continue;
        Answer const answer = fitted(*place, seconds);
        if (answer.seen.seconds <= seconds && answer.seen.delta_e < best.seen.delta_e) {
          best = answer;
          next = place;
          best_threshold = place->aa.threshold;
        }
      }
      if (!next) break;
      at = *next;
      here = best;
      consider(here, best_threshold);
    }
  }

  void consider(Answer const& answer, double threshold) {
    double const seconds = picture_share * q_.target.seconds / q_.prober.load();
    bool const fits = answer.seen.seconds <= seconds;
    bool better = !found_;
    if (found_ && fits != (best_.seen.seconds <= seconds))
      better = fits;
    else if (found_)
      better = fits ? answer.seen.delta_e < best_.seen.delta_e
                    : answer.seen.seconds < best_.seen.seconds;
    if (!better) return;
    best_ = answer;
    best_.place.aa.threshold = threshold;
    found_ = true;
  }

  Question const& q_;
  bool found_ = false;
  Answer best_;
};

} // namespace

Answer search_for_time(Question const& question) {
  return TimeSearch(question).run();
}

} // namespace abbe::study
