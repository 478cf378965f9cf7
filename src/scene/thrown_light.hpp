// SPDX-License-Identifier: MIT
#pragma once

#include "base/source.hpp"

#include <cstdint>

/// What a scene says about the light that glass and mirrors throw: `photons { }` and `caustics {
/// }`.
namespace abbe::scene {

enum class Choice : std::uint8_t { Unset, On, Off };

/// What an object does to light that is followed from a lamp.
struct Throws {
  bool target = false; ///< `photons { target }`: light is sent to it
  /// As POV-Ray has it: light goes on behind the surface where object or lamp says on and neither
  /// says off. Glass and mirrors of metal say on by themselves.
  Choice refraction = Choice::Unset, reflection = Choice::Unset;
  Choice cast = Choice::Unset; ///< `caustics { cast }`, which goes before all else
  bool collect = true;         ///< thrown light is seen on it
  bool pass_through = false;   ///< light goes straight through on its way to the first target
};

/// The same of a lamp.
struct LampThrows {
  Choice refraction = Choice::Unset, reflection = Choice::Unset;
};

struct ThrownLight {
  bool caustics = false; ///< a global `caustics` block: glass and mirrors of metal throw light
  bool photons = false;  ///< a global `photons` block: so do objects that say so
  double error = 0.01;   ///< share of the thrown light that may be missing
  bool exact = false;    ///< `evaluate exact`: without interpolation between the lamp's rays
  int max_trace_level = 16;
  double adc_bailout = 1.0 / 4096;
};

} // namespace abbe::scene
