// SPDX-License-Identifier: MIT
#include "render/tracer.hpp"

#include "optics/refract.hpp"
#include "render/absorption.hpp"
#include "render/shader.hpp"
#include "surface/pigment.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace abbe::render {

namespace {

/// Where a line has left a box for good; infinite for one without bounds.
double exit_of(geometry::Bounds const& box, geometry::Ray const& line) {
  double exit = std::numeric_limits<double>::infinity();
  if (box.infinite) return exit;
  for (int i = 0; i < 3; ++i) {
    double const d = line.direction[i];
    if (d != 0) exit = std::min(exit, ((d > 0 ? box.high[i] : box.low[i]) - line.origin[i]) / d);
  }
  return exit;
}

} // namespace

void RayCounts::add(RayCounts const& other) {
  camera += other.camera;
  reflected += other.reflected;
  refracted += other.refracted;
  monochromatic += other.monochromatic;
  shadow += other.shadow;
  splits += other.splits;
}

void RayCounts::subtract(RayCounts const& other) {
  camera -= other.camera;
  reflected -= other.reflected;
  refracted -= other.refracted;
  monochromatic -= other.monochromatic;
  shadow -= other.shadow;
  splits -= other.splits;
}

namespace {

/// How many samples can go together, or 1.
std::size_t samples_together(Stage const& stage) {
  bool const perspective = stage.camera.kind == scene::Camera::Kind::Perspective;
  if (stage.has_priorities || stage.has_leaks || (!perspective && stage.media.size() > 1)) return 1;
  // Beams number the teeth of all.
  constexpr std::size_t most_teeth =
      std::numeric_limits<std::uint16_t>::max() / geometry::fan_width;
  auto const extra = static_cast<std::size_t>(stage.channels);
  bool const few = std::all_of(stage.combs.begin(), stage.combs.end(), [&](auto const& comb) {
    return static_cast<std::size_t>(std::max(0, comb.teeth)) + extra <= most_teeth;
  });
  return few ? geometry::fan_width : 1;
}

} // namespace

Tracer::Tracer(Stage const& stage, Footprint footprint)
    : stage_(stage),
      footprint_(footprint),
      scratch_(geometry::World::make_scratch()),
      waves_(stage, samples_together(stage)),
      film_(stage, waves_, samples_together(stage)) {
  std::size_t const most = samples_together(stage);
  together_ = most > 1;
  for (std::size_t sample = 0; sample < most; ++sample)
    for (int channel = 0; channel < stage.channels; ++channel) {
      all_channels_.push_back(static_cast<std::uint16_t>(channel));
      all_slots_.push_back(film_.channel_slot(sample, channel));
    }
  if (stage.camera.kind == scene::Camera::Kind::Perspective) camera_inside_ = inside_at(Vec3(0));
}

Beam Tracer::start_samples(std::span<SampleKey const> keys) {
  film_.start_samples(keys.size());
  waves_.start_samples(keys);
  out_ = film_.data();
  out_size_ = film_.size();
  Beam beam;
  beam.lanes = stage_.channels * static_cast<int>(keys.size());
  beam.channel = beam.tooth = all_channels_.data();
  beam.slot = all_slots_.data();
  beam.throughput = arena_.take<double>(static_cast<std::size_t>(beam.lanes));
  std::fill_n(beam.throughput, beam.lanes, 1.0);
  counts_.camera += keys.size();
  std::fill_n(cut_here_, keys.size(), Vec3(0));
  return beam;
}

Vec3 Tracer::sample(geometry::Ray const& ray, SampleKey key, std::span<double> bands) {
  Arena::Scope const scope(arena_);
  Beam const beam = start_samples({&key, 1});
  PathRay path{ray, nullptr, camera_inside_, 0, camera_bit};
  if (stage_.camera.kind != scene::Camera::Kind::Perspective && stage_.media.size() > 1)
    path.inside = inside_at(ray.origin);
  trace(path, beam);
  count_cut(lost_of(0));
  return light_of(0, bands);
}

void Tracer::samples(geometry::FanLines const& rays, std::span<SampleKey const> keys) {
  Arena::Scope const scope(arena_);
  Beam const beam = start_samples(keys);
  trace_fan({&rays, nullptr, camera_inside_, 0, camera_bit, stage_.channels}, beam);
  for (std::size_t k = 0; k < keys.size(); ++k) count_cut(lost_of(k));
}

void Tracer::count_cut(double lost) {
  cut_.worst_sample = std::max(cut_.worst_sample, lost);
  cut_.sum += CutLight::units_of(lost);
}

void Tracer::cut(Beam const& beam, int lanes) {
  if (cut_light_of(beam, lanes)) ++cut_.paths;
}

bool Tracer::cut_light_of(Beam const& beam, int lanes) {
  if (cut_slots_ != nullptr) {
    for (int k = 0; k < lanes; ++k) cut_slots_[beam.slot[k]] += std::abs(beam.throughput[k]);
    return any_but_zero(beam.throughput, lanes);
  }
  Vec3 sum(0);
  if (stage_.combs.empty()) { // slots are channels
    for (int k = 0; k < lanes; ++k)
      if (beam.throughput[k] != 0)
        sum += beam.throughput[k] * glm::abs(stage_.rgb_weights[beam.channel[k]]);
  } else {
    sum = film_.size_of(beam.slot, beam.throughput, lanes, waves_);
  }
  if (sum == Vec3(0)) return false;
  cut_here_[sample_of(beam)] += sum;
  return true;
}

void Tracer::prepare_frame(int depth, PathRay const& ray, Beam const& beam) {
  while (frames_.size() <= static_cast<std::size_t>(depth)) frames_.emplace_back();
  if (recorder_) recorder_->begin(*this, depth, ray, beam);
  if (route_) route_->begin(*this, depth, ray, beam);
  if (!recorder_ && !route_) ready_frames_ = depth + 1;
}

InsideNode const* Tracer::inside_at(Vec3 const& point) {
  std::vector<geometry::SolidId> solids;
  stage_.world->containing(point, *scratch_, solids);
  InsideNode const* inside = nullptr;
  for (auto const solid : solids)
    if (stage_.solids[solid].has_medium && !stage_.solids[solid].sheet) {
      // The camera's own list outlives every sample, so it has an arena of its own.
      Arena& arena =
          stage_.camera.kind == scene::Camera::Kind::Perspective ? camera_arena_ : arena_;
      auto* node = arena.take<InsideNode>(1);
      *node = {solid, inside};
      inside = node;
    }
  return inside;
}

int Tracer::medium_of(InsideNode const* inside) const {
  InsideNode const* const node = ruling(inside);
  return node ? stage_.solids[node->solid].medium : 0;
}

InsideNode const* Tracer::ruling(InsideNode const* inside) const {
  if (!stage_.has_priorities || !inside) return inside;
  InsideNode const* best = inside;
  for (InsideNode const* node = inside->below; node; node = node->below)
    if (stage_.solids[node->solid].priority > stage_.solids[best->solid].priority) best = node;
  return best;
}

void Tracer::drop_displaced(InsideNode const* before, InsideNode const* after,
                            geometry::HitGroup& hit) const {
  InsideNode const *const here = ruling(before), *const there = ruling(after);
  if (!here || !there) return;
  int const least =
      std::min(stage_.solids[here->solid].priority, stage_.solids[there->solid].priority);
  std::erase_if(hit.crossings, [&](geometry::SurfaceCrossing const& crossing) {
    CompiledSolid const& solid = stage_.solids[crossing.solid];
    return crossing.toggles && solid.has_medium && solid.priority < least;
  });
}

InsideNode const* Tracer::without(InsideNode const* inside, geometry::SolidId solid) {
  InsideNode const* found = inside;
  while (found && found->solid != solid) found = found->below;
  if (!found) return inside;
  // What was entered after it is put back in order.
  InsideNode const* rebuilt = found->below;
  int above = 0;
  for (InsideNode const* n = inside; n != found; n = n->below) ++above;
  for (; above > 0; --above) {
    InsideNode const* n = inside;
    for (int i = 1; i < above; ++i) n = n->below;
    auto* const node = arena_.take<InsideNode>(1);
    *node = {n->solid, rebuilt};
    rebuilt = node;
  }
  return rebuilt;
}

InsideNode const* Tracer::entered(InsideNode const* inside, geometry::SolidId solid) {
  auto* const node = arena_.take<InsideNode>(1);
  *node = {solid, inside};
  return node;
}

InsideNode const* Tracer::after_crossings(InsideNode const* inside, geometry::HitGroup const& hit) {
  bool any_open = false;
  for (auto const& crossing : hit.crossings) {
    CompiledSolid const& solid = stage_.solids[crossing.solid];
    if (!solid.has_medium) continue;
    any_open = any_open || solid.open;
    if (!solid.open && !crossing.entering && crossing.toggles)
      inside = without(inside, crossing.solid);
  }
  for (auto const& crossing : hit.crossings) {
    CompiledSolid const& solid = stage_.solids[crossing.solid];
    if (solid.has_medium && !solid.open && crossing.entering && crossing.toggles)
      inside = entered(inside, crossing.solid);
  }
  return any_open ? after_open_crossings(inside, hit) : inside;
}

InsideNode const* Tracer::after_open_crossings(InsideNode const* inside,
                                               geometry::HitGroup const& hit) {
  auto const medium_of_crossing = [&](geometry::SurfaceCrossing const& crossing) {
    CompiledSolid const& solid = stage_.solids[crossing.solid];
    return solid.has_medium && solid.open ? solid.medium : -1;
  };
  for (auto crossing = hit.crossings.begin(); crossing != hit.crossings.end(); ++crossing) {
    int const medium = medium_of_crossing(*crossing);
    // Surfaces that share an interior and meet in the hit are one.
    bool const again = std::any_of(hit.crossings.begin(), crossing, [&](auto const& earlier) {
      return medium_of_crossing(earlier) == medium;
    });
    if (medium < 0 || again) continue;
    InsideNode const* node = inside;
    while (node && stage_.solids[node->solid].medium != medium) node = node->below;
    inside = node ? without(inside, node->solid) : entered(inside, crossing->solid);
  }
  return inside;
}

double Tracer::index_of(int medium, Beam const& beam) {
  Medium const& m = stage_.media[static_cast<std::size_t>(medium)];
  if (!m.dispersive || !beam.monochromatic()) return m.index_d;
  return waves_.index(medium, beam.wave, beam.wave_tooth);
}

void Tracer::add_background(Vec3 const& direction, Beam const& beam) {
  if (stage_.sky_pigments.empty()) {
    if (stage_.background.empty()) return;
    for (int k = 0; k < beam.lanes; ++k)
      out_[beam.slot[k]] += beam.throughput[k] * stage_.background[beam.channel[k]];
    return;
  }
  Arena::Scope const scope(arena_);
  Vec3 const point = stage_.to_sky_linear * direction + stage_.to_sky_offset;
  auto* left = arena_.take<double>(static_cast<std::size_t>(beam.lanes));
  std::fill_n(left, beam.lanes, 1.0);
  // Below version 3.7, a layer's colour filters the background, but not the layers under it.
  bool const plain_layers = stage_.textures.opacity_version < 3.7;
  double filter = 1, transmit = 1, through = 1; // all layers above
  for (auto number = stage_.sky_pigments.rbegin(); number != stage_.sky_pigments.rend(); ++number) {
    Arena::Scope const of_pigment(arena_);
    surface::PigmentValue pigment{arena_.take<double>(static_cast<std::size_t>(beam.lanes))};
    surface::evaluate_pigment<0>(stage_.textures, *number, point, beam.channel, beam.lanes, pigment,
                                 arena_);
    double const opaque = 1 - pigment.filter - pigment.transmit;
    for (int k = 0; k < beam.lanes; ++k) {
      double const share = opaque * (plain_layers ? through : left[k]);
      out_[beam.slot[k]] +=
          beam.throughput[k] * share * pigment.colour[k] * stage_.sky_emission[beam.channel[k]];
      left[k] *=
          plain_layers ? pigment.colour[k] : pigment.filter * pigment.colour[k] + pigment.transmit;
    }
    filter *= pigment.filter;
    transmit *= pigment.transmit;
    through = filter + transmit;
  }
  for (int k = 0; plain_layers && k < beam.lanes; ++k) left[k] = filter * left[k] + transmit;
  if (stage_.background.empty()) return;
  for (int k = 0; k < beam.lanes; ++k)
    out_[beam.slot[k]] += beam.throughput[k] * left[k] * stage_.background[beam.channel[k]];
}

void Tracer::absorb(Beam& beam, Medium const& medium, double distance) {
  if (medium.absorption.empty()) return;
  for (int k = 0; k < beam.lanes; ++k) {
    double const alpha = medium.absorption[beam.channel[k]];
    if (alpha != 0) beam.throughput[k] *= transmittance(alpha * distance);
  }
}

void Tracer::absorb_fan(Beam& beam, Medium const& medium, double const* distances, int each) {
  if (medium.absorption.empty()) return;
  Arena::Scope const scope(arena_);
  auto const n = static_cast<std::size_t>(beam.lanes);
  auto* depths = arena_.take<double>((n + 3) / 4 * 4);
  for (int k = 0, ray = 0; k < beam.lanes; ++ray)
    for (int c = 0; c < each; ++c, ++k) {
      double const alpha = medium.absorption[beam.channel[k]];
      depths[k] = alpha != 0 ? alpha * distances[ray] : 0;
    }
  absorb_lanes(depths, n, beam.throughput);
}

InsideNode const* Tracer::travel(PathRay const& ray, double distance, Beam& beam) {
  bool const escapes = !(distance < std::numeric_limits<double>::infinity());
  InsideNode const* inside = ray.inside;
  double at = 0;
  for (;;) {
    InsideNode const* left = nullptr;
    double end = distance;
    for (InsideNode const* node = inside; node && (escapes || stage_.has_leaks);
         node = node->below) {
      if (!escapes && !stage_.solids[node->solid].leaks) continue;
      double const exit = exit_of(stage_.world->bounds(node->solid), ray.line);
      if (!(exit < end)) continue;
      end = exit;
      left = node;
    }
    Medium const& medium = stage_.media[static_cast<std::size_t>(medium_of(inside))];
    double const part = std::max(end - at, 0.0);
    absorb(beam, medium, part);
    if (!left) return inside;
    InsideNode const* const rest = without(inside, left->solid);
    if (medium.fade_distance != 0 && medium_of(rest) != medium_of(inside))
      for (int k = 0; k < beam.lanes; ++k)
        beam.throughput[k] *= distance_fade(medium, beam.channel[k], ray.travelled + part);
    at = std::max(at, end);
    inside = rest;
  }
}

void Tracer::trace(PathRay const& ray, Beam const& incoming) {
  if (ray.level >= stage_.max_trace_level) return cut(incoming, incoming.lanes);
  ++depth_;
  Frame& here = frame(depth_, ray, incoming);
  double constexpr infinity = std::numeric_limits<double>::infinity();
  bool const found =
      stage_.world->closest(ray.line, ray.from, ray.mask, infinity, *scratch_, here.hit);
  if (!found && !ray.inside) {
    add_background(ray.line.direction, incoming);
    --depth_;
    return;
  }
  arrive(ray, incoming, here, found);
  --depth_;
}

void Tracer::arrive(PathRay const& ray, Beam const& incoming, Frame& here, bool found) {
  double constexpr infinity = std::numeric_limits<double>::infinity();
  Arena::Scope const scope(arena_);
  Beam beam = incoming;
  beam.throughput = arena_.take<double>(static_cast<std::size_t>(beam.lanes));
  std::copy_n(incoming.throughput, beam.lanes, beam.throughput);
  PathRay arriving = ray;
  arriving.inside = travel(ray, found ? here.hit.t : infinity, beam);
  if (found)
    interact(arriving, beam, here);
  else
    add_background(ray.line.direction, beam); // infinitely far: nothing comes through what absorbs
}

} // namespace abbe::render
