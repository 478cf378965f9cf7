// SPDX-License-Identifier: MIT
#include "texture/patterns/slope.hpp"

#include "simd/math.hpp"

#include <algorithm>
#include <numbers>

namespace abbe::texture {
namespace {

constexpr double pi = std::numbers::pi;

/// A range of values that is stretched over 0 .. 1.
struct Range {
  double low = 0, high = 1;
  double of(double value) const { return high == low ? value : (value - low) / (high - low); }
};

class Slope final : public Pattern {
public:
  Vec3 towards{0, 1, 0};
  bool point_at = false;
  Range slopes, altitudes;
  Vec3 altitude{0};

  double raw(Vec3 const&, PatternModifiers const&) const override { return 0; }
  bool looks() const override { return true; }
  double raw_on(Vec3 const& p, PatternModifiers const&, Sight const* sight) const override {
    if (sight == nullptr) return 0;
    Vec3 way = point_at ? towards - p : towards;
    double const length = glm::length(way);
    double const cosine = length == 0 ? 0 : glm::dot(sight->normal, way) / length;
    double const slope = 0.5 + simd::asin(std::clamp(cosine, -1.0, 1.0)) / pi;
    double const height = glm::length(altitude);
    if (height == 0) return slopes.of(slope);
    double const first = point_at ? 1 : length;
    double const share = height / (first + height);
    double const along = glm::dot(p, altitude) / height;
    return (1 - share) * slopes.of(slope) + share * altitudes.of(along);
  }
};

class Incidence final : public Pattern {
public:
  double raw(Vec3 const&, PatternModifiers const&) const override { return 0; }
  bool looks() const override { return true; }
  double raw_on(Vec3 const&, PatternModifiers const&, Sight const* sight) const override {
    if (sight == nullptr) return 0;
    return simd::acos(std::clamp(glm::dot(sight->normal, sight->direction), -1.0, 1.0)) / pi;
  }
};

void read_range(Parameters& in, Range& range) {
  if (!in.has_value()) return;
  range.low = in.number("low end");
  range.high = in.number("high end");
}

} // namespace

std::shared_ptr<Pattern const> read_slope(Parameters& in) {
  auto pattern = std::make_shared<Slope>();
  if (!in.open("slope")) {
    pattern->towards = in.vec3("direction of the slope");
    return pattern;
  }
  pattern->point_at = in.accept("point_at");
  pattern->towards = in.vec3("direction of the slope");
  read_range(in, pattern->slopes);
  if (in.accept("altitude")) {
    pattern->altitude = in.vec3("direction of the altitude");
    read_range(in, pattern->altitudes);
  }
  in.close();
  return pattern;
}

std::shared_ptr<Pattern const> read_aoi(Parameters&) {
  return std::make_shared<Incidence>();
}

} // namespace abbe::texture
