// SPDX-License-Identifier: MIT
#pragma once

#include "transport/caustics/emission.hpp"
#include "transport/caustics/forced.hpp"
#include "transport/caustics/light_paths.hpp"
#include "transport/caustics/receivers.hpp"
#include "transport/caustics/sheet.hpp"

#include <map>
#include <span>
#include <unordered_map>
#include <vector>

namespace abbe::transport::caustics {

/// What the search for sheets came to, of one lamp. Flux is a share of what the lamp sends to the
/// casters.
struct Found {
  double missing = 0; ///< estimate of the flux of chains that were not found
  double cut = 0;     ///< flux given up as too little or too deep
  std::uint64_t rays = 0, cells = 0;
  bool full = false; ///< there were more sheets than fit
};

/// Finds the sheets of a lamp from the lamp: cells of its emission are split while rays of their
/// corners go different ways, or while the map of a chain is too curved in them for Newton's
/// iteration. What is found depends on scene, lamp and error alone.
class SheetBuilder {
public:
  /// Where light is thrown from and onto.
  struct Places {
    std::vector<Ball> casters;
    geometry::Bounds casters_hull;
    Receivers receivers;
    double size = 0; ///< of what is finite
    double far = 0;  ///< how far light goes that meets nothing
  };
  static constexpr int spectrum_pieces = 1024;
  /// @param spectrum waves from one end of it to the other, one more than its pieces; or one, where
  /// it has none
  SheetBuilder(Stage const& stage, Waves const& waves, std::vector<int> const& spectrum,
               Places const& places, Limits const& limits, double error, ChainTable& chains);
  /// Level of the largest cells of the lamp that was last built.
  int root_level() const { return root_level_; }
  Found build(int lamp, Emission const& emission, std::vector<Sheet>& sheets);

private:
  /// A chain as a node's ray shows it.
  struct Seen {
    int chain;
    std::uint8_t ends; ///< of the spectrum: bits
    double power, far;
    bool receives;
    Vec3 origin, landing;
  };
  using Node = std::vector<Seen>;
  struct Verdict {
    bool ok = false;
    int from = 0, to = 0; ///< pieces of the spectrum
    std::array<std::array<BeamRay, 9>, 2> rays;
  };
  struct Work {
    Cell cell;
    double bad = 0; ///< flux of what disagrees or is too curved
  };

  void roots(Cell const& cell, std::vector<std::uint32_t> const& balls, int level);
  int find_root_level() const;
  void trace_nodes(std::vector<Work> const& cells);
  void look(Work& work, std::vector<Sheet>& sheets);
  Verdict judge(Cell const& cell, int chain, std::span<double const> ways);
  void emit(Cell const& cell, int chain, Verdict const& verdict, std::span<double const> ways,
            double far, std::vector<Sheet>& sheets);
  using Nine = std::array<BeamRay, 9>;
  /// The rays of a chain at the nodes of a cell. @return false: some are not there
  bool nine(Cell const& cell, int chain, int wave, Nine& out);
  /// Sheets of a piece of the spectrum, in as many pieces as it takes. @param from, to of its
  /// pieces
  void emit_piece(Sheet sheet, int from, int to, Nine const& low, Nine const& high,
                  std::span<double const> ways, double far, std::vector<Sheet>& sheets);
  /// The sheet of a chain that a cell lies in, or none.
  static constexpr std::uint32_t none = 0xffffffff;
  std::uint32_t sheet_over(Cell cell, int chain) const;
  /// Takes out the chains that carry the least. @return the share of the flux that they had
  double drop_weak(std::vector<Sheet>& sheets, double total) const;
  std::uint64_t key_of(Cell const& cell, int node) const;
  Emission::Place place_of(Cell const& cell, int node) const;

  Stage const& stage_;
  Waves const& waves_;
  std::vector<int> const& spectrum_;
  std::array<int, 2> ends_;
  Places const& places_;
  Limits limits_;
  double error_;
  ChainTable& chains_;
  LightPaths paths_;
  ForcedPaths forced_;
  Emission const* emission_ = nullptr;
  int lamp_ = 0, root_level_ = 0;
  std::vector<Work> next_;
  std::unordered_map<std::uint64_t, std::uint32_t> known_;
  std::vector<Node> nodes_;
  std::unordered_map<std::uint64_t, std::uint32_t> emitted_; ///< sheets by cell and chain
  std::unordered_map<int, std::uint32_t> seen_by_;           ///< nodes that saw a chain
  std::map<int, double> flux_of_;                            ///< of a chain that one node saw
};

} // namespace abbe::transport::caustics
