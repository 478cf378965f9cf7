// SPDX-License-Identifier: MIT
#pragma once

#include "lang/scope.hpp"
#include "lang/value.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace abbe::lang {

class Interpreter;

/// Names that are operands by themselves. Their order is that of their symbols, from 1.
enum class Constant : Symbol {
  X = 1,
  Y,
  Z,
  U,
  V,
  T,
  Pi,
  True,
  Yes,
  On,
  False,
  No,
  Off,
  Clock,
  ClockDelta,
  ClockOn,
  FrameNumber,
  InitialFrame,
  FinalFrame,
  InitialClock,
  FinalClock,
  ImageWidth,
  ImageHeight,
  Version,
  Now,
  Count
};
extern std::array<std::string_view, static_cast<std::size_t>(Constant::Count)> const constant_names;

/// Value of a constant's symbol.
Numeric constant(Constant, Interpreter&);

/// One evaluated argument of a built-in function.
struct Argument {
  Numeric number;
  std::string text;
  Span span;
};

/// What a built-in function is told besides its arguments. A function that cannot be computed
/// reports through fail() and returns anything: the result is thrown away.
struct CallContext {
  Interpreter& in;
  Span span;
  std::string_view name;
  bool failed = false;
  Numeric fail(std::string_view message);
};

/// A built-in function of numbers and strings.
struct Builtin {
  std::string_view name;
  /// One letter an argument: f float, v 3-vector, s string, n number of any size; `*` repeats the
  /// last,
  /// `?` makes all that follow optional. `!`: arguments are not evaluated first (defined, trace
  /// ...), `special` does the rest.
  std::string_view signature;
  bool yields_string = false;
  Numeric (*compute)(CallContext&, std::span<Argument const>) = nullptr;
  std::string (*text)(CallContext&, std::span<Argument const>) = nullptr;
  Numeric (*special)(CallContext&, ast::Call const&) = nullptr;
};

/// All built-in functions; a function's symbol is its place here plus first_builtin.
std::span<Builtin const> builtins();
inline constexpr Symbol first_builtin = static_cast<Symbol>(Constant::Count);
/// The function of a symbol, nullptr when it is none.
Builtin const* find_builtin(Symbol);

/// A number of n components.
inline Numeric scalar_of(double v) {
  Numeric n;
  n.c[0] = v;
  return n;
}
inline Numeric vector_of(Vec3 const& v) {
  Numeric n;
  n.size = 3;
  n.c = {v.x, v.y, v.z, 0, 0};
  return n;
}

// The functions, by subject.
std::span<Builtin const> float_builtins();  // builtins_float.cpp
std::span<Builtin const> vector_builtins(); // builtins_vector.cpp
std::span<Builtin const> string_builtins(); // builtins_string.cpp
std::span<Builtin const> scene_builtins();  // builtins_scene.cpp: names, arrays, files, objects

} // namespace abbe::lang
