// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/half_spaces.hpp"

#include <memory>
#include <optional>

/// The intersection of operands each of which a line is in along one interval at most (planes,
/// balls, boxes ...; also a plane taken away): from the last way in to the first way out. Groups of
/// events are not needed for that as long as the two ends stand clear of all other crossings, by
/// error intervals; otherwise nothing is said, and the general way decides.
///
/// The same as the general way, because a group's ends come in the order of t: when the last way in
/// is not before the first way out, no group leaves the line inside of all operands.
namespace abbe::geometry {

class ConvexCut {
public:
  /// @return null when the tree is not of this kind
  static std::unique_ptr<ConvexCut const> of(CsgTree const& tree, CsgProgram const& program,
                                             std::vector<Placed> const& primitives);

  using Verdict = HalfSpaces::Verdict;
  struct End {
    double t = 0;
    double error = 0;
    std::size_t at = 0; ///< plane, or place in scratch.events
    bool by_plane = false;
  };
  /// What the line has in common with the solid after its start, about.
  struct Part {
    HalfSpaces::Common common;
    End in;  ///< t = -infinity: the start is inside
    End out; ///< t = infinity: no end
  };
  /// Something: a part that is not empty and begins before query.until.
  Verdict find(LineQuery const& query, Part& part) const;
  /// Makes sure that the end stands alone. @return its place in scratch.events; nullopt: unclear
  std::optional<std::size_t> entry(LineQuery const& query, Part const& part) const;
  std::optional<std::size_t> exit(LineQuery const& query, Part const& part) const;

  struct Operand {
    PrimitiveId primitive;
    std::uint32_t operand;
  };
  HalfSpaces const& planes() const { return planes_; }
  /// Bounded, none taken away.
  std::span<Operand const> others() const { return others_; }
  /// All of them are kernels with both ends visible: fan_cut.hpp may be asked.
  bool has_kernels() const { return has_kernels_; }

private:
  Verdict narrow(LineQuery const& query, Part& part) const;
  std::optional<std::size_t> event_of(LineQuery const& query, End const& end) const;

  HalfSpaces planes_;
  std::vector<std::uint32_t> plane_operands_; ///< as planes_.primitives()
  std::vector<Operand> others_;
  bool has_kernels_ = true;
};

} // namespace abbe::geometry
