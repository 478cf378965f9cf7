// SPDX-License-Identifier: MIT
#include "lang/function_field.hpp"

#include "lang/block_function.hpp"
#include "lang/dual_logic.hpp"
#include "lang/function_tape.hpp"
#include "lang/multifractal.hpp"
#include "texture/noise_bounds.hpp"
#include "texture/pattern.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace abbe::lang {
namespace {

using Node = FunctionValue::Node;
using Kind = Node::Kind;
constexpr double eps = 1e-10; ///< that of the ends of sums, as in function.cpp

Interval const everything = Interval::everything();

/// Evaluates nodes on enclosures; `slots` are the parameters and loop variables.
struct DualMachine {
  FunctionValue const& function;
  Dual* slots;

  Dual operand(Node const& node, std::uint32_t i) const {
    return run(function.operands[node.a + i]);
  }
  bool same(std::uint32_t a, std::uint32_t b) const {
    Node const &x = function.nodes[a], &y = function.nodes[b];
    if (a == b) return true;
    if (x.kind != y.kind) return false;
    if (x.kind == Kind::Parameter) return x.c == y.c;
    if (x.kind == Kind::Constant) return x.value == y.value;
    bool const pair = x.kind == Kind::Add || x.kind == Kind::Sub || x.kind == Kind::Mul;
    return pair && same(x.a, y.a) && same(x.b, y.b);
  }

  Dual run(std::uint32_t place) const {
    Node const& node = function.nodes[place];
    auto const a = [&] { return run(node.a); };
    auto const b = [&] { return run(node.b); };
    switch (node.kind) {
    case Kind::Constant:
      return {Interval(node.value), Interval(0)};
    case Kind::Parameter:
      return slots[node.c];
    case Kind::Add:
      return a() + b();
    case Kind::Sub:
      return a() - b();
    case Kind::Mul:
      return same(node.a, node.b) ? square(a()) : a() * b();
    case Kind::Div:
      return a() / b();
    case Kind::And:
    case Kind::Or:
    case Kind::Less:
    case Kind::LessEqual:
    case Kind::Equal:
    case Kind::NotEqual:
    case Kind::GreaterEqual:
    case Kind::Greater: {
      Interval const first = a().v;
      return compared(node.kind, first, b().v);
    }
    case Kind::Negate:
      return -a();
    case Kind::Builtin:
      return apply(node.c, operand(node, 0), node.b > 1 ? operand(node, 1) : Dual{});
    case Kind::Noise:
      return noise(2, slots[0], slots[1], slots[2]);
    case Kind::NoiseGenerator:
      return fixed(slots[3]) ? noise(static_cast<int>(slots[3].v.low), slots[0], slots[1], slots[2])
                             : Dual{{0, 1}, everything};
    case Kind::Ridged:
    case Kind::Hetero:
      return multifractal(node.kind);
    default:
      return run_call(node);
    }
  }

  static bool fixed(Dual const& x) { return x.v.low == x.v.high; }

  static Dual noise(int generator, Dual const& x, Dual const& y, Dual const& z) {
    Dual const* const place[3] = {&x, &y, &z};
    Vec3 middle, reach;
    for (int i = 0; i < 3; ++i) {
      middle[i] = place[i]->v.middle();
      reach[i] = std::max(place[i]->v.high - middle[i], middle[i] - place[i]->v.low);
    }
    if (!std::isfinite(middle.x + middle.y + middle.z)) return {{0, 1}, everything};
    texture::NoiseBounds const own = texture::noise_about(middle, reach, generator);
    Interval slope(0);
    for (int i = 0; i < 3; ++i) {
      bool const still = place[i]->d.low == 0 && place[i]->d.high == 0;
      if (!still) slope = slope + own.gradient[i] * place[i]->d;
    }
    return {own.value, slope};
  }

  Dual multifractal(Kind kind) const {
    for (int i = 3; i < 9; ++i)
      if (!fixed(slots[i])) return {everything, everything};
    auto const of_slot = [&](int i) { return slots[i].v.low; };
    Multifractal const of{of_slot(3), of_slot(4), of_slot(5), of_slot(6), of_slot(7)};
    auto const number = [](double value) { return Dual{Interval(value), Interval(0)}; };
    auto const octave = [&](Dual const& x, Dual const& y, Dual const& z) {
      return noise(static_cast<int>(of_slot(8)), x, y, z);
    };
    if (kind == Kind::Hetero) return of.hetero(slots[0], slots[1], slots[2], octave, number);
    auto const magnitude = [](Dual const& x) { return -lesser(x, -x); };
    auto const clamp = [&](Dual const& x) { return -lesser(-lesser(x, number(1)), number(0)); };
    return of.ridged(slots[0], slots[1], slots[2], octave, clamp, magnitude, number);
  }

  Dual run_call(Node const& node) const {
    switch (node.kind) {
    case Kind::Min:
    case Kind::Max: {
      Dual value = operand(node, 0);
      for (std::uint32_t i = 1; i < node.b; ++i)
        value = node.kind == Kind::Min ? lesser(value, operand(node, i))
                                       : -lesser(-value, -operand(node, i));
      return value;
    }
    case Kind::Select:
      return select(node);
    case Kind::Sum:
    case Kind::Product: {
      Dual const first = operand(node, 0), last = operand(node, 1);
      if (first.v.low != first.v.high || last.v.low != last.v.high) return {everything, everything};
      Dual total{Interval(node.kind == Kind::Sum ? 0 : 1), Interval(0)};
      for (double i = first.v.low; i <= last.v.low + eps; i += 1) {
        slots[node.c] = {Interval(i), Interval(0)};
        Dual const term = operand(node, 2);
        total = node.kind == Kind::Sum ? total + term : total * term;
      }
      return total;
    }
    default: {
      FunctionValue const& callee = *function.called[node.c];
      if (callee.block) return block(node, callee);
      std::array<Dual, 16> few;
      std::vector<Dual> many;
      std::size_t const size = std::max<std::size_t>(callee.slots, node.b);
      if (size > few.size()) many.resize(size);
      Dual* const place = size > few.size() ? many.data() : few.data();
      for (std::uint32_t i = 0; i < node.b; ++i) place[i] = operand(node, i);
      return DualMachine{callee, place}.run(static_cast<std::uint32_t>(callee.nodes.size() - 1));
    }
    }
  }

  /// Of what a block makes, only its bounds are known, and its value at a point.
  Dual block(Node const& node, FunctionValue const& callee) const {
    std::vector<double> arguments(node.b);
    for (std::uint32_t i = 0; i < node.b; ++i) {
      Dual const own = operand(node, i);
      constexpr double rounding = 0x1p-40; // of the place of one point of a line
      if (!(own.v.width() <= rounding * (1 + own.v.size())))
        return {{callee.least, callee.most}, everything};
      arguments[i] = own.v.middle();
    }
    return {at_point(take_part(callee.block(arguments), static_cast<int>(node.value))), everything};
  }

  Dual select(Node const& node) const {
    return selected(operand(node, 0).v, node.b == 3,
                    [&](std::uint32_t i) { return operand(node, i); });
  }
};

/// @param noise is bounded by its cells, as tapes have it
bool smooth_function(FunctionValue const& function, bool noise) {
  if (function.block) return false;
  for (Node const& node : function.nodes) {
    bool const step = node.kind >= Kind::And && node.kind <= Kind::Greater;
    bool const jump = node.kind == Kind::Select || (!noise && node.kind >= Kind::Noise);
    if (step || jump) return false;
  }
  for (auto const& called : function.called)
    if (!smooth_function(*called, noise)) return false;
  return true;
}

} // namespace

FunctionField::FunctionField(std::shared_ptr<FunctionValue const> function)
    : function_(std::move(function)),
      tape_(make_tape(*function_)),
      smooth_(smooth_function(*function_, tape_ != nullptr)) {}

double FunctionField::value(Vec3 const& point) const {
  double const arguments[3] = {point.x, point.y, point.z};
  return evaluate_function(*function_, arguments).c[0];
}

bool FunctionField::total() const {
  return tape_ && tape_->total;
}

int FunctionField::side_by_side() const {
  if (!tape_ || tape_->blocks) return 1;
  return tape_->noise ? LinePieces::most / 2 : LinePieces::most;
}

void FunctionField::along_each(Vec3 const& origin, Vec3 const& direction,
                               LinePieces& pieces) const {
  if (!tape_) return ScalarField::along_each(origin, direction, pieces);
  tape_->tape.along_each(origin, direction, pieces);
  if (std::isinf(most_slope_)) return;
  double const speed = most_slope_ * std::sqrt(glm::dot(direction, direction));
  for (int i = 0; i < pieces.count; ++i) {
    double const off = 0.5 * (pieces.high[i] - pieces.low[i]) * speed;
    double const low = std::max(pieces.value_low[i], pieces.middle_low[i] - off);
    double const high = std::min(pieces.value_high[i], pieces.middle_high[i] + off);
    if (!(low <= high)) continue; // the slope is steeper than was said
    pieces.value_low[i] = low;
    pieces.value_high[i] = high;
    pieces.slope_low[i] = -speed;
    pieces.slope_high[i] = speed;
  }
}

ScalarField::Along FunctionField::along(Vec3 const& origin, Vec3 const& direction,
                                        Interval const& part) const {
  Along const own = enclosure(origin, direction, part);
  if (std::isinf(most_slope_)) return own;
  // The slope bounds the values to both sides of the middle.
  double const speed = most_slope_ * std::sqrt(glm::dot(direction, direction));
  Interval const middle = at_point(value(origin + part.middle() * direction));
  double const off = 0.5 * part.width() * speed;
  double const low = std::max(own.value.low, middle.low - off);
  double const high = std::min(own.value.high, middle.high + off);
  if (!(low <= high)) return own; // the slope is steeper than was said
  return {{low, high}, {-speed, speed}};
}

ScalarField::Along FunctionField::enclosure(Vec3 const& origin, Vec3 const& direction,
                                            Interval const& part) const {
  if (function_->block) {
    if (part.low == part.high) return {at_point(value(origin + part.low * direction)), everything};
    return {{function_->least, function_->most}, everything};
  }
  if (tape_) {
    LinePieces one;
    one.count = 1;
    one.low[0] = part.low;
    one.high[0] = part.high;
    tape_->tape.along_each(origin, direction, one);
    return {{one.value_low[0], one.value_high[0]}, {one.slope_low[0], one.slope_high[0]}};
  }
  std::array<Dual, 16> few;
  std::vector<Dual> many;
  if (function_->slots > few.size()) many.resize(function_->slots);
  Dual* const slots = many.empty() ? few.data() : many.data();
  for (int i = 0; i < 3; ++i) {
    Interval const d(direction[i]);
    slots[i] = {d.low == 0 ? Interval(origin[i]) : Interval(origin[i]) + d * part, d};
  }
  Dual const result =
      DualMachine{*function_, slots}.run(static_cast<std::uint32_t>(function_->nodes.size() - 1));
  auto const sound = [](Interval const& x) { return x.low <= x.high ? x : everything; };
  return {sound(result.v), sound(result.d)};
}

namespace {

bool calls_block(FunctionValue const& function) {
  return function.block
         || std::ranges::any_of(function.called, [](auto const& own) { return calls_block(*own); });
}

} // namespace

std::shared_ptr<ScalarField const> FunctionField::with_slope(double most) const {
  if (!calls_block(*function_)) return nullptr;
  auto out = std::make_shared<FunctionField>(*this);
  out->most_slope_ = most;
  return out;
}

Vec3 FunctionField::gradient(Vec3 const& point) const {
  Vec3 result;
  for (int i = 0; i < 3; ++i) {
    Vec3 axis(0);
    axis[i] = 1;
    Interval const slope = along(point, axis, Interval(0)).slope;
    if (std::isfinite(slope.size()) && slope.width() <= 1e-6 * slope.size()) {
      result[i] = slope.middle();
      continue;
    }
    // A kink, a step or noise: the chord over some of the digits.
    double const h = 0x1p-20 * (1 + std::fabs(point[i]));
    result[i] = (value(point + h * axis) - value(point - h * axis)) / (2 * h);
  }
  return result;
}

} // namespace abbe::lang
