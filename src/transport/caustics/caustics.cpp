// SPDX-License-Identifier: MIT
#include "transport/caustics/caustics.hpp"

#include "transport/caustics/beam_fitter.hpp"
#include "transport/caustics/certainty.hpp"

#include <algorithm>

namespace abbe::transport::caustics {
namespace {

geometry::Bounds around(geometry::Bounds const& a, geometry::Bounds const& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return {glm::min(a.low, b.low), glm::max(a.high, b.high), false};
}

Ball ball_of(geometry::Bounds const& box) {
  return {0.5 * (box.low + box.high), 0.5 * glm::length(box.high - box.low)};
}

/// How far light is followed that meets nothing, in sizes of what is finite, where something that
/// it falls on has no end.
constexpr double endless = 4096;

/// Sheets with so small a share of the light do not pay for maps: few places ask for them.
constexpr double too_little = 0x1p-16;

SheetBuilder::Places places_of(Stage const& stage) {
  SheetBuilder::Places places;
  places.receivers = Receivers(stage);
  geometry::Bounds hull;
  for (geometry::SolidId solid = 0; solid < stage.solids.size(); ++solid) {
    geometry::Bounds const box = stage.world->bounds(solid);
    if (box.infinite || box.empty()) continue;
    hull = around(hull, box);
    if (stage.casts[solid].target) {
      places.casters.push_back(ball_of(box));
      places.casters_hull = around(places.casters_hull, box);
    }
  }
  places.size = hull.empty() ? 1 : glm::length(hull.high - hull.low);
  places.far = places.receivers.endless() ? endless * places.size : places.size;
  return places;
}

} // namespace

double Caustics::place_of(double lambda_nm) const {
  double const low = waves_.lambda_nm(spectrum_.front()), high = waves_.lambda_nm(spectrum_.back());
  if (low == high) return 0;
  auto const bend = [](double nm) { return 1 / (nm * nm); };
  return (bend(lambda_nm) - bend(low)) / (bend(high) - bend(low));
}

double Caustics::lambda_at(double place) const {
  double const low = waves_.lambda_nm(spectrum_.front()), high = waves_.lambda_nm(spectrum_.back());
  auto const bend = [](double nm) { return 1 / (nm * nm); };
  return 1 / std::sqrt(bend(low) + place * (bend(high) - bend(low)));
}

void Caustics::add_waves(Stage const& stage) {
  bool const disperses = std::any_of(stage.media.begin(), stage.media.end(),
                                     [](Medium const& medium) { return medium.dispersive; });
  if (!stage.spectral || !disperses) return;
  optics::ChannelSet const& set = *stage.spectral;
  std::vector<double> known;
  auto const wave = [&](double lambda_nm) {
    auto const at = std::find(known.begin(), known.end(), lambda_nm);
    if (at != known.end()) return static_cast<int>(at - known.begin()) + 1;
    known.push_back(lambda_nm);
    return waves_.add(lambda_nm);
  };
  double least = INFINITY, most = 0;
  for (int c = 0; c < set.count(); ++c) {
    Band band;
    if (set.is_line(c) || set.is_basis()) {
      band.low_nm = band.high_nm = set.lambda_nm(c);
    } else {
      band.low_nm = set.bands.edge(c);
      band.high_nm = set.bands.edge(c + 1);
    }
    band.low = wave(band.low_nm);
    band.high = wave(band.high_nm);
    least = std::min(least, band.low_nm);
    most = std::max(most, band.high_nm);
    bands_.push_back(band);
  }
  spectrum_ = {wave(least), wave(most)};
  std::vector<int> pieces{spectrum_.front()};
  for (int k = 1; k < SheetBuilder::spectrum_pieces; ++k)
    pieces.push_back(wave(lambda_at(static_cast<double>(k) / SheetBuilder::spectrum_pieces)));
  pieces.push_back(spectrum_.back());
  spectrum_ = std::move(pieces);
}

Caustics::Caustics(Stage const& stage, Settings const& settings)
    : limits_(settings.limits), waves_(stage), lamps_(stage.lamps.size()) {
  add_waves(stage);
  SheetBuilder::Places const places = places_of(stage);
  if (places.casters.empty()) return;
  SheetBuilder builder(stage, waves_, spectrum_, places, limits_, settings.error, chains_);
  for (std::size_t lamp = 0; lamp < lamps_.size(); ++lamp) {
    auto const rays = stage.lamps[lamp]->rays();
    if (!settings.lamps[lamp] || !rays) continue;
    OfLamp& own = lamps_[lamp];
    own.emission.emplace(*rays, places.casters_hull);
    std::vector<Sheet> sheets;
    own.found = builder.build(static_cast<int>(lamp), *own.emission, sheets);
    own.root_level = builder.root_level();
    if (!settings.exact) sheets = interpolated(stage, sheets, own);
    own.index = SheetIndex(std::move(sheets), places.receivers);
  }
}

std::vector<Sheet> Caustics::interpolated(Stage const& stage, std::vector<Sheet> const& sheets,
                                          OfLamp& own) const {
  std::vector<Sheet> out;
  ForcedPaths forced(stage, waves_);
  BeamFitter fitter(forced, *own.emission, spectrum_);
  double total = 0;
  for (Sheet const& sheet : sheets) total += sheet.flux;
  for (Sheet const& sheet : sheets)
    if (sheet.flux < too_little * total)
      out.push_back(sheet);
    else
      fitter.cut(chains_[sheet.chain], sheet, out, own.maps);
  LightPaths paths(stage, waves_, limits_);
  Certainty(stage, forced, paths, *own.emission, spectrum_, chains_).find(out);
  own.found.rays += forced.rays() + paths.rays();
  return out;
}

double Caustics::missing() const {
  double most = 0;
  for (OfLamp const& lamp : lamps_) most = std::max(most, lamp.found.missing);
  return most;
}

} // namespace abbe::transport::caustics
