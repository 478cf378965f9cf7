// SPDX-License-Identifier: MIT
#pragma once

#include "transport/emitter.hpp"

#include <vector>

namespace abbe::transport {

/// `reflection { exponent }`: the reflected light itself is raised to a power. What a mirrored ray
/// brings is gathered in a block of the film of its own, with the mirror's weight taken as one, and
/// bent when all of it is there.
class Captures {
public:
  Captures(Stage const& stage, WaveTables& waves, SampleFilm& film, Emitter& emitter, Paths& paths)
      : stage_(stage), waves_(waves), film_(film), emitter_(emitter), paths_(paths) {}

  void start() { captures_.clear(); }
  /// @param weights of the mirror, a value a lane @param channels of its lanes
  /// @return the slot of the first lane, which the ray is to bring its light to
  std::uint32_t add(LightKind const& kind, std::uint32_t slot, std::uint16_t const* channels,
                    double const* weights, double exponent, std::uint32_t path);
  /// All light has arrived: bends it, what was mirrored last first.
  void resolve();

private:
  struct Capture {
    LightKind kind;
    std::uint32_t slot;  ///< where the bent light goes
    std::uint32_t inner; ///< where it was gathered
    double exponent;
    std::vector<double> weights;
    std::vector<std::uint16_t> channels;
    std::uint32_t path;
  };
  /// Where light of a lane of a picking comb goes once it is picked.
  struct Picked {
    std::uint32_t from = 0; ///< slots, counted from the first of a block
    double weight = 1;      ///< 1 / probability
    bool counts = true;     ///< this tooth was picked, or all are (control light)
    bool any = false;
  };
  Picked pick_of(Capture const& capture, std::size_t lane);
  void resolve(Capture const& capture);

  Stage const& stage_;
  WaveTables& waves_;
  SampleFilm& film_;
  Emitter& emitter_;
  Paths& paths_;
  std::vector<Capture> captures_;
};

} // namespace abbe::transport
