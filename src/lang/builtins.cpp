// SPDX-License-Identifier: MIT
#include "lang/builtins.hpp"

#include "lang/interpreter.hpp"

#include <chrono>

namespace abbe::lang {

std::array<std::string_view, static_cast<std::size_t>(Constant::Count)> const constant_names = {
    "",
    "x",
    "y",
    "z",
    "u",
    "v",
    "t",
    "pi",
    "true",
    "yes",
    "on",
    "false",
    "no",
    "off",
    "clock",
    "clock_delta",
    "clock_on",
    "frame_number",
    "initial_frame",
    "final_frame",
    "initial_clock",
    "final_clock",
    "image_width",
    "image_height",
    "version",
    "now"};

namespace {

Numeric axis(std::uint8_t size, std::size_t place) {
  Numeric n;
  n.size = size;
  n.c[place] = 1;
  return n;
}

/// Days since the start of the year 2000, UTC.
double days_since_2000() {
  auto const since_1970 = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration<double>(since_1970).count() / 86400 - 10957;
}

} // namespace

Numeric constant(Constant which, Interpreter& in) {
  AnimationFrame const& frame = in.options().frame;
  switch (which) {
  case Constant::X:
    return axis(3, 0);
  case Constant::Y:
    return axis(3, 1);
  case Constant::Z:
    return axis(3, 2);
  case Constant::U:
    return axis(2, 0);
  case Constant::V:
    return axis(2, 1);
  case Constant::T:
    return axis(4, 3);
  case Constant::Pi:
    return scalar_of(3.14159265358979323846);
  case Constant::True:
  case Constant::Yes:
  case Constant::On:
    return scalar_of(1);
  case Constant::Clock:
    return scalar_of(frame.clock);
  case Constant::ClockDelta:
    return scalar_of(frame.clock_delta);
  case Constant::ClockOn:
    return scalar_of(frame.clock_on ? 1 : 0);
  case Constant::FrameNumber:
    return scalar_of(frame.number);
  case Constant::InitialFrame:
    return scalar_of(frame.initial_frame);
  case Constant::FinalFrame:
    return scalar_of(frame.final_frame);
  case Constant::InitialClock:
    return scalar_of(frame.initial_clock);
  case Constant::FinalClock:
    return scalar_of(frame.final_clock);
  case Constant::ImageWidth:
    return scalar_of(in.options().image_width);
  case Constant::ImageHeight:
    return scalar_of(in.options().image_height);
  case Constant::Version:
    return scalar_of(in.version);
  case Constant::Now:
    return scalar_of(days_since_2000());
  default:
    return scalar_of(0); // no, off, false
  }
}

std::span<Builtin const> builtins() {
  static std::vector<Builtin> const all = [] {
    std::vector<Builtin> functions;
    for (auto part : {float_builtins(), vector_builtins(), string_builtins(), scene_builtins()})
      functions.insert(functions.end(), part.begin(), part.end());
    return functions;
  }();
  return all;
}

Builtin const* find_builtin(Symbol symbol) {
  auto const all = builtins();
  if (symbol < first_builtin || symbol - first_builtin >= all.size()) return nullptr;
  return &all[symbol - first_builtin];
}

} // namespace abbe::lang
