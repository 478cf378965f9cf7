// SPDX-License-Identifier: MIT
#pragma once

#include "grammar/lexer.hpp"

#include <unordered_set>

namespace abbe::grammar {

/// Brackets that do not pair up within one branch of an #if, found by one scan over the tokens of a
/// source that has an #if at all. Branches are text to the language, so
///   #if (M) merge { #else union { #end ... }            has a tail: ast::If::open_blocks
///   #if (C) difference { #end ... #if (C) } #end        has loose brackets: ast::Block::open
/// are fine, as long as the text that is executed balances.
struct Structure {
  std::unordered_set<Iterator> open;  ///< '{' and the '(' of #write that their branch leaves open
  std::unordered_set<Iterator> close; ///< '}' and ')' that close what was opened elsewhere
  std::unordered_set<Iterator>
      tails; ///< '#' of each #if whose one open block is closed behind its #end
};

Structure scan_structure(Iterator first, Iterator last);

} // namespace abbe::grammar
