// SPDX-License-Identifier: MIT
#pragma once

#include "base/vec.hpp"
#include "optics/fresnel.hpp"

namespace abbe::optics {

/// A direction per lane.
template <class L>
struct Direction {
  L x, y, z;
};

/// The unit direction beyond the interface. `d` is the unit incident direction, `n` the unit normal
/// on the side it comes from (d . n < 0). Do not call it at total reflection. Indices equal: `d`
/// itself, bitwise. Otherwise one Newton step restores unit length, and only where the length is
/// off by more than rounding.
template <class L>
Direction<L> refracted(Interface<L> const& f, Direction<L> const& d, Direction<L> const& n) {
  Direction<L> t{f.eta * d.x + f.bend * n.x, f.eta * d.y + f.bend * n.y,
                 f.eta * d.z + f.bend * n.z};
  L const norm2 = t.x * t.x + t.y * t.y + t.z * t.z;
  L const off = norm2 - L(1.0);
  MaskOf<L> const leave = (off <= L(4 * unit_roundoff)) & (off >= L(-4 * unit_roundoff));
  MaskOf<L> const same = (f.eta == L(1.0)) & (f.bend == L(0.0));
  MaskOf<L> const keep = leave | same;
  L const scale = select(keep, L(1.0), L(1.5) - L(0.5) * norm2);
  return {t.x * scale, t.y * scale, t.z * scale};
}

inline Vec3 refracted(Interface<double> const& f, Vec3 const& d, Vec3 const& n) {
  auto const t = refracted<double>(f, {d.x, d.y, d.z}, {n.x, n.y, n.z});
  return {t.x, t.y, t.z};
}

/// The mirror direction d - 2 (d . n) n.
inline Vec3 reflected(Vec3 const& d, Vec3 const& n) {
  return d - n * (2 * glm::dot(d, n));
}

} // namespace abbe::optics
