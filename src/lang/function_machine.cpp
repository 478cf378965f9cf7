// SPDX-License-Identifier: MIT
#include "lang/block_function.hpp"
#include "lang/float_functions.hpp"
#include "lang/function.hpp"
#include "lang/multifractal.hpp"
#include "texture/pattern.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace abbe::lang {
namespace {

using Node = FunctionValue::Node;
using Kind = Node::Kind;
constexpr double eps = 1e-10;

/// Evaluates nodes; `slots` are the parameters and loop variables.
struct Machine {
  FunctionValue const& function;
  double* slots;

  double operand(Node const& node, std::uint32_t i) const {
    return run(function.operands[node.a + i]);
  }

  double run(std::uint32_t place) const {
    Node const& node = function.nodes[place];
    auto const yes = [](bool b) { return b ? 1.0 : 0.0; };
    switch (node.kind) {
    case Kind::Constant:
      return node.value;
    case Kind::Parameter:
      return slots[node.c];
    case Kind::Add:
      return run(node.a) + run(node.b);
    case Kind::Sub:
      return run(node.a) - run(node.b);
    case Kind::Mul:
      return run(node.a) * run(node.b);
    case Kind::Div:
      return run(node.a) / run(node.b);
    case Kind::And: // comparisons in functions are exact, as POV-Ray's
      return yes(run(node.a) != 0 && run(node.b) != 0);
    case Kind::Or:
      return yes(run(node.a) != 0 || run(node.b) != 0);
    case Kind::Less:
      return yes(run(node.a) < run(node.b));
    case Kind::LessEqual:
      return yes(run(node.a) <= run(node.b));
    case Kind::Equal:
      return yes(run(node.a) == run(node.b));
    case Kind::NotEqual:
      return yes(run(node.a) != run(node.b));
    case Kind::GreaterEqual: // what is not a number is greater than all, as POV-Ray's
      return yes(!(run(node.a) < run(node.b)));
    case Kind::Greater:
      return yes(!(run(node.a) <= run(node.b)));
    case Kind::Negate:
      return -run(node.a);
    case Kind::Builtin:
      return float_functions()[node.c].compute(operand(node, 0), node.b > 1 ? operand(node, 1) : 0);
    case Kind::Noise:
      return texture::noise({slots[0], slots[1], slots[2]});
    case Kind::NoiseGenerator:
      return texture::noise({slots[0], slots[1], slots[2]}, static_cast<int>(slots[3]));
    case Kind::Ridged:
    case Kind::Hetero:
      return multifractal(node.kind);
    default:
      return run_call(node);
    }
  }

  double multifractal(Kind kind) const {
    Multifractal const of{slots[3], slots[4], slots[5], slots[6], slots[7]};
    auto const noise = [&](double x, double y, double z) {
      return texture::noise({x, y, z}, static_cast<int>(slots[8]));
    };
    auto const number = [](double value) { return value; };
    if (kind == Kind::Hetero) return of.hetero(slots[0], slots[1], slots[2], noise, number);
    return of.ridged(
        slots[0], slots[1], slots[2], noise, [](double v) { return std::clamp(v, 0.0, 1.0); },
        [](double v) { return std::abs(v); }, number);
  }

  double run_call(Node const& node) const {
    switch (node.kind) {
    case Kind::Min:
    case Kind::Max: {
      double value = operand(node, 0);
      for (std::uint32_t i = 1; i < node.b; ++i) {
        double const other = operand(node, i);
        bool const less = value < other; // of what is not a number: not, and so POV-Ray decides
        value = less == (node.kind == Kind::Min) ? value : other;
      }
      return value;
    }
    case Kind::Select: {
      double const which = operand(node, 0);
      if (node.b == 3) return operand(node, which < 0 ? 1 : 2);
      return operand(node, which < 0 ? 1 : which == 0 ? 2 : 3);
    }
    case Kind::Sum:
    case Kind::Product: {
      double total = node.kind == Kind::Sum ? 0 : 1;
      double const last = operand(node, 1);
      for (double i = operand(node, 0); i <= last + eps; i += 1) {
        slots[node.c] = i;
        double const term = operand(node, 2);
        total = node.kind == Kind::Sum ? total + term : total * term;
      }
      return total;
    }
    default: {
      std::array<double, 16> few;
      std::vector<double> many(node.b > few.size() ? node.b : 0);
      double* const arguments = many.empty() ? few.data() : many.data();
      for (std::uint32_t i = 0; i < node.b; ++i) arguments[i] = operand(node, i);
      return take_part(evaluate_function(*function.called[node.c], {arguments, node.b}),
                       static_cast<int>(node.value));
    }
    }
  }
};

} // namespace

Numeric evaluate_function(FunctionValue const& function, std::span<double const> arguments) {
  ABBE_ASSERT(arguments.size() == function.parameters && function.unsupported.empty());
  if (function.block) return function.block(arguments);
  std::array<double, 16> few;
  std::vector<double> many;
  std::size_t const size = std::max(function.slots, arguments.size());
  if (size > few.size()) many.resize(size);
  double* const slots = many.empty() ? few.data() : many.data();
  std::fill(std::copy(arguments.begin(), arguments.end(), slots), slots + size, 0.0);
  Numeric n;
  n.c[0] = Machine{function, slots}.run(static_cast<std::uint32_t>(function.nodes.size() - 1));
  return n;
}

} // namespace abbe::lang
