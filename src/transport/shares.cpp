// SPDX-License-Identifier: MIT
#include "transport/shares.hpp"

#include <algorithm>

namespace abbe::transport {

bool is_bare(Stage const& stage, Chunk const& chunk) {
  if (chunk.group == nullptr) return stage.textures.surfaces[chunk.hit[0].primitive].bare();
  return std::all_of(chunk.crossings.begin(), chunk.crossings.end(), [&](auto const& crossing) {
    return stage.textures.surfaces[crossing.primitive].bare();
  });
}

namespace {

/// Of clear surfaces that do not split light.
void find_bare_shares(Chunk const& c, bool fresnel, Shares& shares) {
  RaySet const all = first_rays(c.count);
  shares.passing = all & ~c.total;
  if (!fresnel) {
    shares.returning = c.total;
    std::copy_n(c.light, c.lanes(), shares.back);
    std::copy_n(c.light, c.lanes(), shares.on);
    return;
  }
  for (std::size_t r = 0, k = 0; r < c.count; ++r) {
    double const back = c.reflectance[r], on = c.transmittance[r];
    shares.returning |= RaySet{back != 0} << r;
    for (std::size_t const end = k + c.each; k < end; ++k) {
      shares.back[k] = c.light[k] * back;
      shares.on[k] = c.light[k] * on;
    }
  }
}

} // namespace

void find_shares(Arena& arena, Chunk const& c, bool fresnel, bool splits,
                 SurfaceLight const* surface, Shares& shares) {
  std::size_t const lanes = c.lanes();
  shares.back = arena.take<double>(lanes + 8);
  shares.on = arena.take<double>(lanes + 8);
  shares.passing = shares.returning = 0;
  if (surface == nullptr && !splits) return find_bare_shares(c, fresnel, shares);
  RaySet const unasked_of =
      fresnel ? ~(surface != nullptr ? surface->explicit_reflection : RaySet{0}) : 0;
  for (std::size_t r = 0, first = 0; r < c.count; ++r, first += c.each) {
    bool const unasked = (unasked_of >> r & 1) != 0;
    bool const passes = surface == nullptr || any_above(surface->passed + first, c.each, 0);
    bool const mirrors = surface != nullptr && (surface->mirrors >> r & 1) != 0;
    if (!passes && !mirrors) continue;
    bool returns = false;
    auto const share = [&](std::size_t k, bool total, double reflectance, double transmittance) {
      double const passed = surface != nullptr ? surface->passed[k] : 1;
      double const asked = surface != nullptr ? surface->mirrored[k] : 0;
      // Total reflection returns everything that would have passed (unfiltered, as in POV-Ray).
      double const back = total                   ? (passes ? 1 : asked)
                          : unasked && passed > 0 ? asked + reflectance
                                                  : asked;
      shares.back[k] = c.light[k] * back;
      shares.on[k] = c.light[k] * (total ? 0 : unasked ? passed * transmittance : passed);
      returns = returns || back != 0;
    };
    if (splits) {
      for (std::size_t k = first; k < first + c.each; ++k)
        share(k, shares.ways.total[k], shares.ways.reflectance[k], shares.ways.transmittance[k]);
    } else {
      bool const total = (c.total >> r & 1) != 0;
      double const reflectance = c.reflectance[r], transmittance = c.transmittance[r];
      for (std::size_t k = first; k < first + c.each; ++k)
        share(k, total, reflectance, transmittance);
    }
    shares.returning |= RaySet{returns} << r;
    shares.passing |= RaySet{passes} << r;
  }
  if (!splits || shares.passing == first_rays(c.count)) return;
  for (std::size_t r = 0; r < c.count; ++r) // policies look at all
    if ((shares.passing >> r & 1) == 0) std::fill_n(shares.on + r * c.each, c.each, 0.0);
}

} // namespace abbe::transport
