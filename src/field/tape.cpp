// SPDX-License-Identifier: MIT
#include "field/tape.hpp"

#include "field/lane_enclosure.hpp"
#include "simd/native.hpp"

#include <algorithm>

namespace abbe::field {

namespace {

constexpr std::size_t lanes = Enclosures::lanes;

struct Line {
  double origin[3], direction[3];
};

template <class L>
Known<L> load(Enclosures const& from, std::size_t at) {
  auto const of = [at](double const* places) { return lane::load<L>(places + at); };
  return {
      {of(from.v_low), of(from.v_high)}, {of(from.d_low), of(from.d_high)}, of(from.c), of(from.e)};
}
template <class L>
void store(Enclosures& to, std::size_t at, Known<L> const& known) {
  lane::store(to.v_low + at, known.v.low);
  lane::store(to.v_high + at, known.v.high);
  lane::store(to.d_low + at, known.d.low);
  lane::store(to.d_high + at, known.d.high);
  lane::store(to.c + at, known.c);
  lane::store(to.e + at, known.e);
}

template <class L>
Known<L> constant(double value) {
  return {{L(value), L(value)}, {L(0.0), L(0.0)}, L(value), L(0.0)};
}

/// A coordinate along the line.
template <class L>
Known<L> parameter(double from, double speed, LinePieces const& pieces, std::size_t at) {
  if (speed == 0) return constant<L>(from);
  L const low = lane::load<L>(pieces.low + at), high = lane::load<L>(pieces.high + at);
  L const origin(from), rate(speed), way = rate * (L(0.5) * low + L(0.5) * high);
  L const a = rate * low, b = rate * high, first = speed < 0 ? b : a, last = speed < 0 ? a : b;
  // The place itself is rounded too.
  L const off = L(2 * ulp) * (lane::abs(origin) + lane::max(lane::abs(a), lane::abs(b)));
  return {{origin + first - off, origin + last + off},
          {rate, rate},
          origin + way,
          L(2 * ulp) * (lane::abs(origin) + lane::abs(way))};
}

struct Carry {
  template <class L>
  static void run(Tape const& tape, Line const& line, LinePieces& pieces, double const* half,
                  Enclosures* known) {
    auto const count = static_cast<std::size_t>(pieces.count);
    for (std::size_t i = 0; i < tape.steps.size(); ++i) {
      Tape::Step const& step = tape.steps[i];
      if (step.op == Tape::Op::Call) {
        call(tape, step, half, pieces.count, known, known[i]);
        continue;
      }
      lane::in_lanes<L>(count, [&]<class V>(std::size_t at) {
        store<V>(known[i], at, carried<V>(step, line, pieces, half, known, at));
      });
    }
    lane::in_lanes<L>(count, [&]<class V>(std::size_t at) {
      Known<V> const out = load<V>(known[tape.steps.size() - 1], at);
      lane::store(pieces.value_low + at, out.v.low);
      lane::store(pieces.value_high + at, out.v.high);
      lane::store(pieces.slope_low + at, out.d.low);
      lane::store(pieces.slope_high + at, out.d.high);
      V const off = out.e + V(ulp) * lane::abs(out.c);
      lane::store(pieces.middle_low + at, out.c - off);
      lane::store(pieces.middle_high + at, out.c + off);
    });
  }

  template <class L>
  static Known<L> carried(Tape::Step const& step, Line const& line, LinePieces const& pieces,
                          double const* half, Enclosures const* known, std::size_t at) {
    using Op = Tape::Op;
    auto const a = [&] { return load<L>(known[step.a], at); };
    auto const b = [&] { return load<L>(known[step.b], at); };
    L const h = lane::load<L>(half + at);
    switch (step.op) {
    case Op::Constant:
      return constant<L>(step.value);
    case Op::Parameter:
      return parameter<L>(line.origin[step.a], line.direction[step.a], pieces, at);
    case Op::Add:
      return centred(sum(a(), b()), h);
    case Op::Sub:
      return centred(sum(a(), negative(b())), h);
    case Op::Mul:
      return centred(product(a(), b()), h);
    case Op::Div:
      return centred(quotient(a(), b()), h);
    case Op::AddConstant:
      return sum(a(), step.value);
    case Op::MulConstant:
      return product(a(), step.value);
    case Op::Square:
      return centred(squared(a()), h);
    case Op::Abs:
      return magnitude(a());
    case Op::Sqrt:
      return centred(root(a()), h);
    case Op::Sin:
      return centred(sine(a(), false), h);
    case Op::Cos:
      return centred(sine(a(), true), h);
    case Op::Exp:
      return centred(power_of_e(a()), h);
    case Op::Power:
      return centred(whole_power(a(), static_cast<int>(step.value)), h);
    case Op::Atan2:
      return centred(angle(a(), b()), h);
    case Op::Min:
      return chosen(a(), b(), true);
    case Op::Max:
      return chosen(a(), b(), false);
    case Op::Call:
      break;
    }
    return constant<L>(0);
  }

  static void call(Tape const& tape, Tape::Step const& step, double const* half, int count,
                   Enclosures const* known, Enclosures& out);
};

simd::Native<Carry> const carry;

__attribute__((noinline)) void Carry::call(Tape const& tape, Tape::Step const& step,
                                           double const* half, int count, Enclosures const* known,
                                           Enclosures& out) {
  Enclosures const* operands[16];
  for (std::uint32_t k = 0; k < step.b; ++k) operands[k] = known + tape.operands[step.first + k];
  tape.calls[step.a]->run(operands, half, count, out);
}

} // namespace

void Tape::along_each(Vec3 const& origin, Vec3 const& direction, LinePieces& pieces) const {
  thread_local std::vector<Enclosures> known;
  if (known.size() < steps.size()) known.resize(steps.size());
  Line const line{{origin.x, origin.y, origin.z}, {direction.x, direction.y, direction.z}};
  alignas(64) double half[lanes];
  for (std::size_t i = 0; i < lanes; ++i) {
    std::size_t const k = std::min(i, static_cast<std::size_t>(pieces.count - 1));
    pieces.low[i] = pieces.low[k];
    pieces.high[i] = pieces.high[k];
    half[i] = (pieces.high[i] - pieces.low[i]) * (0.5 * (1 + 2 * ulp));
  }
  carry(*this, line, pieces, half, known.data());
}

} // namespace abbe::field
