// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/world.hpp"

#include <cstdint>
#include <vector>

/// A boolean tree made flat, and its value kept up to date while single primitives change sides:
/// each node counts its true children, so that a change costs the depth of the tree, not its size.
namespace abbe::geometry {

class CsgProgram {
public:
  explicit CsgProgram(CsgTree const& tree);

  /// The distinct primitives, ascending. A primitive is spoken of by its place here ("operand").
  std::vector<PrimitiveId> const& operands() const { return operands_; }
  /// Is the operand only there to clip, without a surface of its own?
  bool hidden(std::uint32_t operand) const { return hidden_[operand] != 0; }

  /// What a ray knows: which operands it is in, and the counts that follow.
  struct State {
    std::vector<std::uint8_t> inside;
    std::vector<std::int32_t> count;
    bool value = false;
  };
  /// Outside all operands.
  State const& outside() const { return outside_; }
  void set(State& state, std::uint32_t operand, bool inside) const {
    if ((state.inside[operand] != 0) != inside) turn(state, operand, inside);
  }
  /// Would the value be another if the operand changed sides?
  bool decides(State& state, std::uint32_t operand) const;

private:
  struct Node {
    std::uint32_t parent = 0; ///< the root is its own parent
    std::int32_t needed = 1;  ///< true when at least so many children are
    bool flip = false;        ///< then negated
  };
  struct Leaf {
    std::uint32_t operand = 0;
    std::uint32_t parent = 0;
    bool flip = false;
    bool hidden = false;
  };
  void flatten(CsgTree const& tree, std::uint32_t parent, bool flip, bool hidden);
  void turn(State& state, std::uint32_t operand, bool inside) const;
  void change(State& state, std::uint32_t node, bool up) const;

  std::vector<Node> nodes_;               ///< nodes_[0]: the root
  std::vector<Leaf> leaves_;              ///< by operand
  std::vector<std::uint32_t> first_leaf_; ///< by operand, and an end
  std::vector<PrimitiveId> operands_;
  std::vector<std::uint8_t> hidden_;
  State outside_;
};

} // namespace abbe::geometry
