// SPDX-License-Identifier: MIT
#pragma once

#include "grammar/terminals.hpp"

/// The items that nearly all of a long text is made of, told by their first character and what
/// follows, without trying one rule of the grammar after another: lone numbers, literal vectors,
/// names and words, the heads of blocks, the end of a list. What they yield is what the rules
/// yield.
namespace abbe::grammar {

enum class Plain : std::uint8_t {
  No,    ///< the rules shall tell
  Taken, ///< `out` is the item
  Block  ///< a block `head {`, which `out` holds with its head; the rest is to be read
};
/// The item at `first`, where no blank stands.
Plain scan_plain(Iterator& first, Iterator last, State& state, ast::Item& out);

/// Literal vectors at `first`, where no blank stands: appended one by one, or as one node when
/// many of one size follow each other.
/// @return false, and nothing taken, when none stands there, or one that could be part of more
bool scan_vectors(Iterator& first, Iterator last, State& state, ast::Items& items);

/// Can no item begin at `at`, because a bracket closes there?
inline bool closes_list(Iterator at, State const& state) {
  bool const closer = *at == '}' || *at == '>' || *at == ')' || *at == ']';
  return closer && !(state.structure && state.structure->close.contains(at));
}

} // namespace abbe::grammar
