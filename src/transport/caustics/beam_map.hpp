// SPDX-License-Identifier: MIT
#pragma once

#include "base/vec.hpp"
#include "transport/caustics/sheet.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace abbe::transport::caustics {

/// The rays of a sheet as polynomials of their place on the cell and of the wavelength, both
/// counted from -1 to 1. They go through the rays at Lobatto's nodes, so that sheets that share an
/// edge agree there to what both are off.
class BeamMap {
public:
  /// Nodes along a side of the cell, and along the sheet's piece of the spectrum.
  static constexpr std::size_t side = 5, waves = 6;
  static constexpr std::size_t terms = side * side;
  static constexpr std::size_t room = 28; ///< of terms, in whole lanes
  /// Where node k of the terms is, and where the wavelengths are as shares of the piece in
  /// sixteenths.
  static Vec2 node(std::size_t k);
  static constexpr std::array<int, waves> wave_sixteenths{0, 2, 6, 10, 14, 16};

  /// What is known of a ray behind its last surface, in the sheet's frame.
  enum Quantity : std::size_t {
    X,       ///< where it passes the plane of the axes
    Y,       ///<
    SlopeX,  ///< how it goes on along the beam
    SlopeY,  ///<
    Begin,   ///< where it begins, along the beam
    Way,     ///< from the lamp to there
    Share,   ///< that surfaces left of its light, where the chain is plain
    Inside,  ///< its way in the first of the media that absorb
    Inside2, ///< in the second
    quantities
  };
  using Ray = std::array<double, quantities>;
  /// All that is told by where it goes; the rest is 0.
  static Ray in_frame(Sheet const& sheet, BeamRay const& ray);

  BeamMap() = default;
  /// @param rays `terms` of them at each of `waves` wavelengths, or at one
  explicit BeamMap(std::span<Ray const> rays);

  /// How rays of one wavelength pass a point: terms of the offset.
  struct Passing {
    std::array<float, room> x, y;
  };
  /// @param w of the wavelength @param point in the sheet's frame: across, up, along
  Passing passing(double w, Vec3 const& point) const;
  struct Offset {
    Vec2 at, by_u, by_v;
  };
  static Offset offset(Passing const& passing, Vec2 const& u);
  Ray ray(double w, Vec2 const& u) const;
  /// By how much rays pass where they should, as a share of the map's longest stretch.
  double off() const { return off_; }
  void set_off(double off) { off_ = off; }

private:
  float const* of(std::size_t quantity) const { return terms_.data() + quantity * waves_ * room; }
  std::size_t waves_ = 0;
  double off_ = 0;
  std::vector<float> terms_; ///< by quantity, then power of w, then of u.y and u.x
};

} // namespace abbe::transport::caustics
