// SPDX-License-Identifier: MIT
#include "transport/caustics/caustic_lights.hpp"
#include "transport/caustics/through.hpp"
#include "transport/way.hpp"

#include <algorithm>
#include <tuple>

namespace abbe::transport::caustics {
namespace {

/// Rays that pay for a tour, and those of which every fourth is enough.
constexpr std::size_t fewest = 8, many = 12;
/// How well the places of a tour are told by those that are known, beside the way from one of
/// these to the next.
constexpr double in_line = 0.02;

} // namespace

void CausticLights::find_tours() {
  Chunk const& chunk = *chunk_;
  tours_.clear();
  if (chunk.each != 1 || caustics_.bands().empty()) return;
  std::vector<std::uint8_t> order(chunk.count);
  for (std::size_t r = 0; r < chunk.count; ++r) order[r] = static_cast<std::uint8_t>(r);
  auto const key = [&](std::uint8_t r) { return std::tuple(chunk.sample[r], chunk.level[r]); };
  std::ranges::stable_sort(order, [&](std::uint8_t a, std::uint8_t b) {
    return std::tuple(key(a), chunk.channels[a]) < std::tuple(key(b), chunk.channels[b]);
  });
  for (std::size_t first = 0, last = 0; first < order.size(); first = last) {
    bool apart = true;
    for (last = first + 1; last < order.size() && key(order[last]) == key(order[first]); ++last)
      apart = apart && chunk.channels[order[last]] != chunk.channels[order[last - 1]];
    if (!apart || last - first < fewest) continue;
    Tour tour;
    tour.step = last - first < many ? coarse / 2 : coarse;
    tour.rays.assign(order.begin() + static_cast<std::ptrdiff_t>(first),
                     order.begin() + static_cast<std::ptrdiff_t>(last));
    tours_.push_back(std::move(tour));
  }
}

double CausticLights::absorbed(CausticLight const& light, std::uint16_t channel) const {
  Chain const& chain = caustics_.chains()[light.chain];
  double left = 1;
  for (std::size_t m = 0; m < chain.absorbing.size(); ++m)
    Way::along(stage_.medium(chain.absorbing[m]), {1, 1, &channel, &light.inside[m], &left, true});
  return left;
}

bool CausticLights::fill_in(Tour const& tour,
                            std::span<std::vector<std::uint32_t> const> lights_of) {
  Chunk const& chunk = *chunk_;
  surface::Channels const& colour = stage_.lamps[lamp_]->value();
  auto const place_of = [&](std::uint8_t r) {
    Caustics::Band const& band = caustics_.bands()[chunk.channels[r]];
    return caustics_.place_of(0.5 * (band.low_nm + band.high_nm));
  };
  std::vector<std::uint8_t> known;
  std::vector<double> at;
  for (std::size_t k = 0; k < tour.rays.size(); ++k) {
    if (!tour.known(k)) continue;
    std::uint8_t const r = tour.rays[k];
    if ((blocked_ >> r & 1) != 0) return false;
    known.push_back(r);
    at.push_back(place_of(r));
  }
  // Do the places lie evenly?
  for (std::size_t k = 0, next = 1; k < tour.rays.size(); ++k) {
    std::uint8_t const r = tour.rays[k];
    if (tour.known(k)) {
      if (k > 0) ++next;
      continue;
    }
    double const step =
        glm::distance(chunk.point.get(known[next - 1]), chunk.point.get(known[next]));
    Vec3 told;
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> places;
      for (std::uint8_t const i : known) places.push_back(chunk.point.get(i)[axis]);
      told[axis] = through(at, places, place_of(r));
    }
    if (!(glm::distance(told, chunk.point.get(r)) <= in_line * step)) return false;
  }
  std::size_t const tracks = lights_of[known.front()].size();
  for (std::uint8_t const r : known)
    if (lights_of[r].size() != tracks) return false;
  std::vector<CausticLight> made;
  std::vector<std::vector<std::uint32_t>> left;
  for (std::uint8_t const r : known) left.push_back(lights_of[r]);
  for (std::size_t t = 0; t < tracks; ++t) {
    // The same light from ray to ray: the nearest of its chain and side.
    std::vector<CausticLight const*> track;
    for (std::vector<std::uint32_t>& here : left) {
      auto nearest = here.end();
      if (track.empty()) {
        nearest = here.begin();
      } else {
        CausticLight const& last = *track.back();
        for (auto one = here.begin(); one != here.end(); ++one) {
          CausticLight const& light = lights_[*one];
          if (light.chain != last.chain || light.turned != last.turned) continue;
          if (nearest == here.end()
              || glm::distance(light.name, last.name)
                     < glm::distance(lights_[*nearest].name, last.name))
            nearest = one;
        }
      }
      if (nearest == here.end()) return false;
      track.push_back(&lights_[*nearest]);
      here.erase(nearest);
    }
    Chain const& chain = caustics_.chains()[track.front()->chain];
    if (chain.coloured && !chain.plain) return false;
    auto const values = [&](auto const& get) {
      std::vector<double> out;
      for (CausticLight const* const light : track) out.push_back(get(*light));
      return out;
    };
    // But for what changes from band to band by itself.
    std::vector<double> const light_of = values([&](CausticLight const& light) {
      std::uint16_t const channel = chunk.channels[light.ray];
      double const value = light.channel < 0 ? values_[light.values] : light.value;
      return value / (colour[channel] * absorbed(light, channel));
    });
    if (!is_even(at, light_of, told_to / 4)) return false;
    for (std::size_t k = 0; k < tour.rays.size(); ++k) {
      if (tour.known(k)) continue;
      double const here = place_of(tour.rays[k]);
      CausticLight light = *track.front();
      light.ray = tour.rays[k];
      std::uint16_t const channel = chunk.channels[light.ray];
      light.channel = channel;
      light.distance = through(at, values([](CausticLight const& l) { return l.distance; }), here);
      for (int axis = 0; axis < 3; ++axis)
        light.toward[axis] =
            through(at, values([&](CausticLight const& l) { return l.toward[axis]; }), here);
      light.toward = glm::normalize(light.toward);
      for (std::size_t m = 0; m < most_absorbing; ++m)
        light.inside[m] =
            through(at, values([&](CausticLight const& l) { return l.inside[m]; }), here);
      light.value =
          std::max(0.0, through(at, light_of, here)) * colour[channel] * absorbed(light, channel);
      made.push_back(light);
    }
  }
  lights_.insert(lights_.end(), made.begin(), made.end());
  return true;
}

} // namespace abbe::transport::caustics
