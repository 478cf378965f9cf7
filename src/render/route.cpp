// SPDX-License-Identifier: MIT
#include "render/route.hpp"

#include "render/tracer.hpp"

#include <algorithm>
#include <limits>

namespace abbe::render {
namespace {

/// What has less of the light may go elsewhere.
constexpr double least_share = 1.0 / 32;

} // namespace

void Route::start(double light) {
  visits_.clear();
  open_.clear();
  light_ = light;
}

void Route::begin(Tracer& tracer, int depth, PathRay const& ray, Beam const& beam) {
  close(tracer, depth);
  bool const to_lamp = (ray.mask & (camera_bit | reflection_bit)) == 0;
  if (to_lamp || beam.throughput[0] < light_ * least_share) return;
  open_.push_back(visits_.size());
  visits_.push_back({depth, false, beam.throughput[0] / light_, {}, ray.line.direction, {}});
  tracer.frames_[static_cast<std::size_t>(depth)].hit.clear();
}

void Route::close(Tracer const& tracer, int depth) {
  while (!open_.empty() && visits_[open_.back()].depth >= depth) {
    Visit& visit = visits_[open_.back()];
    open_.pop_back();
    auto const& hit = tracer.frames_[static_cast<std::size_t>(visit.depth)].hit;
    if (hit.members.empty()) continue;
    visit.met = true;
    visit.primitive = hit.members.front().primitive;
    visit.point = hit.point;
  }
}

double Route::apart_px(Route const& other, Footprint const& footprint, bool sky) const {
  constexpr double never = std::numeric_limits<double>::infinity();
  if (visits_.size() != other.visits_.size()) return never;
  double most_px = 0;
  for (std::size_t i = 0; i < visits_.size(); ++i) {
    Visit const &a = visits_[i], &b = other.visits_[i];
    if (a.depth != b.depth || a.met != b.met) return never;
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

} // namespace abbe::render
