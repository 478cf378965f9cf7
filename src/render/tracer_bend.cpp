// SPDX-License-Identifier: MIT
#include "render/tracer.hpp"
#include "simd/math.hpp"

#include <algorithm>
#include <cmath>

/// `reflection { exponent }`: the reflected light itself is raised to a power.
namespace abbe::render {

void Tracer::reflect_bent(PathRay const& next, Beam const& mirrored, double exponent) {
  bool const meets =
      mirrored.comb == no_comb && !mirrored.locked && !stage_.combs.empty() && film_.has_control(0);
  if (!meets) return bend(next, mirrored, exponent);
  // Light of combs that is met later would stand apart from the rest, and powers want the whole: it
  // is parted here, as by stochastic material.
  Arena::Scope const scope(arena_);
  bool const doubles = stage_.combs[0].follow == optics::Comb::Follow::Doubled;
  bend(next, doubles ? doubled(mirrored, 0) : combed(mirrored, 0, 1), exponent);
  Beam control = mirrored;
  control.comb = 0;
  control.control = true;
  control.slot = control_slots(control);
  bend(next, control, exponent);
}

void Tracer::bend(PathRay const& next, Beam const& mirrored, double exponent) {
  Arena::Scope const scope(arena_);
  auto const n = static_cast<std::size_t>(mirrored.lanes);
  // Apart from the film: light with the mirror's weight taken as one, and what is cut of it.
  auto* gathered = arena_.take<double>(out_size_);
  auto* lost = arena_.take<double>(out_size_);
  std::fill_n(gathered, out_size_, 0.0);
  std::fill_n(lost, out_size_, 0.0);
  double *const outer = out_, *const outer_lost = cut_slots_;
  out_ = gathered;
  cut_slots_ = lost;
  Beam unit = mirrored;
  unit.throughput = arena_.take<double>(n);
  std::fill_n(unit.throughput, n, 1.0);
  trace(next, unit);
  out_ = outer;
  cut_slots_ = outer_lost;

  Beam out = mirrored; // what it adds, and below what it may be off by, as throughput
  auto* slot = arena_.take<std::uint32_t>(n);
  auto* off = arena_.take<double>(n);
  out.slot = slot;
  out.throughput = off;
  for (std::size_t k = 0; k < n; ++k) {
    slot[k] = mirrored.slot[k];
    double light = gathered[slot[k]], missing = lost[slot[k]], weight = mirrored.throughput[k];
    off[k] = 0;
    // What comes of a pick stands for the light of all teeth at the weight of its own.
    if (auto const pick = pick_of(mirrored, static_cast<int>(k))) {
      slot[k] = pick->slot;
      light += gathered[slot[k]] / pick->weight;
      missing += lost[slot[k]] / pick->weight;
      weight *= pick->weight;
      if (!pick->counts) continue;
    }
    double const bent = simd::pow(std::max(0.0, light), exponent);
    out_[slot[k]] += weight * bent;
    if (missing == 0) continue;
    double const away = missing * stage_.brightest;
    double const most = std::max(simd::pow(std::max(0.0, light) + away, exponent) - bent,
                                 bent - simd::pow(std::max(0.0, light - away), exponent));
    off[k] = std::isfinite(stage_.brightest) ? weight * most / stage_.brightest : weight;
  }
  cut_light_of(out, out.lanes);
}

std::optional<Tracer::Picked> Tracer::pick_of(Beam const& beam, int lane) {
  if (beam.comb == no_comb || !stage_.combs[static_cast<std::size_t>(beam.comb)].picks_one()
      || stage_.spectral->is_line(beam.channel[lane]))
    return std::nullopt;
  std::uint32_t const slot = beam.slot[lane];
  std::size_t const sample = film_.sample_of(slot);
  int const comb = beam.comb;
  if (beam.control) {
    int const channel = beam.channel[lane];
    if (slot != film_.control_slot(sample, comb, channel)) return std::nullopt;
    return Picked{film_.picked_control_slot(sample, comb, channel), 1, true};
  }
  int const tooth = beam.tooth[lane] - waves_.first_tooth(comb, sample);
  if (slot != film_.tooth_slot(sample, comb, tooth)) return std::nullopt;
  auto const pick = waves_.pick(comb, sample);
  return Picked{film_.picked_slot(sample, comb, tooth), pick.weight, tooth == pick.tooth};
}

} // namespace abbe::render
