// SPDX-License-Identifier: MIT
#include "geometry/shapes/start.hpp"

#include "geometry/shapes/convex.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::geometry {

namespace {

bool may_be(Start const& start, Crossing const& c) {
  return c.entering == start.to_inside && std::fabs(c.t) <= 2 * (c.error + c.slack);
}

} // namespace

bool has_start(Start const& start, double near, std::size_t first, Crossings const& out) {
  return std::any_of(out.begin() + static_cast<std::ptrdiff_t>(first), out.end(),
                     [&](Crossing const& c) { return std::fabs(c.t) < near && may_be(start, c); });
}

void impose_start(Start const& start, bool flat_faces, std::size_t first, Crossings& out) {
  std::size_t known = out.size();
  bool by_face = false;
  for (std::size_t i = first; i < out.size(); ++i) {
    Crossing const& c = out[i];
    if (c.entering != start.to_inside) continue;
    bool const face = flat_faces && c.face == start.face;
    bool const near = std::fabs(c.t) <= 2 * (c.error + c.slack);
    if (by_face || !(face || near)) continue;
    bool const nearer = known == out.size() || std::fabs(c.t) < std::fabs(out[known].t);
    if (face || nearer) known = i;
    by_face = face;
  }
  double const beside = start.to_inside ? just_after : -just_after;
  if (known == out.size()) {
    Crossing known_root;
    known_root.face = start.face;
    known_root.entering = start.to_inside;
    Crossing other = known_root;
    other.t = beside;
    other.entering = !start.to_inside;
    out.push_back(known_root);
    out.push_back(other);
    return;
  }
  for (std::size_t i = first; i < known; ++i) out[i].t = std::min(out[i].t, -just_after);
  for (std::size_t i = known + 1; i < out.size(); ++i) out[i].t = std::max(out[i].t, just_after);
  out[known].t = 0;
  out[known].face = start.face;
}

} // namespace abbe::geometry
