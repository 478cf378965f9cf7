// SPDX-License-Identifier: MIT
#include "field/tape.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace abbe::field {
namespace {

using Op = Tape::Op;

/// What a tape makes of one point, by doubles.
double value(Tape const& tape, Vec3 const& p) {
  std::vector<double> v;
  for (Tape::Step const& s : tape.steps) {
    double const a = s.op == Op::Constant || s.op == Op::Parameter ? 0 : v[s.a];
    auto const b = [&] { return v[s.b]; };
    switch (s.op) {
    case Op::Constant:
      v.push_back(s.value);
      break;
    case Op::Parameter:
      v.push_back(p[static_cast<int>(s.a)]);
      break;
    case Op::Add:
      v.push_back(a + b());
      break;
    case Op::Sub:
      v.push_back(a - b());
      break;
    case Op::Mul:
      v.push_back(a * b());
      break;
    case Op::Div:
      v.push_back(a / b());
      break;
    case Op::AddConstant:
      v.push_back(a + s.value);
      break;
    case Op::MulConstant:
      v.push_back(a * s.value);
      break;
    case Op::Square:
      v.push_back(a * a);
      break;
    case Op::Abs:
      v.push_back(std::fabs(a));
      break;
    case Op::Sqrt:
      v.push_back(std::sqrt(a));
      break;
    case Op::Sin:
      v.push_back(std::sin(a));
      break;
    case Op::Cos:
      v.push_back(std::cos(a));
      break;
    case Op::Exp:
      v.push_back(std::exp(a));
      break;
    case Op::Power:
      v.push_back(std::pow(a, s.value));
      break;
    case Op::Atan2:
      v.push_back(std::atan2(a, b()));
      break;
    case Op::Min:
      v.push_back(a < b() ? a : b());
      break;
    case Op::Max:
      v.push_back(a < b() ? b() : a);
      break;
    case Op::Call:
      ADD_FAILURE();
      break;
    }
  }
  return v.back();
}

class Dice {
public:
  explicit Dice(unsigned seed) : engine_(seed) {}
  double number(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  int below(std::size_t n) {
    return std::uniform_int_distribution<int>(0, static_cast<int>(n) - 1)(engine_);
  }

private:
  std::mt19937 engine_;
};

/// x, y, z and what some operations make of them; `last` is the last.
Tape tape_of(Dice& dice, Op last, int size) {
  Tape tape;
  for (std::uint32_t axis = 0; axis < 3; ++axis)
    tape.steps.push_back({Op::Parameter, axis, 0, 0, 0});
  tape.steps.push_back({Op::Constant, 0, 0, 0, dice.number(-2, 2)});
  constexpr Op ops[] = {Op::Add, Op::Sub,  Op::Mul, Op::AddConstant, Op::MulConstant, Op::Square,
                        Op::Abs, Op::Sqrt, Op::Sin, Op::Cos,         Op::Min,         Op::Max};
  for (int i = 0; i <= size; ++i) {
    Op const op = i == size ? last : ops[dice.below(std::size(ops))];
    auto const before = tape.steps.size();
    auto const own = [&] { return static_cast<std::uint32_t>(dice.below(before)); };
    double const number = op == Op::Power ? 3 + dice.below(6) : dice.number(-2, 2);
    tape.steps.push_back(
        {op, i == size ? static_cast<std::uint32_t>(before - 1) : own(), own(), 0, number});
  }
  return tape;
}

bool within(double low, double high, double x, double room) {
  return low - room <= x && x <= high + room;
}

/// Values of the piece, the value in the middle and slopes, for each operation behind some others.
TEST(Tape, EnclosuresHoldValuesAndSlopes) {
  constexpr Op all[] = {Op::Add,    Op::Sub, Op::Mul,  Op::Div,  Op::AddConstant, Op::MulConstant,
                        Op::Square, Op::Abs, Op::Sqrt, Op::Sin,  Op::Cos,         Op::Exp,
                        Op::Power,  Op::Min, Op::Max,  Op::Atan2};
  Dice dice(1);
  for (Op const op : all) {
    int useful = 0;
    for (int round = 0; round < 300; ++round) {
      Tape const tape = tape_of(dice, op, round % 6);
      Vec3 const origin(dice.number(-1, 1), dice.number(-1, 1), dice.number(-1, 1));
      Vec3 direction(dice.number(-1, 1), dice.number(-1, 1), dice.number(-1, 1));
      if (round % 5 == 0) direction[round % 3] = 0;
      LinePieces pieces;
      pieces.count = 1 + round % LinePieces::most;
      double const width = std::exp2(-dice.number(0, 16));
      for (int i = 0; i < pieces.count; ++i) {
        pieces.low[i] = width * i;
        pieces.high[i] = width * (i + 1);
      }
      tape.along_each(origin, direction, pieces);
      auto const at = [&](double t) { return value(tape, origin + t * direction); };
      for (int i = 0; i < pieces.count; ++i) {
        double const middle = 0.5 * pieces.low[i] + 0.5 * pieces.high[i], here = at(middle);
        if (!std::isfinite(here)) continue;
        double const room = 1e-15 * (1 + std::fabs(here));
        EXPECT_TRUE(within(pieces.middle_low[i], pieces.middle_high[i], here, room))
            << static_cast<int>(op) << " " << round;
        for (int k = 0; k <= 8; ++k) {
          double const there = at(pieces.low[i] + width * k / 8);
          if (std::isfinite(there)) {
            EXPECT_TRUE(within(pieces.value_low[i], pieces.value_high[i], there, room))
                << static_cast<int>(op) << " " << round << " " << there;
          }
        }
        // A chord's slope is that of some place of the piece, if the function is defined there.
        double const first = at(pieces.low[i]), last = at(pieces.high[i]);
        if (!std::isfinite(first + last)) continue;
        double const chord = (last - first) / width, off = 1e-14 * (1 + std::fabs(first)) / width;
        EXPECT_TRUE(within(pieces.slope_low[i], pieces.slope_high[i], chord, off))
            << static_cast<int>(op) << " " << round << " " << chord;
        useful += pieces.slope_low[i] > 0 || pieces.slope_high[i] < 0 ? 1 : 0;
      }
    }
    EXPECT_GT(useful, 100) << static_cast<int>(op);
  }
}

/// x (1 - x) with both factors apart: how far the enclosure is off shrinks with the square.
TEST(Tape, EnclosuresShrinkWithTheSquareOfThePiece) {
  Tape tape;
  tape.steps = {{Op::Parameter, 0, 0, 0, 0},
                {Op::MulConstant, 0, 0, 0, -1},
                {Op::AddConstant, 1, 0, 0, 1},
                {Op::Mul, 0, 2, 0, 0}};
  for (double const width : {1e-1, 1e-2, 1e-3}) {
    LinePieces pieces;
    pieces.count = 1;
    pieces.low[0] = .3;
    pieces.high[0] = .3 + width;
    tape.along_each(Vec3(0), Vec3(1, 0, 0), pieces);
    double const wanted = .4 * width;
    EXPECT_NEAR(pieces.value_high[0] - pieces.value_low[0], wanted, 4 * width * width);
    EXPECT_NEAR(pieces.slope_high[0] - pieces.slope_low[0], 2 * width, 1e-12);
  }
}

} // namespace
} // namespace abbe::field
