// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <utility>

/// What the templates of this folder ask of a lane type L, double or a vector of doubles:
/// + - * / unary -, comparisons giving a mask with & | !, conversion from double, and, found by
/// argument-dependent lookup, sqrt(L) and select(mask, L, L). These are the ones for double.
namespace abbe::optics {

using std::sqrt;

inline double select(bool mask, double if_true, double if_false) {
  return mask ? if_true : if_false;
}

template <class L>
using MaskOf = decltype(std::declval<L>() < std::declval<L>());

} // namespace abbe::optics
