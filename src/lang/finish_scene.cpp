// SPDX-License-Identifier: MIT
#include "lang/blocks.hpp"
#include "optics/bands.hpp"
#include "optics/glass.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace abbe::lang {

namespace {

/// The wavelengths at which a scene asks a glass for its index.
struct Wanted {
  double low_nm, high_nm;
};

class GlassCheck {
public:
  GlassCheck(Reader& in, Wanted wanted, bool disperses_by_default)
      : in_(in), wanted_(wanted), disperses_by_default_(disperses_by_default) {}

  void visit(scene::Object const& object) {
    if (object.interior) check(*object.interior);
    for (scene::Object const& child : object.children) visit(child);
  }

private:
  void check(scene::Interior const& interior) {
    if (!interior.glass || !seen_.insert(&interior).second) return;
    using Kind = scene::DispersionMode::Kind;
    bool const none = interior.dispersion.kind == Kind::None
                      || (interior.dispersion.kind == Kind::Inherit && !disperses_by_default_);
    Wanted const wanted = none ? Wanted{optics::d_line_nm, optics::d_line_nm} : wanted_;
    for (double const lambda_nm : {wanted.low_nm, wanted.high_nm}) {
      auto const index = interior.glass->index(lambda_nm);
      if (index) continue;
      in_.report(Severity::Error, index.error().code,
                 index.error().message + remedy(*interior.glass, none), interior.span);
      return;
    }
    // Inside its range the catalogue is checked; a formula of the scene may have a pole anywhere.
    if (auto error = interior.glass->check_range(wanted.low_nm, wanted.high_nm))
      in_.report(Severity::Error, error->code, error->message, interior.span);
  }

  /// What to do about a glass that does not cover the scene's range of wavelengths.
  std::string remedy(optics::Glass const& glass, bool none) const {
    auto const range = glass.range_nm();
    constexpr double hardly_nm = 1e5; // no wavelength that a glass is given for
    if (range.lo_nm >= hardly_nm) return ": wavelengths of a glass are in um, are these nm?";
    double const lo = std::ceil(std::max(range.lo_nm, wanted_.low_nm));
    double const hi = std::floor(std::min(range.hi_nm, wanted_.high_nm));
    if (none) return "";
    if (lo >= hi) return "; with dispersion { none } it only needs the d line";
    std::string text = fmt::format(
        "; narrow the scene's range, global_settings {{ spectral {{ range {}, {} }} }}", lo, hi);
    if (glass.maker().empty())
      text += fmt::format(", widen the glass's where its data holds, glass {{ ... range {:.6g}, "
                          "{:.6g} }}",
                          std::min(range.lo_nm, wanted_.low_nm) / 1000,
                          std::max(range.hi_nm, wanted_.high_nm) / 1000);
    return text + ", or use dispersion { none }";
  }

  Reader& in_;
  Wanted wanted_;
  bool disperses_by_default_;
  std::set<scene::Interior const*> seen_;
};

} // namespace

void finish_scene(Reader& in) {
  SceneState& state = scene_state(in.interpreter());
  scene::Scene& scene = state.scene;
  scene.settings.version = state.effective_version;
  if (state.cameras == 0) scene.camera = default_camera(in, {});
  auto const bands = make_bands(scene.settings.spectral);
  if (!bands) return; // was reported where it is written
  using Kind = scene::DispersionMode::Kind;
  GlassCheck check(in, {bands->lo_nm(), bands->hi_nm()},
                   scene.settings.spectral.dispersion.kind != Kind::None);
  for (scene::Object const& object : scene.objects) check.visit(object);
}

} // namespace abbe::lang
