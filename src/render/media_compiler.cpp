// SPDX-License-Identifier: MIT
#include "render/media_compiler.hpp"

#include "optics/glass_builder.hpp"
#include "plan/dispersion.hpp"
#include "transport/wavelengths/policy.hpp"

#include <algorithm>

namespace abbe::render {

MediaCompiler::MediaCompiler(scene::Settings const& settings, plan::Plan const& plan,
                             ColourCompiler& colours, Stage& stage)
    : settings_(settings), plan_(plan), colours_(colours), stage_(stage) {
  Medium air;
  air.flat_index.assign(static_cast<std::size_t>(stage.channels), 1.0);
  stage_.media.push_back(std::move(air));
}

int MediaCompiler::add(std::shared_ptr<scene::Interior const> const& interior) {
  auto const found = known_.find(interior.get());
  if (found != known_.end()) return found->second;
  stage_.media.push_back(compile(*interior));
  int const number = static_cast<int>(stage_.media.size()) - 1;
  known_.emplace(interior.get(), number);
  return number;
}

Medium MediaCompiler::compile(scene::Interior const& interior) {
  Medium medium;
  using scene::Switch;
  bool const refracts = !plan_.is_off(Switch::Refraction);
  medium.fresnel = interior.glass != nullptr && refracts && !plan_.is_off(Switch::Reflection);
  medium.index_d = refracts ? plan::plain_index(interior) : 1;
  medium.flat_index.assign(static_cast<std::size_t>(stage_.channels), medium.index_d);
  medium.caustics = interior.caustics;
  auto const make_segments = [&](Channels absorption) {
    bool const fades = !plan_.is_off(Switch::DistanceFade);
    medium.segments = transport::make_segments(
        interior, std::move(absorption),
        fades ? colours_.reflectance(interior.fade_colour) : Channels(), fades);
  };
  if (!stage_.spectral) {
    make_segments({});
    return medium;
  }
  optics::Bands const& bands = stage_.bands();
  auto const glass = plan::dispersive_glass(interior);
  Channels absorption;
  if (glass && glass->absorbs() && !plan_.is_off(Switch::Absorption)) {
    for (double const lambda_nm : stage_.lambdas_nm)
      absorption.push_back(glass->absorption_per_mm(lambda_nm) * settings_.spectral.mm_per_unit);
    if (is_black(absorption)) absorption.clear();
  }
  make_segments(std::move(absorption));
  using Kind = scene::DispersionMode::Kind;
  auto const mode = plan::effective_mode(interior, settings_, plan_.dispersion_override);
  bool const wanted = mode.kind != Kind::None;
  if (!wanted || !refracts || !glass || !glass->is_dispersive(bands.lo_nm(), bands.hi_nm()))
    return medium;
  medium.dispersive = true;
  medium.glass = glass.get();
  stage_.glasses.push_back(glass);
  for (double const lambda_nm : stage_.lambdas_nm)
    medium.index.push_back(glass->index_unchecked(lambda_nm));
  if (mode.kind == Kind::Stochastic) medium.comb = comb_number(mode.comb);
  if (mode.kind == Kind::Adaptive) medium.tolerance_px = mode.tolerance_px;
  stage_.has_adaptive = stage_.has_adaptive || medium.tolerance_px > 0;
  medium.policy = &transport::policy_of(medium.comb >= 0 ? &stage_.comb(medium.comb) : nullptr,
                                        medium.tolerance_px);
  return medium;
}

int MediaCompiler::comb_number(optics::Comb comb) {
  if (comb.teeth == stage_.bands().count() && comb.follow == optics::Comb::Follow::Every)
    comb.teeth = 0;
  auto const found = std::find(stage_.combs.begin(), stage_.combs.end(), comb);
  if (found != stage_.combs.end()) return static_cast<int>(found - stage_.combs.begin());
  stage_.combs.push_back(comb);
  return static_cast<int>(stage_.combs.size()) - 1;
}

} // namespace abbe::render
