// SPDX-License-Identifier: MIT
#include "geometry/csg.hpp"

#include <algorithm>

namespace abbe::geometry {

CsgProgram::CsgProgram(CsgTree const& tree) {
  nodes_.push_back({0, 1, false});
  flatten(tree, 0, false, false);
  for (Leaf const& leaf : leaves_) operands_.push_back(leaf.operand);
  std::sort(operands_.begin(), operands_.end());
  operands_.erase(std::unique(operands_.begin(), operands_.end()), operands_.end());
  for (Leaf& leaf : leaves_) {
    auto const at = std::lower_bound(operands_.begin(), operands_.end(), leaf.operand);
    leaf.operand = static_cast<std::uint32_t>(at - operands_.begin());
  }
  std::stable_sort(leaves_.begin(), leaves_.end(),
                   [](Leaf const& a, Leaf const& b) { return a.operand < b.operand; });
  first_leaf_.assign(operands_.size() + 1, 0);
  hidden_.assign(operands_.size(), 1);
  for (Leaf const& leaf : leaves_) {
    ++first_leaf_[leaf.operand + 1];
    if (!leaf.hidden) hidden_[leaf.operand] = 0;
  }
  for (std::size_t i = 1; i < first_leaf_.size(); ++i) first_leaf_[i] += first_leaf_[i - 1];

  // Children come after their parents: from the back, each node's value is known when it is met.
  outside_.inside.assign(operands_.size(), 0);
  outside_.count.assign(nodes_.size(), 0);
  for (Leaf const& leaf : leaves_) {
    if (leaf.flip) ++outside_.count[leaf.parent];
  }
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    bool const value = (outside_.count[i] >= nodes_[i].needed) != nodes_[i].flip;
    if (i == 0) {
      outside_.value = value;
    } else if (value) {
      ++outside_.count[nodes_[i].parent];
    }
  }
}

void CsgProgram::flatten(CsgTree const& tree, std::uint32_t parent, bool flip, bool hidden) {
  flip = flip != tree.inverse;
  if (tree.op == CsgTree::Op::Primitive) {
    leaves_.push_back({tree.primitive, parent, flip, hidden});
    return;
  }
  bool const any = tree.op == CsgTree::Op::Merge;
  auto const self = static_cast<std::uint32_t>(nodes_.size());
  auto const children = static_cast<std::int32_t>(tree.children.size());
  nodes_.push_back({parent, any ? 1 : std::max(children, 1), flip}); // no children: empty
  for (std::size_t i = 0; i < tree.children.size(); ++i) {
    bool const taken_away = i > 0 && tree.op == CsgTree::Op::Difference;
    bool const clips = i > 0 && tree.op == CsgTree::Op::Clip;
    flatten(tree.children[i], self, taken_away, hidden || clips);
  }
}

void CsgProgram::change(State& state, std::uint32_t node, bool up) const {
  for (;;) {
    Node const& n = nodes_[node];
    bool const before = state.count[node] >= n.needed;
    state.count[node] += up ? 1 : -1;
    bool const after = state.count[node] >= n.needed;
    if (before == after) return;
    up = after != n.flip;
    if (node == 0) {
      state.value = up;
      return;
    }
    node = n.parent;
  }
}

void CsgProgram::turn(State& state, std::uint32_t operand, bool inside) const {
  state.inside[operand] = inside ? 1 : 0;
  for (std::uint32_t i = first_leaf_[operand]; i < first_leaf_[operand + 1]; ++i) {
    change(state, leaves_[i].parent, inside != leaves_[i].flip);
  }
}

bool CsgProgram::decides(State& state, std::uint32_t operand) const {
  bool const inside = state.inside[operand] != 0, before = state.value;
  set(state, operand, !inside);
  bool const other = state.value != before;
  set(state, operand, inside);
  return other;
}

} // namespace abbe::geometry
