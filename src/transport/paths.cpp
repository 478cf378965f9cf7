// SPDX-License-Identifier: MIT
#include "transport/paths.hpp"

#include <algorithm>
#include <limits>

namespace abbe::transport {
namespace {

/// What has less of the light may go elsewhere.
constexpr double least_share = 1.0 / 32;

/// Of what comes of a ray: the place in the tree, which grows too deep for its turns to be kept.
std::uint64_t code_of(std::uint64_t parent, bool through) {
  std::uint64_t code = (parent + (through ? 0x9e3779b97f4a7c15U : 0xd1b54a32d192ed03U));
  code = (code ^ code >> 30) * 0xbf58476d1ce4e5b9U;
  code = (code ^ code >> 27) * 0x94d049bb133111ebU;
  return code ^ code >> 31;
}

} // namespace

double Route::apart_px(Route const& other, Footprint const& footprint, bool sky) const {
  constexpr double never = std::numeric_limits<double>::infinity();
  if (visits.size() != other.visits.size()) return never;
  double most_px = 0;
  for (std::size_t i = 0; i < visits.size(); ++i) {
    Visit const &a = visits[i], &b = other.visits[i];
    if (a.code != b.code || a.met != b.met) return never;
    double const share = std::min(1.0, std::max(a.share, b.share));
    if (a.met) {
      if (a.primitive != b.primitive) return never;
      most_px = std::max(most_px, share * (glm::length(a.point - b.point) / footprint.at(a.point)));
    } else if (sky) {
      double const angle_rad = glm::length(a.direction - b.direction);
      most_px = std::max(most_px, share * (angle_rad / (footprint.angle_rad + footprint.size)));
    }
  }
  return most_px;
}

Paths::Started Paths::start_route(Id from, double light) {
  routes_.push_back({light, {}});
  auto const route = static_cast<std::uint32_t>(routes_.size() - 1);
  paths_.push_back({route, 0, from != none ? paths_[from].record : PathRecord::none});
  return {static_cast<Id>(paths_.size() - 1), route};
}

Route const& Paths::finished(std::uint32_t number) {
  Route& route = routes_[number];
  std::sort(route.visits.begin(), route.visits.end(),
            [](auto const& a, auto const& b) { return a.code < b.code; });
  return route;
}

Paths::Id Paths::arrive(Id from, bool through, LightKind const& kind, double const* light,
                        double lambda_nm, Arrival const& arrival) {
  if (from == none && record_ == nullptr) return none;
  Path path = from != none ? paths_[from] : Path{};
  if (path.route != none) {
    Route& route = routes_[path.route];
    path.code = code_of(path.code, through);
    if (!(light[0] < route.light * least_share))
      route.visits.push_back({path.code, arrival.met, light[0] / route.light, arrival.member,
                              arrival.direction, arrival.point});
  }
  if (record_ != nullptr) {
    PathStep step;
    step.lanes = kind.lanes;
    if (kind.monochromatic()) step.lambda_nm = lambda_nm;
    step.met = arrival.met;
    if (arrival.met) {
      auto const origin = stage_.textures.surfaces.origin(arrival.primitive);
      step.object = origin.span;
      step.keyword = origin.keyword;
      step.point = arrival.point + stage_.camera->location();
    }
    path.record = record_->arrive(path.record, through, arrival.direction, {light, kind.size()},
                                  std::move(step));
  }
  paths_.push_back(path);
  return static_cast<Id>(paths_.size() - 1);
}

} // namespace abbe::transport
