// SPDX-License-Identifier: MIT
#include "render/route.hpp"

#include "render/tracer.hpp"

namespace abbe::render {

void Route::start(double least) {
  visits_.clear();
  open_.clear();
  least_ = least;
}

void Route::begin(Tracer& tracer, int depth, PathRay const& ray, Beam const& beam) {
  close(tracer, depth);
  bool const to_lamp = (ray.mask & (camera_bit | reflection_bit)) == 0;
  if (to_lamp || beam.throughput[0] < least_) return;
  open_.push_back(visits_.size());
  visits_.push_back({depth, false, {}, ray.line.direction, {}});
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

bool Route::agrees(Route const& other, Footprint const& footprint, double tolerance_px,
                   bool sky) const {
  if (visits_.size() != other.visits_.size()) return false;
  for (std::size_t i = 0; i < visits_.size(); ++i) {
    Visit const &a = visits_[i], &b = other.visits_[i];
    if (a.depth != b.depth || a.met != b.met) return false;
    if (!a.met) {
      double const angle_rad = glm::length(a.direction - b.direction);
      if (sky && !(angle_rad <= tolerance_px * (footprint.angle_rad + footprint.size)))
        return false;
      continue;
    }
    if (a.primitive != b.primitive) return false;
    if (!(glm::length(a.point - b.point) <= tolerance_px * footprint.at(a.point))) return false;
  }
  return true;
}

} // namespace abbe::render
