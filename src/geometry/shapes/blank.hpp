// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/shape.hpp"

namespace abbe::geometry {

/// Room without a surface: the blank of a text, which counts for its extent.
class Blank final : public Shape {
public:
  explicit Blank(Bounds const& bounds) : bounds_(bounds) {}
  void crossings(Ray const&, Start const*, Crossings&) const override {}
  bool inside(Vec3 const&) const override { return false; }
  Vec3 normal(Vec3 const&, std::uint32_t) const override { return {0, 1, 0}; }
  Bounds bounds() const override { return bounds_; }

private:
  Bounds bounds_;
};

} // namespace abbe::geometry
