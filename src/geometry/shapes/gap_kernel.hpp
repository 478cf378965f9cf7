// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/shapes/convex.hpp"

namespace abbe::geometry {

/// Where lines go through a shape that each of them meets twice at most: inside between the two, or
/// outside between them and inside on both sides.
template <class L>
struct Gap {
  Ends<L> between; ///< nothing where not in_t < out_t
  L outside;       ///< 1: the line is outside between the ends, and inside else; 0: the other way
  L alike;         ///< 1: there are two ends that cannot be told apart
};

/// The bits of crossings(), lane by lane, of lines that do not start on the shape; all ends are
/// there to be seen.
class GapKernel {
public:
  virtual ~GapKernel() = default;
  virtual void gap(Line<double> const& line, Gap<double>& out) const = 0;
  virtual void gap(Line<lane::Double4> const& lines, Gap<lane::Double4>& out) const = 0;
#if ABBE_HAS_WIDE_LANES
  virtual void gap(Line<lane::Wide4> const& lines, Gap<lane::Wide4>& out) const = 0;
  virtual void gap(Line<lane::Wide8> const& lines, Gap<lane::Wide8>& out) const = 0;
#endif
};

} // namespace abbe::geometry
