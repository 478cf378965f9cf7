// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/placed.hpp"

#include <atomic>
#include <memory>
#include <vector>

namespace abbe::geometry {

/// What is stored once and stands in many places: shapes, and other definitions, to any depth. None
/// of them is infinite.
class Definition final : public Shape {
public:
  struct Leaf {
    ShapePtr shape;
    Placement placement; ///< to the definition's space
    int texture = 0;     ///< number of its texture: Instances::face_texture
  };
  struct Part {
    std::shared_ptr<Definition const> definition;
    Placement placement; ///< to the space of the definition that it is a part of
  };
  Definition(std::vector<Leaf> leaves, std::vector<Part> parts);

  std::vector<Leaf> const& leaves() const { return leaves_; }
  std::vector<Part> const& parts() const { return parts_; }
  Bounds bounds() const override { return bounds_; }
  bool smoothed() const override { return smoothed_; } ///< of some shape in it

  /// Items: leaves, then parts.
  using Item = std::uint32_t;
  /// Boxes of boxes, of two each, down to single items.
  struct Node {
    Bounds box;
    std::uint32_t item = 0;  ///< of a node without others below it
    std::uint32_t other = 0; ///< the second node below it; the first is the next; 0: none
  };
  /// The whole first; none when there are no items.
  std::vector<Node> const& nodes() const { return nodes_; }

  // It is met through Instances alone.
  void crossings(Ray const&, Start const*, Crossings&) const override {}
  bool inside(Vec3 const&) const override { return false; }
  Vec3 normal(Vec3 const&, std::uint32_t) const override { return {0, 1, 0}; }
  bool solid() const override { return false; }

private:
  void build(std::vector<Item>& items, std::vector<Bounds> const& boxes, std::size_t first,
             std::size_t end);

  std::vector<Leaf> leaves_;
  std::vector<Part> parts_;
  std::vector<Node> nodes_;
  Bounds bounds_;
  bool smoothed_ = false;
};

/// A definition where it stands, with all that is in it: one surface for rays, of which only the
/// outermost pieces are asked for (all of it is opaque).
///
/// A leaf is met where a shape of its own would stand: its placements are put together on the way
/// down to it, in the order in which copies would have them, with the bounds of their errors. So
/// what a ray meets has the bits of a copy. Boxes only say who is asked; they are compared in the
/// definition's space, wider by more than the rays' errors there.
///
/// `face` numbers what was met: leaves and their faces get numbers as rays meet them, in whichever
/// order; equal numbers are the same face, and nothing else hangs on them. That takes about 200
/// bytes for each leaf that some ray meets.
class Instances final : public Shape {
public:
  /// @param placement the definition's space -> the world @param outer the world -> the space of
  /// this shape
  Instances(std::shared_ptr<Definition const> definition, Transform const& placement,
            Transform const& outer);
  ~Instances() override;

  void crossings(Ray const& ray, Start const* start, Crossings& out) const override;
  void crossings_ahead(Ray const& ray, Start const* start, double until,
                       Crossings& out) const override;
  bool inside(Vec3 const& point) const override;
  Vec3 normal(Vec3 const& point, std::uint32_t face) const override;
  Vec3 geometric_normal(Vec3 const& point, std::uint32_t face) const override;
  bool smoothed() const override { return definition_->smoothed(); }
  std::optional<Vec2> uv(Vec3 const& point, std::uint32_t face) const override;
  int face_texture(std::uint32_t face) const override;
  Bounds bounds() const override { return bounds_; }
  Boundary boundary() const override { return Boundary::Open; }

private:
  class Numbers;
  Numbers& numbers() const;
  struct Walk;
  void collect(Walk& walk, Crossings& out) const;
  void go(Walk& walk, std::shared_ptr<Definition const> const& definition,
          Transform const& at) const;
  void meet(Walk& walk, Definition::Leaf const& leaf, Transform const& at) const;

  std::shared_ptr<Definition const> definition_;
  Placement placement_, outer_;
  Bounds bounds_;
  mutable std::atomic<Numbers*> numbers_{nullptr}; ///< null until something is met
};

} // namespace abbe::geometry
