// SPDX-License-Identifier: MIT
#pragma once

#include "transport/caustics/chain.hpp"
#include "transport/caustics/emission.hpp"
#include "transport/caustics/sheet.hpp"
#include "transport/caustics/waves.hpp"
#include "transport/chunk.hpp"

#include <array>
#include <vector>

namespace abbe::transport::caustics {

/// Rays that are led along the steps of a chain whatever else is there: each step crosses its own
/// primitive, whose flat faces have no edges. So the map of a chain goes on beyond where real light
/// takes it, which is what Newton's iteration and cells at edges need.
struct ForcedRays {
  std::size_t count = 0;
  Vectors origin, direction;                 ///< behind the last step, once they have gone
  Values length;                             ///< of the way
  Values share;                              ///< that surfaces left of the light; of plain chains
  std::array<Values, most_absorbing> inside; ///< ways in Chain::absorbing
  std::vector<Vec3>* points = nullptr;       ///< where they meet the steps, if they are wanted
  int wave[chunk_width];
  RaySet valid = 0; ///< of the others nothing is known
};

class ForcedPaths {
public:
  ForcedPaths(Stage const& stage, Waves const& waves)
      : stage_(stage), waves_(waves), scratch_(geometry::World::make_scratch()) {}
  /// @param rays `count` of them from the lamp
  void follow(Chain const& chain, ForcedRays& rays);
  /// Those of the nodes of a cell (node_place). @return false: some are not there
  bool follow_nodes(Chain const& chain, Emission const& emission, Cell const& cell, int wave,
                    ForcedRays& rays);
  std::uint64_t rays() const { return rays_; }

private:
  void cross(Step const& step, std::size_t at_step, Chain const& chain, ForcedRays& rays);

  Stage const& stage_;
  Waves const& waves_;
  Arena arena_;
  Chunk chunk_;
  geometry::ScratchPtr scratch_;
  geometry::Start starts_[chunk_width];
  Values way_; ///< to the next surface
  std::uint32_t faces_[chunk_width];
  std::uint64_t rays_ = 0;
};

} // namespace abbe::transport::caustics
