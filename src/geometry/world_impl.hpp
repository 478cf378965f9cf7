// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/bvh_walk.hpp"
#include "geometry/contact.hpp"
#include "geometry/traced_solid.hpp"

#include <atomic>

/// What a World keeps; for this folder alone.
namespace abbe::geometry {

struct FanLines;

/// Where a line meets a surface, and how far from it that point may be.
inline void set_point(Vec3 const& origin, Vec3 const& direction, double t, double error,
                      Vec3& point, Vec3& point_error) {
  Vec3 const step = t * direction;
  point = origin + step;
  point_error = glm::abs(direction) * error + gamma_bound(2) * (glm::abs(step) + glm::abs(point));
}

struct World::Impl {
  std::uint64_t number = next_number();
  std::vector<Placed> primitives;
  std::vector<TracedSolid> solids;
  std::vector<std::uint32_t> state_of; ///< solid -> place in Scratch::states
  std::uint32_t states = 0;
  /// The solids with a bit of a mask, by place.
  struct Group {
    std::uint8_t mask = 0xff;
    std::vector<SolidId> infinite;
    Bvh bvh;          ///< of the others
    Bounds hull;      ///< of its items
    double grain = 0; ///< mean size of an item, as a share of the hull
  };
  Group all;
  std::vector<Group> some; ///< those of bits that at most half of the solids have

  Bounds bounds(SolidId id) const {
    Bounds const* const own = solids[id].bounds();
    return own != nullptr ? *own : primitives[solids[id].only()].bounds();
  }

  Group make_group(std::uint8_t mask) const {
    Group group;
    group.mask = mask;
    auto const each = [&](auto const& visit) {
      for (SolidId id = 0; id < solids.size(); ++id) {
        if (mask == 0xff || (solids[id].mask() & mask) != 0) visit(id, bounds(id));
      }
    };
    BvhSpaceFinder finder;
    std::size_t finite = 0;
    each([&](SolidId id, Bounds const& bounds) {
      if (bounds.infinite) {
        group.infinite.push_back(id);
      } else if (!bounds.empty()) {
        finder.add(bounds.low, bounds.high);
        ++finite;
      }
    });
    std::vector<BvhBox> boxes;
    boxes.reserve(finite);
    BvhSpace const space = finder.space();
    group.hull = finder.hull();
    double const size = glm::length(group.hull.high - group.hull.low);
    each([&](SolidId id, Bounds const& bounds) {
      if (bounds.infinite || bounds.empty()) return;
      boxes.push_back(space.box(bounds.low, bounds.high, id));
      group.grain += glm::length(bounds.high - bounds.low) / size / static_cast<double>(finite);
    });
    group.bvh = Bvh(space, std::move(boxes));
    return group;
  }
  Group const& group(std::uint8_t mask) const {
    for (Group const& few : some) {
      if ((mask & ~few.mask) == 0) return few;
    }
    return all;
  }
  Contacts contacts; ///< by solid

  /// As World has them.
  bool closest_group(Ray const& ray, Departure const* from, std::uint8_t mask, double t_max,
                     Scratch& scratch, HitGroup& out) const;
  bool occluded(Ray const& ray, Departure const* from, std::uint8_t mask, double t_max,
                Scratch& scratch) const;
  bool first_group(Ray const& ray, Departure const* from, std::uint8_t mask, double t_max,
                   Scratch& scratch, HitGroup& out) const;
  void join_contact(Ray const& ray, std::uint8_t mask, double t_max, Scratch& scratch,
                    HitGroup& out) const;
  struct First; ///< of closest.cpp
  enum class Kind : std::uint8_t { Nothing, Single, Several };
  /// A crossing that is clear of all others.
  struct Alone {
    SurfaceCrossing crossing;
    double error = 0;
    bool was_entering = false; ///< the primitive (the solid may be its inverse)
  };
  /// closest() where one crossing stands clear of all others; Several: it may not, ask
  /// first_group().
  Kind first_single(Ray const& ray, Departure const* from, std::uint8_t mask, double t_max,
                    Scratch& scratch, Alone& out) const;
  /// closest() as what ray k of `hits` meets.
  void find_alone(Ray const& ray, Departure const* from, std::uint8_t mask, double t_max,
                  Scratch& scratch, Hits& hits, std::size_t k) const;
  struct Nearest; ///< of fan.cpp
  struct Pair;
  void find_fan(FanLines const& rays, Departure const* from, std::uint8_t mask, Scratch& scratch,
                Nearest& nearest) const;
  /// find_alone() for each ray of a fan, which is ray place[k] of `hits`.
  /// @param rays at least one, filled up
  /// @param t_max by ray; null: infinite
  void closest_fan(FanLines const& rays, std::uint32_t const* place, Departure const* from,
                   std::uint8_t mask, double const* t_max, Scratch& scratch, Hits& hits) const;
  /// occluded() for each ray of a fan: blocked, clear, or neither of them where it takes occluded()
  /// itself to tell. No more is asked about rays that are blocked.
  void occluded_fan(FanLines const& rays, Departure const* from, std::uint8_t mask,
                    double const* t_max, Scratch& scratch, bool* blocked, bool* clear) const;
  /// closest() of a ray whose group a fan found.
  void closest_pair(Ray const& ray, Pair const& pair, std::uint8_t mask, double t_max,
                    Scratch& scratch, HitGroup& out) const;
  /// @param touches gets the rays that may meet what is in contact with what they leave
  void find_contacts(FanLines const& rays, std::uint32_t const* place, std::uint8_t mask,
                     double const* t_max, Scratch& scratch, Hits const& hits, bool* touches) const;
  bool diverge(FanLines const& rays, std::uint8_t mask) const;
  /// Tells one world's scratch from another's, nothing more.
  static std::uint64_t next_number() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
  }
  void prepare(Scratch& scratch) const {
    if (scratch.owner == number) return;
    scratch.states.assign(states, {});
    for (std::size_t i = 0; i < solids.size(); ++i) {
      if (solids[i].has_program()) scratch.states[state_of[i]] = solids[i].program()->outside();
    }
    scratch.owner = number;
  }
  TracedSolid::Query query(SolidId id, Ray const& ray, Departure const* from, Scratch& scratch,
                           double const& until = everywhere) const {
    CsgProgram::State* state = solids[id].has_program() ? &scratch.states[state_of[id]] : nullptr;
    return {primitives, ray, from, scratch, state, until};
  }
  /// visit(solid) for those that what Probe(rays) stands for may meet in [low, high], with a bit of
  /// `mask` and perhaps others; false stops.
  template <class Probe, class Rays, class Visit>
  void each_solid(Rays const& rays, std::uint8_t mask, double low, double const& high,
                  Visit&& visit) const {
    Group const& group = this->group(mask);
    bool goes_on = true;
    if (group.bvh.items().size() == 1) { // most small scenes have a plane and a solid
      SolidId const id = group.bvh.items().front();
      Bounds const& lone = group.hull;
      double entry = 0;
      if (typename Probe::Single(rays).enter(lone.low, lone.high, low, high, entry)) {
        goes_on = visit(id);
      }
    } else if (!group.bvh.nodes().empty()) {
      walk(group.bvh, Probe(rays, group.bvh.space()), low, high, [&](SolidId id) {
        goes_on = visit(id);
        return goes_on;
      });
    }
    for (std::size_t i = 0; goes_on && i < group.infinite.size(); ++i) {
      goes_on = visit(group.infinite[i]);
    }
  }
};

} // namespace abbe::geometry
