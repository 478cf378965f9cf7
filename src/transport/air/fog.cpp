// SPDX-License-Identifier: MIT
#include "transport/air/fog.hpp"

#include "simd/math.hpp"

#include <algorithm>

namespace abbe::transport {
namespace {

/// A way without end, as in POV-Ray.
constexpr double far = 2e10;

/// The mean of 1 above the ground and of the falling density between two heights; the lower one
/// comes first. Heights are counted from the offset, in units of `alt`.
double mean_density(double low, double high) {
  double const rise = high - low;
  auto const at = [](double x) { return x <= 0 ? 1 : 1 / (1 + x * x); };
  if (high <= 0) return 1;
  if (rise <= 0) return at(low);
  // The difference of two arcs, without the loss of digits.
  if (low >= 0) return simd::atan(rise / (1 + low * high)) / rise;
  return (simd::atan(high) - low) / rise;
}

} // namespace

double FogLayer::depth(Vec3 const& origin, Vec3 const& direction, double length) const {
  double way = length;
  if (ground) {
    double const from = (glm::dot(origin, up) - offset) / alt;
    double const rise = glm::dot(direction, up) * length / alt;
    way *= rise > 0 ? mean_density(from, from + rise) : mean_density(from + rise, from);
  }
  if (!turbulence) return way;
  Vec3 const middle = (origin + direction * (length / 2)) * turbulence->amount;
  texture::Turbulence const eddies{Vec3(0), turbulence->octaves, turbulence->omega,
                                   turbulence->lambda};
  double const thinner =
      std::min(1.0, texture::turbulence(middle, eddies, noise_generator) * turbulence_depth);
  return way * (1 - simd::exp(-length / distance) * thinner);
}

double FogLayer::passed(Vec3 const& origin, Vec3 const& direction, double length) const {
  double const way = depth(origin, direction, std::min(length, far));
  return std::max(simd::exp(-way / distance), colour.transmit);
}

double Fog::brightest() const {
  double sum = 0;
  for (FogLayer const& layer : layers_) sum += layer.colour.brightest();
  return sum;
}

void Fog::act(AirWay const& way, double* added) const {
  each_of(way.rays, [&](std::size_t r) {
    Vec3 const origin = way.origin->get(r) + eye_, direction = way.direction->get(r);
    std::size_t const first = r * way.each, end = first + way.each;
    for (FogLayer const& layer : layers_) {
      double const passed = layer.passed(origin, direction, way.distance[r]);
      AirColour const& colour = layer.colour;
      for (std::size_t k = first; k < end; ++k) {
        std::uint16_t const c = way.channel[k];
        if (added != nullptr) added[k] += (1 - passed) * colour.light[c];
        way.left[k] *= passed;
        if (colour.filter != 0) way.left[k] *= 1 - colour.filter + colour.filter * colour.tint[c];
      }
    }
  });
}

} // namespace abbe::transport
