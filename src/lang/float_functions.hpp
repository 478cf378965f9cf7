// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

namespace abbe::lang {

/// The functions of one or two floats that expressions and user functions share: no checks, no
/// messages (outside its domain one yields NaN or infinity).
struct FloatFunction {
  std::string_view name;
  int arguments;
  double (*compute)(double, double);
};
std::span<FloatFunction const> float_functions();
FloatFunction const* find_float_function(std::string_view name);

} // namespace abbe::lang
