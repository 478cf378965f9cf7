// SPDX-License-Identifier: MIT
#include "study/search.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace abbe::study {
namespace {

/// Of the time: what the picture may be expected to take while choosing goes on, and until when it
/// goes on.
constexpr double picture_share = 0.75, choosing_share = 0.22;
/// A deeper grid than the renderer's deepest is not chosen.
constexpr int deepest = 64;
constexpr std::array thresholds{0.0, 0.03};
constexpr std::array coarse_steps{AaStep{2, 0.3}, AaStep{3, 0.3}, AaStep{3, 0.1}, AaStep{3, 0.03}};
constexpr double no_threshold = 3;
constexpr int most_halvings = 5;
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
      double const left = std::max(0.0, choosing_share * seconds - now);
      climb(q_.first_place(*ways[i]), now + left / static_cast<double>(ways.size() - i));
    }
    // What is left goes to the picture. The patches may cost more or less than all of it does.
    double const calibration = q_.prober.calibrate(best_.place);
    auto const left = [&] { return (seconds - q_.elapsed_s()) / (calibration * q_.prober.load()); };
    if (!q_.target.keep_aa) best_ = fitted(best_.place, left());
    if (!q_.target.keep_aa) fill(left());
    best_.seen.seconds *= calibration * q_.prober.load();
    best_.reached = best_.seen.seconds <= std::max(0.0, seconds - q_.elapsed_s());
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

  /// Between two grids: the deeper one where pixels differ more.
  void fill(double seconds) {
    auto const now = best_.place.aa.depth;
    if (now == 0 || now >= filled_below || best_.seen.seconds > 0.9 * seconds) return;
    Place place = best_.place;
    place.aa.depth = std::max(2, now + 1);
    double lo = std::log(std::max(1e-3, place.aa.threshold)), hi = std::log(no_threshold);
    for (int i = 0; i < most_halvings && !q_.stopped(); ++i) {
      double const middle = 0.5 * (lo + hi);
      place.aa.threshold = std::exp(middle);
      auto const seen = q_.prober.reckon(place, place.aa.depth);
      bool const fits = seen.seconds <= seconds;
      if (fits && seen.delta_e < best_.seen.delta_e) best_ = {place, seen, true};
      if (fits && seen.seconds > 0.9 * seconds) break;
      (fits ? hi : lo) = middle;
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
