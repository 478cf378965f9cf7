// SPDX-License-Identifier: MIT
#include "render/path_record.hpp"

#include "render/interface.hpp"
#include "render/tracer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace abbe::render {
namespace {

bool negative(std::span<double const> channels) {
  return std::any_of(channels.begin(), channels.end(), [](double v) { return v < 0; });
}

bool in_order(double value, bool negative_is_wrong) {
  return std::isfinite(value) && !(negative_is_wrong && value < 0);
}

constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

} // namespace

bool negative_light_is_wrong(Stage const& stage) {
  return !negative(stage.background) && !negative(stage.sky_emission)
         && std::none_of(stage.lights.begin(), stage.lights.end(),
                         [](CompiledLight const& light) { return negative(light.value); })
         && !negative(stage.textures.colours)
         && std::none_of(stage.textures.finishes.begin(), stage.textures.finishes.end(),
                         [](CompiledFinish const& finish) {
                           return negative(finish.ambient) || negative(finish.emission);
                         });
}

std::optional<BadSample::Kind> what_is_wrong(std::span<double const> light, Vec3 const& rgb,
                                             bool negative_is_wrong) {
  bool nan = false, infinite = false, below = false;
  for (double const value : light) {
    nan = nan || std::isnan(value);
    infinite = infinite || std::isinf(value);
    below = below || value < 0;
  }
  // Infinite light has no colour: inf - inf.
  if (!nan && !infinite)
    for (int c = 0; c < 3; ++c) {
      nan = nan || std::isnan(rgb[c]);
      infinite = infinite || std::isinf(static_cast<float>(rgb[c]));
    }
  if (nan) return BadSample::Kind::NotANumber;
  if (infinite) return BadSample::Kind::Infinite;
  if (below && negative_is_wrong) return BadSample::Kind::Negative;
  return std::nullopt;
}

PathRecorder::PathRecorder(Stage const& stage, bool negative_is_wrong)
    : stage_(stage), negative_is_wrong_(negative_is_wrong) {}

void PathRecorder::take_hit(Tracer& tracer, Ray& ray) {
  auto const& hit = tracer.frames_[static_cast<std::size_t>(ray.depth)].hit;
  if (hit.members.empty()) return;
  ray.step.met = true;
  ray.step.point = hit.point + stage_.camera.location;
  // None is left where a medium of higher priority displaces all of them.
  auto const primitive = hit.crossings.empty() ? hit.members.front().primitive
                                               : hit.crossings[carrier_of(hit.crossings)].primitive;
  auto const origin = stage_.textures.surfaces.origin(primitive);
  ray.step.object = origin.span;
  ray.step.keyword = origin.keyword;
}

void PathRecorder::look_at_last(Tracer& tracer) {
  if (rays_.empty()) {
    film_.assign(tracer.film_.size(), 0.0);
    return;
  }
  take_hit(tracer, rays_.back());
  // `reflection { exponent }` gathers its light apart first.
  for (double const* light :
       {static_cast<double const*>(tracer.film_.data()), static_cast<double const*>(tracer.out_)})
    for (std::size_t i = 0; i < film_.size(); ++i) {
      if (!guilty_ && !in_order(light[i], negative_is_wrong_)) guilty_ = rays_.size() - 1;
      double const change = std::abs(light[i] - film_[i]);
      if (light == tracer.film_.data() && change > most_) {
        most_ = change;
        brightest_ = rays_.size() - 1;
      }
    }
  std::copy_n(tracer.film_.data(), film_.size(), film_.begin());
}

void PathRecorder::begin(Tracer& tracer, int depth, PathRay const& line, Beam const& beam) {
  if ((line.mask & (camera_bit | reflection_bit)) == 0) return; // on its way to a lamp
  look_at_last(tracer);
  Ray ray{depth, none, {}, line.line.direction};
  for (std::size_t i = rays_.size(); i-- > 0 && ray.parent == none;)
    if (rays_[i].depth == depth - 1) ray.parent = i;
  if (ray.parent != none)
    ray.step.kind = !line.from || !line.from->through              ? PathStep::Kind::Reflected
                    : rays_[ray.parent].direction == ray.direction ? PathStep::Kind::Passed
                                                                   : PathStep::Kind::Refracted;
  ray.step.lanes = beam.lanes;
  if (beam.monochromatic())
    ray.step.lambda_nm = tracer.waves_.lambda_nm(beam.wave, beam.wave_tooth);
  for (int k = 0; k < beam.lanes; ++k)
    ray.step.in_order = ray.step.in_order && in_order(beam.throughput[k], negative_is_wrong_);
  rays_.push_back(ray);
  // What the surface before it did to the light is wrong already.
  if (!guilty_ && !ray.step.in_order && ray.parent != none) guilty_ = ray.parent;
  tracer.frames_[static_cast<std::size_t>(depth)].hit.clear();
}

void PathRecorder::end(Tracer& tracer) {
  look_at_last(tracer);
}

std::vector<PathStep> PathRecorder::path() const {
  std::vector<PathStep> steps;
  if (rays_.empty()) return steps;
  for (std::size_t i = guilty_.value_or(brightest_); i != none; i = rays_[i].parent)
    steps.push_back(rays_[i].step);
  std::reverse(steps.begin(), steps.end());
  return steps;
}

} // namespace abbe::render
