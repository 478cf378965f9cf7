// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/world.hpp"

#include <algorithm>
#include <cstddef>
#include <deque>
#include <vector>

/// Rays of any number, origin and direction that are asked together (World::intersect). Values a
/// ray stand side by side, component by component.
namespace abbe::geometry {

/// A vector a ray: a view into three arrays.
struct VectorArrays {
  double *x = nullptr, *y = nullptr, *z = nullptr;
  Vec3 get(std::size_t k) const { return {x[k], y[k], z[k]}; }
  void set(std::size_t k, Vec3 const& v) const {
    x[k] = v.x;
    y[k] = v.y;
    z[k] = v.z;
  }
  VectorArrays from(std::size_t k) const { return {x + k, y + k, z + k}; }
};

/// Groups of crossings (HitGroup), spoken of by number. The room of a group is used again.
class Groups {
public:
  void clear() { count_ = 0; }
  std::uint32_t count() const { return count_; }
  /// An empty group.
  HitGroup& add() {
    if (count_ == groups_.size()) groups_.emplace_back();
    HitGroup& group = groups_[count_++];
    group.clear();
    return group;
  }
  HitGroup const& operator[](std::uint32_t number) const { return groups_[number]; }
  HitGroup& operator[](std::uint32_t number) { return groups_[number]; }

private:
  std::deque<HitGroup> groups_;
  std::uint32_t count_ = 0;
};

/// What a ray of a batch departs from: Departure in twelve bytes.
struct RayStart {
  enum class Kind : std::uint8_t {
    Nowhere, ///< in the open
    Surface, ///< the one member `number`
    Group    ///< the members of group `number`
  };
  std::uint32_t number = 0; ///< PrimitiveId, or of a group
  std::uint32_t face = 0;
  Kind kind = Kind::Nowhere;
  bool was_entering = false; ///< Departure::On
  bool through = true;       ///< Departure
  bool operator==(RayStart const&) const = default;
};

/// The rays. Directions are of unit length.
struct RayLines {
  std::size_t count = 0;
  VectorArrays origin, direction, origin_error; ///< as in Ray
  RayStart const* start = nullptr;              ///< a ray
  Groups const* groups = nullptr;               ///< that starts speak of

  Ray get(std::size_t k) const {
    return {origin.get(k), direction.get(k), origin_error.get(k), Vec3(0), Vec3(0)};
  }
};

/// What one ray meets first.
struct RayHit {
  enum class Kind : std::uint8_t {
    Nothing,
    Single, ///< one crossing, of one primitive, clear of all others
    Group   ///< several: Hits::group
  };
  Kind kind = Kind::Nothing;
  bool entering = false, toggles = true; ///< as in SurfaceCrossing
  bool was_entering = false;             ///< the primitive (the solid may be its inverse)
  SolidId solid = 0;
  PrimitiveId primitive = 0;
  std::uint32_t face = 0;
  bool operator==(RayHit const&) const = default;
};

/// Of crossings at one place, the one whose surface is shown: the first that is entered, else the
/// first. @pre there is one
inline SurfaceCrossing const& shown(std::vector<SurfaceCrossing> const& crossings) {
  auto const entered = std::find_if(crossings.begin(), crossings.end(),
                                    [](SurfaceCrossing const& c) { return c.entering; });
  return entered != crossings.end() ? *entered : crossings.front();
}

/// What the rays of a batch meet first. Of a Group, `hit` is the crossing that is shown().
struct Hits {
  std::vector<RayHit> hit;
  std::vector<std::uint32_t> group; ///< a ray; of Groups
  std::vector<double> t, error;     ///< as in HitGroup; without meaning where nothing is met
  VectorArrays point, point_error;
  Groups groups;

  /// For so many rays.
  void resize(std::size_t count);
  /// The last of the groups is what ray k meets, or nothing when it is empty.
  void take_group(std::size_t k);

private:
  std::vector<double> vectors_;
};

/// A batch's places sorted by what the rays depart from: runs of rays that depart alike.
class StartOrder {
public:
  void sort(RayStart const* starts, std::size_t count);
  std::vector<std::uint32_t> const& places() const { return places_; }
  /// Ends of the runs in places(), in order.
  std::vector<std::uint32_t> const& ends() const { return ends_; }

private:
  std::uint32_t run_of(RayStart const& start);
  std::vector<std::uint32_t> places_, ends_;
  std::vector<std::uint32_t> table_; ///< numbers of runs, by what is hashed of their starts
  struct Stretch {
    std::uint32_t end, run;
  };
  std::vector<Stretch> stretches_; ///< neighbours of one run
  std::vector<RayStart> runs_;
};

} // namespace abbe::geometry
