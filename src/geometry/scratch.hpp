// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/batch.hpp"
#include "geometry/csg.hpp"
#include "geometry/world.hpp"

#include <cstdint>
#include <utility>
#include <vector>

namespace abbe::geometry {

/// A crossing of a line with one operand of a solid.
struct Event {
  double t = 0;
  double error = 0;
  PrimitiveId primitive = 0;
  std::uint32_t operand = 0;
  std::uint32_t face = 0;
  bool entering = false;
  bool toggles = true;
  bool visible = true;
  bool at_start = false; ///< belongs to the group that the ray departs from
};

/// A crossing of a solid, and where its members (all events of its group) are in Scratch::members.
struct Candidate {
  SurfaceCrossing crossing;
  double error = 0;
  std::uint32_t first_member = 0;
  std::uint32_t members = 0;
};

/// What HalfSpaces computes of a line, plane by plane (filled up to whole lanes).
struct HalfSpaceScratch {
  std::vector<double> height, speed; ///< t = -height / speed
  std::vector<double> out;           ///< t where the line leaves, after the start; else infinity
  std::vector<double> minus_in;      ///< -t where the line enters, after the start; else infinity
  void resize(std::size_t size) {
    if (height.size() == size) return;
    for (std::vector<double>* const v : {&height, &speed, &out, &minus_in}) v->resize(size);
  }
};

inline constexpr SolidId no_solid = static_cast<SolidId>(-1);

/// Where a crossing of a fan's ray comes from (World::Impl::closest_fan).
struct FanProposal {
  SolidId solid = 0;
  PrimitiveId primitive = 0;
  bool inverse = false; ///< the solid's inside is the primitive's outside
  bool alone = true;    ///< its only event
  bool toggles = true;
};

class Scratch {
public:
  /// Asked first by the next World::occluded, whose answer does not depend on it.
  SolidId last_occluder = no_solid;
  HalfSpaceScratch half_spaces;
  Crossings crossings;
  std::vector<Event> events;
  std::vector<Candidate> candidates;
  std::vector<Departure::On> members;
  StartOrder order;    ///< of a batch
  Departure departure; ///< of a packet of it
  HitGroup beyond;     ///< what is in contact with a group
  Departure through;   ///< from that group on
  std::vector<FanProposal> proposals;
  /// Values of the boolean trees of the world `owner`, put back to "outside" after each use.
  std::uint64_t owner = 0;
  std::vector<CsgProgram::State> states;
  struct Entered {
    double t;
    SolidId solid;
  };
  std::vector<Entered> entered;
};

/// By t; few, and nearly in order.
template <class Item>
void sort_few(std::vector<Item>& items) {
  for (std::size_t i = 1; i < items.size(); ++i) {
    for (std::size_t j = i; j > 0 && items[j].t < items[j - 1].t; --j) {
      std::swap(items[j], items[j - 1]);
    }
  }
}

} // namespace abbe::geometry
