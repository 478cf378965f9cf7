// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
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
/// Toward zero, which has no sign. Of what is not a number: -2^31, as POV-Ray's.
inline double whole_number(double a) {
  return std::isnan(a) ? -0x1p31 : std::trunc(a) + 0.0;
}
std::span<FloatFunction const> float_functions();
FloatFunction const* find_float_function(std::string_view name);

} // namespace abbe::lang
