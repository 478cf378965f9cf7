// SPDX-License-Identifier: MIT
#pragma once

#include "field/tape.hpp"
#include "lang/function.hpp"

#include <memory>

namespace abbe::lang {

/// A user function of x, y and z as a tape, with all that it calls in its place.
struct FunctionTape {
  field::Tape tape;
  /// Defined everywhere, as far as its steps tell: no root, logarithm or quotient of what may be
  /// out of range.
  bool total = true;
  bool noise = false;  ///< noise, piece by piece, takes most of its time
  bool blocks = false; ///< calls a pattern, pigment, transform or spline
};

/// @return null where it is longer than tapes are, has loops whose ends change from place to place,
///         or noise whose generator does
std::shared_ptr<FunctionTape const> make_tape(FunctionValue const& function);

} // namespace abbe::lang
