// SPDX-License-Identifier: MIT
#pragma once

#include "lang/value.hpp"

namespace abbe::lang {

/// Elements of an array, over all its dimensions (a scene that asks for more is told so, rather
/// than ending for want of memory: an element takes some 90 bytes).
inline constexpr double max_array_elements = 1 << 24;

/// A snapshot: arrays are copied with all they hold, block values are shared (they never change).
Value copy_of(Value const&);

} // namespace abbe::lang
