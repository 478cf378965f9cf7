// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/bvh.hpp"
#include "transport/caustics/receivers.hpp"
#include "transport/caustics/sheet.hpp"

#include <array>
#include <span>
#include <vector>

namespace abbe::transport::caustics {

/// Which sheets' beams may hold a point of a receiver: boxes around pieces of the beams, in
/// hierarchies, one for each slice of the spectrum and one for light that does not disperse.
class SheetIndex {
public:
  SheetIndex() = default;
  SheetIndex(std::vector<Sheet> sheets, Receivers const& receivers);
  std::vector<Sheet> const& sheets() const { return sheets_; }
  struct Over {
    std::uint32_t sheet;
    double from, to; ///< where in the spectrum the beam may hold the point
  };
  struct Want {
    Vec3 point{0};
    double from = 0, to = 0; ///< of the spectrum, 0 .. 1: what of it matters
  };
  /// @param out by want, ascending; points beside each other that follow each other are looked for
  /// together
  void find(std::span<Want const> wants, std::vector<std::vector<Over>>& out) const;

private:
  static constexpr int slices = 4;
  /// A beam between two distances and two places in the spectrum.
  struct Piece {
    std::uint32_t sheet = 0;
    double begin = 0, per_length = 0; ///< along the beam; 1 / length
    double from = 0, to = 0;          ///< of the spectrum
    /// Sides of rectangles around it, by wavelength of the ends; low x, high x, low y, high y; at
    /// the beginning, and by how much they are farther out at the other end.
    std::array<std::array<float, 4>, 2> side{}, more{};
    /// @return false: it does not hold a point of its sheet's frame
    bool may_hold(Vec3 const& place, double& first, double& last) const;
  };
  struct Slice {
    std::vector<Piece> pieces;
    geometry::Bvh bvh;
    double grain = 0; ///< the size of half of the pieces is below it
  };
  static void add_pieces(Sheet const& sheet, std::uint32_t number,
                         std::array<double, 2> const& ends, double from, double to, int halvings,
                         Receivers const& receivers, std::vector<Piece>& out,
                         std::vector<geometry::Bounds>& boxes);
  static void build(std::vector<geometry::Bounds> const& boxes, Slice& slice);
  void look(Slice const& slice, std::span<Want const> wants, std::span<std::uint32_t const> of,
            std::vector<std::vector<Over>>& out) const;

  std::vector<Sheet> sheets_;
  Slice whole_; ///< of light that does not disperse
  std::array<Slice, slices> sliced_;
};

} // namespace abbe::transport::caustics
