// SPDX-License-Identifier: MIT
#pragma once

#include "grammar/config.hpp"

namespace abbe::grammar {

/// Closers that belong to what an error broke off: they are passed over, not reported again.
struct Pending {
  int ends = 0;   ///< `#end`, with the `#else`, `#case` before it
  int braces = 0; ///< `}`

  /// Moves past such a closer; false when none stands at `at`.
  bool take(Iterator& at, Iterator last);
};

/// Where parsing can go on after an error at `at`, which happened in `state`: at the next directive
/// or word that begins a line and stands outside the braces that were open, or is not indented.
/// Adds to `pending` what stays open there.
Iterator resume(Iterator at, Iterator last, State const& state, Pending& pending);

} // namespace abbe::grammar
