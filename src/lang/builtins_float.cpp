// SPDX-License-Identifier: MIT
#include "lang/builtins.hpp"
#include "lang/float_functions.hpp"
#include "lang/interpreter.hpp"

#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <vector>

namespace abbe::lang {
namespace {

using Arguments = std::span<Argument const>;
double f(Arguments a, std::size_t i) {
  return a[i].number.c[0];
}

/// Evaluates one of the functions of floats that user functions know too, and checks its domain.
Numeric plain(CallContext& context, Arguments a) {
  FloatFunction const* const function = find_float_function(context.name);
  ABBE_ASSERT(function);
  double const first = f(a, 0);
  double const second = a.size() > 1 ? f(a, 1) : 0;
  std::string_view const name = context.name;
  if ((name == "asin" || name == "acos") && std::abs(first) > 1) {
    context.in.warning(fmt::format("{}({}): taken at {}", name, first, first > 0 ? 1 : -1),
                       context.span);
    return scalar_of(function->compute(first > 0 ? 1 : -1, 0));
  }
  if ((name == "ln" || name == "log") && first <= 0)
    return context.fail(fmt::format("not defined for {}", first));
  if (name == "pow" && first == 0 && second == 0)
    return context.fail("0 to the power of 0 is not defined");
  if (name == "atan2" && std::abs(first) <= 1e-10 && std::abs(second) <= 1e-10) // POV-Ray's zero
    return context.fail("not defined for 0, 0");
  if (name == "mod" && second == 0) return context.fail("division by zero");
  double const value = function->compute(first, second);
  if (std::isnan(value) && !std::isnan(first) && !std::isnan(second))
    return context.fail(a.size() > 1 ? fmt::format("not defined for {}, {}", first, second)
                                     : fmt::format("not defined for {}", first));
  return scalar_of(value);
}

Numeric divide(CallContext& context, Arguments a) {
  if (f(a, 1) == 0) return context.fail("division by zero");
  return scalar_of(whole_number(f(a, 0) / f(a, 1)));
}

Numeric smallest(CallContext&, Arguments a) {
  double value = f(a, 0);
  for (std::size_t i = 1; i < a.size(); ++i) value = std::min(value, f(a, i));
  return scalar_of(value);
}

Numeric largest(CallContext&, Arguments a) {
  double value = f(a, 0);
  for (std::size_t i = 1; i < a.size(); ++i) value = std::max(value, f(a, i));
  return scalar_of(value);
}

/// Whole numbers of 32 bits, toward zero, as POV-Ray's.
std::int32_t whole(double v) {
  double const t = std::trunc(v);
  if (!(std::abs(t) < 4294967296.0)) return INT32_MIN;
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(static_cast<std::int64_t>(t)));
}

template <class Operation>
Numeric bitwise(Arguments a, Operation operation) {
  std::int32_t value = whole(f(a, 0));
  for (std::size_t i = 1; i < a.size(); ++i) value = operation(value, whole(f(a, i)));
  return scalar_of(value);
}

Numeric bit_and(CallContext&, Arguments a) {
  return bitwise(a, [](std::int32_t l, std::int32_t r) { return l & r; });
}
Numeric bit_or(CallContext&, Arguments a) {
  return bitwise(a, [](std::int32_t l, std::int32_t r) { return l | r; });
}
Numeric bit_xor(CallContext&, Arguments a) {
  return bitwise(a, [](std::int32_t l, std::int32_t r) { return l ^ r; });
}

Numeric choose(CallContext&, Arguments a) {
  if (a.size() == 3) return a[f(a, 0) < 0 ? 1 : 2].number;
  return a[f(a, 0) < 0 ? 1 : f(a, 0) == 0 ? 2 : 3].number;
}

Numeric seed(CallContext& context, Arguments a) {
  auto& streams = context.in.random_streams;
  streams.push_back(static_cast<std::uint32_t>(whole(f(a, 0))));
  return scalar_of(static_cast<double>(streams.size() - 1));
}

Numeric random(CallContext& context, Arguments a) {
  auto& streams = context.in.random_streams;
  double const handle = std::trunc(f(a, 0));
  if (!(handle >= 0 && handle < static_cast<double>(streams.size())))
    return context.fail("its argument must be what seed() gave");
  std::uint32_t& state = streams[static_cast<std::size_t>(handle)];
  state = state * 1812433253u + 12345u;
  return scalar_of(state / 4294967295.0);
}

} // namespace

std::span<Builtin const> float_builtins() {
  static std::vector<Builtin> const table = [] {
    std::vector<Builtin> all;
    for (auto const& function : float_functions())
      all.push_back({function.name, function.arguments == 1 ? "f" : "ff", false, plain});
    for (Builtin const& more : {
             Builtin{"div", "ff", false, divide},
             Builtin{"min", "f*", false, smallest},
             Builtin{"max", "f*", false, largest},
             Builtin{"bitwise_and", "ff*", false, bit_and},
             Builtin{"bitwise_or", "ff*", false, bit_or},
             Builtin{"bitwise_xor", "ff*", false, bit_xor},
             Builtin{"select", "fff?f", false, choose},
             Builtin{"seed", "f", false, seed},
             Builtin{"rand", "f", false, random},
         })
      all.push_back(more);
    return all;
  }();
  return table;
}

} // namespace abbe::lang
