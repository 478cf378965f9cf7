// SPDX-License-Identifier: MIT
#pragma once

#include "transport/caustics/emission.hpp"
#include "transport/caustics/forced.hpp"
#include "transport/caustics/light_paths.hpp"
#include "transport/caustics/sheet.hpp"

#include <span>
#include <vector>

namespace abbe::transport::caustics {

/// Finds the sheets (Sheet::certain) of which all rays are real: the solids of the chain are
/// convex and have no other surfaces, nothing else is in boxes around the ways between them, and
/// the nodes' rays make the chain. The light of such a ray needs no other ray.
class Certainty {
public:
  Certainty(Stage const& stage, ForcedPaths& forced, LightPaths& paths, Emission const& emission,
            std::vector<int> const& spectrum, ChainTable const& chains)
      : stage_(stage),
        forced_(forced),
        paths_(paths),
        emission_(emission),
        spectrum_(spectrum),
        chains_(chains) {}
  /// @param sheets those that have a map are looked at
  void find(std::span<Sheet> sheets);

private:
  bool convex(Chain const& chain) const;
  /// Has nothing else a part in the ways of the nodes' rays?
  bool clear(Sheet const& sheet, int wave);
  bool clear(std::span<Vec3 const> from, std::span<Vec3 const> to, Step const* left,
             Step const& met);
  void follow(std::span<Sheet*> sheets);
  int wave_at(Sheet const& sheet, double at) const;

  Stage const& stage_;
  ForcedPaths& forced_;
  LightPaths& paths_;
  Emission const& emission_;
  std::vector<int> const& spectrum_;
  ChainTable const& chains_;
  ForcedRays rays_;
  std::vector<geometry::SolidId> near_;
};

} // namespace abbe::transport::caustics
