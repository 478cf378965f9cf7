// SPDX-License-Identifier: MIT
#include "geometry/lane_tree.hpp"

#include <algorithm>

namespace abbe::geometry {

std::unique_ptr<LaneTree const> LaneTree::of(CsgTree const& tree, CsgProgram const& program,
                                             std::vector<Placed> const& primitives) {
  auto const& operands = program.operands();
  if (operands.size() > most_operands) return nullptr;
  auto result = std::make_unique<LaneTree>();
  bool any_kernel = false;
  for (std::uint32_t i = 0; i < operands.size(); ++i) {
    Placed const& placed = primitives[operands[i]];
    if (!placed.shape().solid()) return nullptr;
    EndsKernel const* kernel = placed.shape().ends_kernel();
    if (kernel != nullptr && !kernel->ends_visible()) kernel = nullptr;
    GapKernel const* const gap = kernel == nullptr ? placed.shape().gap_kernel() : nullptr;
    Bounds const bounds = placed.bounds();
    bool const asked = kernel != nullptr || gap != nullptr;
    if (!asked && bounds.infinite) return nullptr;
    any_kernel = any_kernel || asked;
    result->operands_.push_back({operands[i], kernel, gap, bounds, program.hidden(i)});
  }
  if (!any_kernel || !result->flatten(tree, program)) return nullptr;
  return result;
}

bool LaneTree::flatten(CsgTree const& tree, CsgProgram const& program) {
  if (tree.op == CsgTree::Op::Primitive) {
    if (++leaves_ > most_operands) return false;
    auto const& operands = program.operands();
    auto const at = std::lower_bound(operands.begin(), operands.end(), tree.primitive);
    steps_.push_back({Step::Kind::Operand, static_cast<std::uint8_t>(at - operands.begin())});
  } else {
    if (tree.children.empty()) return false;
    bool const any = tree.op == CsgTree::Op::Merge;
    for (std::size_t i = 0; i < tree.children.size(); ++i) {
      if (!flatten(tree.children[i], program)) return false;
      if (i == 0) continue;
      if (tree.op == CsgTree::Op::Difference) steps_.push_back({Step::Kind::Negate});
      steps_.push_back({any ? Step::Kind::Either : Step::Kind::Both});
    }
  }
  if (tree.inverse) steps_.push_back({Step::Kind::Negate});
  return true;
}

} // namespace abbe::geometry
