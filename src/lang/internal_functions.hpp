// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

namespace abbe::lang {

/// A function of functions.inc, in the language of functions.
struct InternalFunction {
  int number;            ///< of `internal(n)`; below 0: others call it by its name
  std::string_view name; ///< of these
  std::string_view text; ///< "(x, y, z, a) { ... }"
};
std::span<InternalFunction const> internal_functions();

} // namespace abbe::lang
