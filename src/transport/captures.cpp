// SPDX-License-Identifier: MIT
#include "transport/captures.hpp"

#include "simd/math.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::transport {

std::uint32_t Captures::add(LightKind const& kind, std::uint32_t slot,
                            std::uint16_t const* channels, double const* weights, double exponent,
                            std::uint32_t path) {
  auto const block = film_.block_of(slot);
  std::uint32_t const inner = slot - film_.first(block) + film_.first(film_.add_block(block));
  captures_.push_back({kind,
                       slot,
                       inner,
                       exponent,
                       {weights, weights + kind.size()},
                       {channels, channels + kind.size()},
                       path});
  return inner;
}

Captures::Picked Captures::pick_of(Capture const& capture, std::size_t lane) {
  LightKind const& kind = capture.kind;
  if (kind.comb == no_comb || !stage_.comb(kind.comb).picks_one()) return {};
  auto const block = film_.block_of(capture.slot);
  std::uint32_t const slot = capture.slot + static_cast<std::uint32_t>(lane);
  int const channel = capture.channels[lane];
  std::uint32_t const first = film_.first(block);
  if (kind.control) {
    if (slot != film_.control_slot(block, kind.comb, channel)) return {};
    return {film_.picked_control_slot(block, kind.comb, channel) - first, 1, true, true};
  }
  auto const tooth =
      static_cast<int>(slot) - static_cast<int>(film_.tooth_slot(block, kind.comb, 0));
  if (stage_.spectral->is_line(channel) || tooth < 0 || tooth >= waves_.drawn_teeth(kind.comb))
    return {};
  auto const pick = waves_.pick(kind.comb, film_.sample_of_block(block));
  return {film_.picked_slot(block, kind.comb, tooth) - first, pick.weight, tooth == pick.tooth,
          true};
}

void Captures::resolve(Capture const& capture) {
  auto const outer = film_.first(film_.block_of(capture.slot));
  auto const inner = film_.first(film_.block_of(capture.inner));
  double const exponent = capture.exponent;
  for (std::size_t k = 0; k < capture.kind.size(); ++k) {
    auto const lane = static_cast<std::uint32_t>(k);
    double light = film_[capture.inner + lane], missing = emitter_.lost_at(capture.inner + lane);
    double weight = capture.weights[k];
    std::uint32_t slot = capture.slot + lane;
    // What comes of a pick stands for the light of all teeth at the weight of its own.
    if (Picked const pick = pick_of(capture, k); pick.any) {
      slot = outer + pick.from;
      light += film_[inner + pick.from] / pick.weight;
      missing += emitter_.lost_at(inner + pick.from) / pick.weight;
      weight *= pick.weight;
      if (!pick.counts) continue;
    }
    double const bent = simd::pow(std::max(0.0, light), exponent);
    film_[slot] += weight * bent;
    if (paths_.records())
      paths_.add(capture.path, weight * bent, film_.is_sample(film_.block_of(slot)));
    if (missing == 0) continue;
    double const away = missing * stage_.brightest;
    double const most = std::max(simd::pow(std::max(0.0, light) + away, exponent) - bent,
                                 bent - simd::pow(std::max(0.0, light - away), exponent));
    double const off = std::isfinite(stage_.brightest) ? weight * most / stage_.brightest : weight;
    emitter_.lose(slot, &off, 1);
  }
}

void Captures::resolve() {
  for (auto capture = captures_.rbegin(); capture != captures_.rend(); ++capture) resolve(*capture);
}

} // namespace abbe::transport
