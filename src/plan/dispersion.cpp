// SPDX-License-Identifier: MIT
#include "plan/dispersion.hpp"

#include "optics/bands.hpp"
#include "optics/glass_builder.hpp"

namespace abbe::plan {

scene::DispersionMode effective_mode(scene::Interior const& interior,
                                     scene::Settings const& settings,
                                     std::optional<scene::DispersionMode> const& override_mode) {
  using Kind = scene::DispersionMode::Kind;
  if (override_mode) return *override_mode;
  auto mode = interior.dispersion.kind != Kind::Inherit ? interior.dispersion
                                                        : settings.spectral.dispersion;
  auto const merge_px = settings.spectral.merge_px;
  if (merge_px && (mode.kind == Kind::Deterministic || mode.kind == Kind::Adaptive)) {
    mode.kind = *merge_px > 0 ? Kind::Adaptive : Kind::Deterministic;
    mode.tolerance_px = *merge_px;
  }
  return mode;
}

double plain_index(scene::Interior const& interior) {
  if (interior.glass)
    return interior.glass->nd().value_or(interior.glass->index_unchecked(optics::d_line_nm));
  return interior.ior == 0 ? 1 : interior.ior;
}

std::shared_ptr<optics::Glass const> dispersive_glass(scene::Interior const& interior) {
  if (interior.glass) return interior.glass;
  if (interior.pov_dispersion == 1 || interior.pov_dispersion <= 0) return nullptr;
  auto glass = optics::GlassBuilder("ior with dispersion")
                   .pov(plain_index(interior), interior.pov_dispersion)
                   .build();
  return glass ? *glass : nullptr;
}

} // namespace abbe::plan
