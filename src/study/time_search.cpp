// SPDX-License-Identifier: MIT
#include "study/search.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace abbe::study {
namespace {

/// Of the time: what the picture may be expected to take while choosing goes on, and until when it
/// goes on.
constexpr double picture_share = 0.75, choosing_share = 0.18;
/// A deeper grid than the renderer's deepest is not chosen.
constexpr int deepest = 64;
constexpr std::array thresholds{0.0, 0.03};
constexpr std::array coarse_steps{AaStep{2, 0.3}, AaStep{3, 0.3}, AaStep{3, 0.1}, AaStep{3, 0.03}};
constexpr double no_threshold = 3;
constexpr int most_halvings = 4, most_trials = 4;
/// Of the time: what counts as within it.
constexpr double most_late = 1.25;
/// Of what is left, that the picture aims at; that one look at what a grid takes may take; that is
/// near enough.
constexpr double aimed_share = 0.95, settling_share = 0.03, filled_share = 0.85;
/// Below this depth the next grid takes so much longer that the time between is worth using.
constexpr int filled_below = 9;

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
    if (!q_.target.keep_aa) {
      best_ = fitted(best_.place, left_s());
      settle();
    } else {
      best_.seen.seconds = q_.prober.whole_s(best_.place, 0);
    }
    best_.seen.seconds *= q_.prober.load();
    best_.reached = q_.elapsed_s() + best_.seen.seconds <= most_late * seconds;
    return best_;
  }

private:
  Seen const& see(Place const& place) const { return q_.prober.see(place); }

  /// The finest anti-aliasing that fits; the threshold of the place is kept where it is deep.
  Answer fitted(Place place, double seconds) const {
    double const threshold = place.aa.threshold;
    if (q_.target.keep_aa) return {place, see(place), true};
    place.aa = {0, 0};
    Answer best{place, see(place), true};
    if (best.seen.seconds > seconds) return best;
    place.aa = {q_.prober.deepest_probe, threshold};
    double const off_s = best.seen.seconds;
    double const a_sample_s =
        std::max(1e-9, see(place).seconds - off_s) / (place.aa.depth * place.aa.depth);
    int const depth =
        static_cast<int>(std::min<double>(deepest, std::sqrt((seconds - off_s) / a_sample_s)));
    if (depth >= 2) {
      Seen const seen = q_.prober.reckon(place, depth);
      place.aa.depth = depth;
      if (seen.delta_e < best.seen.delta_e) best = {place, seen, true};
      if (depth > q_.prober.deepest_probe) return best;
    }
    for (auto const& step : coarse_steps) {
      place.aa = step;
      Seen const& seen = see(place);
      if (seen.seconds > seconds) break;
      if (seen.delta_e < best.seen.delta_e) best = {place, seen, true};
    }
    // The threshold of deep grids stays known.
    return best;
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
      auto other = at;
      other.aa.threshold =
          at.aa.threshold == thresholds.front() ? thresholds.back() : thresholds.front();
      for (auto const& place : {q_.next_step(at), std::optional(other), q_.more_bands(at)}) {
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

  /// For the picture, as Seen::seconds counts.
  double left_s() const {
    return aimed_share * (q_.target.seconds - q_.elapsed_s()) / q_.prober.load();
  }
  double whole_s(Place const& place) const {
    return q_.prober.whole_s(place, settling_share * std::max(0.0, left_s()));
  }

  /// How deep a grid really fits: the patches may cost more or less than all of the picture does,
  /// and samples that are made together less than a few.
  void settle() {
    Place place = best_.place;
    place.aa.depth = std::max(2, place.aa.depth);
    double fits_s = 0;
    double const off_s = whole_s({place.way, place.step, place.bands, {}});
    int fits = 0, too_deep = deepest + 1;
    for (int i = 0; i < most_trials && !q_.stopped(); ++i) {
      double const left = left_s(), s = whole_s(place);
      if (s <= left && place.aa.depth > fits) {
        fits = place.aa.depth;
        fits_s = s;
      } else if (s > left) {
        too_deep = std::min(too_deep, place.aa.depth);
      }
      double const more = std::sqrt(std::max(0.0, left - off_s) / std::max(1e-9, s - off_s));
      place.aa.depth = std::clamp(static_cast<int>(place.aa.depth * more), fits, too_deep - 1);
      if (place.aa.depth < 2 || place.aa.depth == fits) break;
    }
    best_.place.aa.depth = fits;
    best_.seen.seconds = fits > 0 ? fits_s : off_s;
    if (fits < filled_below) fill(off_s);
  }

  /// Between two grids: the deeper one where pixels differ more.
  void fill(double off_s) {
    Place place = best_.place;
    place.aa.depth = std::max(2, place.aa.depth + 1);
    if (off_s > left_s()) return;
    double lo = std::log(std::max(1e-3, place.aa.threshold)), hi = std::log(no_threshold);
    for (int i = 0; i < most_halvings && !q_.stopped(); ++i) {
      double const middle = 0.5 * (lo + hi);
      place.aa.threshold = std::exp(middle);
      double const left = left_s(), s = whole_s(place);
      if (s <= left && s > best_.seen.seconds) {
        best_.place = place;
        best_.seen = q_.prober.reckon(place, place.aa.depth);
        best_.seen.seconds = s;
      }
      if (s <= left && s > filled_share * left) break;
      (s <= left ? hi : lo) = middle;
    }
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
