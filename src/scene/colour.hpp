// SPDX-License-Identifier: MIT
#pragma once

#include "base/vec.hpp"

#include <memory>

namespace abbe::optics {
class Spectrum;
}

namespace abbe::scene {

/// A colour as written: rgb (linear, scene white = 1 1 1) or a spectrum, with POV-Ray's two kinds
/// of transparency. With a spectrum, `rgb` scales it (white leaves it alone).
struct Colour {
  Vec3 rgb{0};
  double filter = 0;
  double transmit = 0;
  std::shared_ptr<optics::Spectrum const> spectrum;
};

} // namespace abbe::scene
