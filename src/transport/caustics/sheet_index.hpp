// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/bvh.hpp"
#include "transport/caustics/sheet.hpp"

#include <vector>

namespace abbe::transport::caustics {

/// Which sheets' beams may hold a point: boxes around pieces of the beams, in a hierarchy.
class SheetIndex {
public:
  SheetIndex() = default;
  explicit SheetIndex(std::vector<Sheet> sheets);
  std::vector<Sheet> const& sheets() const { return sheets_; }
  struct Over {
    std::uint32_t sheet;
    double from, to; ///< Sheet::may_hold
  };
  /// Ascending.
  void find(Vec3 const& point, std::vector<Over>& out) const;
  std::size_t bytes() const;

private:
  std::vector<Sheet> sheets_;
  geometry::Bvh bvh_;
};

} // namespace abbe::transport::caustics
