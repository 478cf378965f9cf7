// SPDX-License-Identifier: MIT
#include "lang/function_tape.hpp"

#include "lang/block_function.hpp"
#include "lang/dual_logic.hpp"
#include "lang/float_functions.hpp"
#include "lang/multifractal.hpp"
#include "texture/noise_bounds.hpp"
#include "texture/pattern.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>
#include <tuple>

namespace abbe::lang {
namespace {

using field::Enclosures;
using field::Tape;
using Op = Tape::Op;
using Node = FunctionValue::Node;
using Kind = Node::Kind;
constexpr double eps = 1e-10; ///< that of the ends of sums, as in function.cpp
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

void put(Enclosures& out, int i, Dual const& own) {
  auto const sound = [](Interval const& x) { return x.low <= x.high ? x : Interval::everything(); };
  Interval const v = sound(own.v), d = sound(own.d);
  out.v_low[i] = v.low;
  out.v_high[i] = v.high;
  out.d_low[i] = d.low;
  out.d_high[i] = d.high;
}
void put_middle(Enclosures& out, int i, double value, double off) {
  out.c[i] = value;
  out.e[i] = off;
}
Interval values(Enclosures const& of, int i) {
  return {of.v_low[i], of.v_high[i]};
}

/// What is carried out on one enclosure after the other, first of the piece, then of its middle.
template <class F>
class DualCall final : public field::TapeCall {
public:
  DualCall(F f, std::size_t operands) : f_(std::move(f)), operands_(operands) {}
  void run(Enclosures const* const* operands, double const*, int count,
           Enclosures& out) const override {
    std::array<Dual, 16> piece, middle;
    for (int i = 0; i < count; ++i) {
      for (std::size_t k = 0; k < operands_; ++k) {
        Enclosures const& own = *operands[k];
        piece[k] = {values(own, i), {own.d_low[i], own.d_high[i]}};
        double const c = own.c[i], e = own.e[i] + 0x1p-52 * std::fabs(c);
        middle[k] = {own.e[i] == 0 ? Interval(c) : Interval(c - e, c + e), Interval(0)};
      }
      put(out, i, f_(piece.data()));
      Interval const here = f_(middle.data()).v;
      double const value = here.low == here.high ? here.low : here.middle();
      double const off = (here.high - value) * (1 + 0x1p-50) + 0x1p-52 * std::fabs(value);
      put_middle(out, i, value, here.low == here.high ? 0 : off);
    }
  }

private:
  F f_;
  std::size_t operands_;
};

class NoiseCall final : public field::TapeCall {
public:
  explicit NoiseCall(int generator) : generator_(generator) {}
  void run(Enclosures const* const* operands, double const*, int count,
           Enclosures& out) const override {
    for (int i = 0; i < count; ++i) {
      Vec3 at, reach;
      double off = 0x1p-44;
      Interval rate[3];
      for (int axis = 0; axis < 3; ++axis) {
        Enclosures const& own = *operands[axis];
        at[axis] = own.c[i];
        reach[axis] = std::max(own.v_high[i] - own.c[i], own.c[i] - own.v_low[i]);
        rate[axis] = {own.d_low[i], own.d_high[i]};
        off += texture::noise_slope(generator_) * own.e[i];
      }
      if (!std::isfinite(at.x + at.y + at.z)) {
        put(out, i, {{0, 1}, Interval::everything()});
        put_middle(out, i, nothing, 0);
        continue;
      }
      texture::NoiseBounds const own = texture::noise_about(at, reach, generator_);
      Interval slope(0);
      for (int axis = 0; axis < 3; ++axis) {
        bool const still = rate[axis].low == 0 && rate[axis].high == 0;
        if (!still) slope = slope + own.gradient[axis] * rate[axis];
      }
      put(out, i, {own.value, slope});
      put_middle(out, i, own.at, off);
    }
  }

private:
  int generator_;
};

/// Of what a block makes, only its bounds are known, and its value at a point.
class BlockCall final : public field::TapeCall {
public:
  BlockCall(std::shared_ptr<FunctionValue const> function, std::size_t operands, int part)
      : function_(std::move(function)), operands_(operands), part_(part) {}
  void run(Enclosures const* const* operands, double const*, int count,
           Enclosures& out) const override {
    std::array<double, 16> arguments;
    for (int i = 0; i < count; ++i) {
      bool narrow = true;
      for (std::size_t k = 0; k < operands_; ++k) {
        Interval const own = values(*operands[k], i);
        constexpr double rounding = 0x1p-40; // of the place of one point of a line
        narrow = narrow && own.width() <= rounding * (1 + own.size());
        arguments[k] = operands[k]->c[i];
      }
      double const value = take_part(function_->block({arguments.data(), operands_}), part_);
      Interval const here = at_point(value);
      put(out, i,
          {narrow ? here : Interval{function_->least, function_->most}, Interval::everything()});
      put_middle(out, i, value, 0.5 * here.width());
    }
  }

private:
  std::shared_ptr<FunctionValue const> function_;
  std::size_t operands_;
  int part_;
};

/// Writes a tape; all of it is for the nodes of functions and for numbers on the way.
struct Writer {
  explicit Writer(FunctionTape& out) : out_(out), tape_(out.tape) {}

  struct Place {
    Writer* writer;
    std::uint32_t at;
    friend Place operator+(Place a, Place b) { return a.writer->sum(a, b); }
    friend Place operator-(Place a) { return a.writer->scaled(a, -1); }
    friend Place operator-(Place a, Place b) { return a.writer->difference(a, b); }
    friend Place operator*(Place a, Place b) { return a.writer->product(a, b); }
  };
  struct TooLong {};

  Place number(double value) { return emit({Op::Constant, 0, 0, 0, value}); }

  Place write(FunctionValue const& function, std::vector<Place> slots) {
    slots.resize(std::max(slots.size(), function.slots), number(0));
    return Body{*this, function, slots}.run(static_cast<std::uint32_t>(function.nodes.size() - 1));
  }
  Place parameter(std::uint32_t axis) { return emit({Op::Parameter, axis, 0, 0, 0}); }

  /// The last step is the result.
  void end(Place result) {
    if (result.at + 1 == tape_.steps.size()) return;
    Tape::Step const add{Op::AddConstant, result.at, 0, 0, 0};
    tape_.steps.push_back(add);
  }

  /// The nodes of one function.
  struct Body {
    Writer& writer;
    FunctionValue const& function;
    std::vector<Place>& slots;

    Place operand(Node const& node, std::uint32_t i) const {
      return run(function.operands[node.a + i]);
    }
    std::vector<Place> operands(Node const& node) const {
      std::vector<Place> out;
      for (std::uint32_t i = 0; i < node.b; ++i) out.push_back(operand(node, i));
      return out;
    }
    Place run(std::uint32_t place) const;
    Place run_call(Node const& node) const;
    Place multifractal(Kind kind) const;
    Place loop(Node const& node) const;
  };

  bool constant(Place a) const { return tape_.steps[a.at].op == Op::Constant; }
  double value(Place a) const { return tape_.steps[a.at].value; }
  Place sum(Place a, Place b) {
    if (constant(a) && constant(b)) return number(value(a) + value(b));
    if (constant(a)) std::swap(a, b);
    if (constant(b)) return value(b) == 0 ? a : emit({Op::AddConstant, a.at, 0, 0, value(b)});
    return emit({Op::Add, a.at, b.at, 0, 0});
  }
  Place difference(Place a, Place b) {
    if (constant(a) && constant(b)) return number(value(a) - value(b));
    if (constant(b)) return sum(a, number(-value(b)));
    if (constant(a)) return sum(scaled(b, -1), a);
    return emit({Op::Sub, a.at, b.at, 0, 0});
  }
  Place scaled(Place a, double k) {
    if (constant(a)) return number(value(a) * k);
    return k == 1 ? a : emit({Op::MulConstant, a.at, 0, 0, k});
  }
  Place product(Place a, Place b) {
    if (constant(b)) return scaled(a, value(b));
    if (constant(a)) return scaled(b, value(a));
    if (a.at == b.at) return emit({Op::Square, a.at, 0, 0, 0});
    return emit({Op::Mul, a.at, b.at, 0, 0});
  }
  Place quotient(Place a, Place b) {
    if (constant(a) && constant(b)) return number(value(a) / value(b));
    if (constant(b)) {
      int exponent = 0;
      double const size = std::fabs(value(b));
      if (std::frexp(size, &exponent) == 0.5 && size > 1e-100 && size < 1e100)
        return scaled(a, 1 / value(b));
    }
    if (!constant(b) || value(b) == 0) out_.total = false;
    return emit({Op::Div, a.at, b.at, 0, 0});
  }
  Place builtin(std::size_t which, std::vector<Place> const& own);
  Place call(std::shared_ptr<field::TapeCall const> what, std::vector<Place> const& operands) {
    if (operands.size() > 16) throw TooLong{};
    Tape::Step step{Op::Call, static_cast<std::uint32_t>(tape_.calls.size()),
                    static_cast<std::uint32_t>(operands.size()),
                    static_cast<std::uint32_t>(tape_.operands.size()), 0};
    tape_.calls.push_back(std::move(what));
    for (Place const& own : operands) tape_.operands.push_back(own.at);
    tape_.steps.push_back(step);
    if (tape_.steps.size() > Tape::most_steps) throw TooLong{};
    return {this, static_cast<std::uint32_t>(tape_.steps.size() - 1)};
  }
  template <class F>
  Place each(F f, std::vector<Place> const& operands) {
    return call(std::make_shared<DualCall<F>>(std::move(f), operands.size()), operands);
  }
  Place noise(Place x, Place y, Place z, int generator) {
    out_.noise = true;
    return call(std::make_shared<NoiseCall>(generator), {x, y, z});
  }
  /// A step that is there already is not taken twice.
  Place emit(Tape::Step const& step) {
    auto const key = std::tuple(step.op, step.a, step.b, std::bit_cast<std::uint64_t>(step.value));
    auto const [known, fresh] =
        known_.try_emplace(key, static_cast<std::uint32_t>(tape_.steps.size()));
    if (fresh) tape_.steps.push_back(step);
    if (tape_.steps.size() > Tape::most_steps) throw TooLong{};
    return {this, known->second};
  }
  /// Is it nowhere below zero, as far as the steps tell?
  bool positive(Place a) const {
    Tape::Step const& step = tape_.steps[a.at];
    auto const of = [&](std::uint32_t at) { return positive({nullptr, at}); };
    switch (step.op) {
    case Op::Constant:
      return step.value >= 0;
    case Op::Square:
    case Op::Abs:
    case Op::Sqrt:
    case Op::Exp:
      return true;
    case Op::Power:
      return std::fmod(step.value, 2) == 0 || of(step.a);
    case Op::AddConstant:
    case Op::MulConstant:
      return step.value >= 0 && of(step.a);
    case Op::Add:
    case Op::Mul:
    case Op::Div:
    case Op::Min:
      return of(step.a) && of(step.b);
    case Op::Max:
      return of(step.a) || of(step.b);
    default:
      return false;
    }
  }

  FunctionTape& out_;
  Tape& tape_;
  std::map<std::tuple<Op, std::uint32_t, std::uint32_t, std::uint64_t>, std::uint32_t> known_;
};

Writer::Place Writer::builtin(std::size_t which, std::vector<Place> const& own) {
  FloatFunction const& function = float_functions()[which];
  std::string_view const name = function.name;
  bool fixed = true;
  for (Place const& one : own) fixed = fixed && constant(one);
  if (fixed) return number(function.compute(value(own[0]), own.size() > 1 ? value(own[1]) : 0));
  auto const one = [&](Op op) { return emit({op, own[0].at, 0, 0, 0}); };
  if (name == "abs") return one(Op::Abs);
  if (name == "sqr") return one(Op::Square);
  if (name == "sin") return one(Op::Sin);
  if (name == "cos") return one(Op::Cos);
  if (name == "exp") return one(Op::Exp);
  if (name == "radians") return scaled(own[0], 3.14159265358979323846 / 180);
  if (name == "degrees") return scaled(own[0], 180 / 3.14159265358979323846);
  if (name == "sqrt") {
    out_.total = out_.total && positive(own[0]);
    return one(Op::Sqrt);
  }
  if (name == "atan2") return emit({Op::Atan2, own[0].at, own[1].at, 0, 0});
  if (name == "pow" && constant(own[1])) {
    double const n = value(own[1]);
    if (n == 2) return one(Op::Square);
    if (n >= 3 && n <= 16 && n == std::floor(n)) return emit({Op::Power, own[0].at, 0, 0, n});
    out_.total = out_.total && n >= 0 && (positive(own[0]) || n == std::floor(n));
  } else {
    constexpr std::string_view everywhere[] = {"asinh", "atan", "ceil", "cosh", "floor",
                                               "int",   "sinh", "tan",  "tanh"};
    out_.total = out_.total && std::ranges::find(everywhere, name) != std::end(everywhere);
  }
  bool const two = own.size() > 1;
  bool const rooted = name == "pow";
  auto const one_by_one = [which, two, rooted](Dual const* of) {
    Dual out = apply(which, of[0], two ? of[1] : Dual{});
    // Undefined below zero, and what is made of it need not be continuous.
    if (rooted && of[0].v.low < 0) out.d = Interval::everything();
    return out;
  };
  return each(one_by_one, own);
}

Writer::Place Writer::Body::run(std::uint32_t place) const {
  Node const& node = function.nodes[place];
  switch (node.kind) {
  case Kind::Constant:
    return writer.number(node.value);
  case Kind::Parameter:
    return slots[node.c];
  case Kind::Add:
    return run(node.a) + run(node.b);
  case Kind::Sub:
    return run(node.a) - run(node.b);
  case Kind::Mul:
    return run(node.a) * run(node.b);
  case Kind::Div:
    return writer.quotient(run(node.a), run(node.b));
  case Kind::Negate:
    return -run(node.a);
  case Kind::Builtin:
    return writer.builtin(node.c, operands(node));
  case Kind::Noise:
    return writer.noise(slots[0], slots[1], slots[2], 2);
  case Kind::NoiseGenerator:
    if (!writer.constant(slots[3])) throw TooLong{};
    return writer.noise(slots[0], slots[1], slots[2], static_cast<int>(writer.value(slots[3])));
  case Kind::Ridged:
  case Kind::Hetero:
    return multifractal(node.kind);
  case Kind::And:
  case Kind::Or:
  case Kind::Less:
  case Kind::LessEqual:
  case Kind::Equal:
  case Kind::NotEqual:
  case Kind::GreaterEqual:
  case Kind::Greater: {
    auto const compare = [kind = node.kind](Dual const* of) {
      return compared(kind, of[0].v, of[1].v);
    };
    return writer.each(compare, {run(node.a), run(node.b)});
  }
  default:
    return run_call(node);
  }
}

Writer::Place Writer::Body::multifractal(Kind kind) const {
  for (std::size_t i = 3; i < 9; ++i)
    if (!writer.constant(slots[i])) throw TooLong{};
  auto const of_slot = [&](std::size_t i) { return writer.value(slots[i]); };
  Multifractal const of{of_slot(3), of_slot(4), of_slot(5), of_slot(6), of_slot(7)};
  auto const number = [&](double value) { return writer.number(value); };
  auto const octave = [&](Place x, Place y, Place z) {
    return writer.noise(x, y, z, static_cast<int>(of_slot(8)));
  };
  if (kind == Kind::Hetero) return of.hetero(slots[0], slots[1], slots[2], octave, number);
  auto const magnitude = [&](Place x) { return writer.emit({Op::Abs, x.at, 0, 0, 0}); };
  auto const clamp = [&](Place x) {
    Place const most = writer.emit({Op::Min, x.at, number(1).at, 0, 0});
    return writer.emit({Op::Max, most.at, number(0).at, 0, 0});
  };
  return of.ridged(slots[0], slots[1], slots[2], octave, clamp, magnitude, number);
}

Writer::Place Writer::Body::loop(Node const& node) const {
  Place const first = operand(node, 0), last = operand(node, 1);
  if (!writer.constant(first) || !writer.constant(last)) throw TooLong{};
  Place total = writer.number(node.kind == Kind::Sum ? 0 : 1);
  double const from = writer.value(first), to = writer.value(last);
  if (!(to - from < static_cast<double>(Tape::most_steps))) throw TooLong{};
  for (double i = from; i <= to + eps; i += 1) {
    slots[node.c] = writer.number(i);
    Place const term = operand(node, 2);
    total = node.kind == Kind::Sum ? total + term : total * term;
  }
  return total;
}

Writer::Place Writer::Body::run_call(Node const& node) const {
  switch (node.kind) {
  case Kind::Min:
  case Kind::Max: {
    Op const op = node.kind == Kind::Min ? Op::Min : Op::Max;
    Place out = operand(node, 0);
    for (std::uint32_t i = 1; i < node.b; ++i)
      out = writer.emit({op, out.at, operand(node, i).at, 0, 0});
    return out;
  }
  case Kind::Select: {
    Place const which = operand(node, 0);
    bool const pair = node.b == 3;
    if (writer.constant(which)) { // the branch that is taken is all there is
      double const value = writer.value(which);
      return operand(node, value < 0 ? 1 : pair || value == 0 ? 2 : 3);
    }
    auto const choose = [pair](Dual const* of) {
      return selected(of[0].v, pair, [&](std::uint32_t i) { return of[i]; });
    };
    return writer.each(choose, operands(node));
  }
  case Kind::Sum:
  case Kind::Product:
    return loop(node);
  default: {
    auto const& callee = function.called[node.c];
    if (!callee->block) return writer.write(*callee, operands(node));
    writer.out_.blocks = true;
    return writer.call(std::make_shared<BlockCall>(callee, node.b, static_cast<int>(node.value)),
                       operands(node));
  }
  }
}

} // namespace

std::shared_ptr<FunctionTape const> make_tape(FunctionValue const& function) {
  if (function.block || !function.unsupported.empty() || function.parameters != 3) return nullptr;
  auto out = std::make_shared<FunctionTape>();
  Writer writer(*out);
  try {
    writer.end(
        writer.write(function, {writer.parameter(0), writer.parameter(1), writer.parameter(2)}));
  } catch (Writer::TooLong const&) {
    return nullptr;
  }
  return out;
}

} // namespace abbe::lang
