// SPDX-License-Identifier: MIT
#include "grammar/open_blocks.hpp"

#include <fmt/format.h>

namespace abbe::grammar {

std::uint8_t common_open_blocks(ast::If const& node, State const& state) {
  std::uint8_t const common = node.branches.front().open_blocks;
  for (auto const& branch : node.branches) {
    if (branch.open_blocks == common && common <= 1) continue;
    Iterator const begin = state.begin + branch.span.begin;
    throw SyntaxError{
        "E0117", begin, begin + 1,
        fmt::format("this branch leaves {} blocks open; either every branch of an #if "
                    "leaves one open, or none does",
                    branch.open_blocks)};
  }
  return common;
}

} // namespace abbe::grammar
