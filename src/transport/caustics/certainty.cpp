// SPDX-License-Identifier: MIT
#include "transport/caustics/certainty.hpp"

#include "transport/caustics/receivers.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::transport::caustics {
namespace {

/// Boxes along a way.
constexpr int parts = 8;
/// By how much they are wider than the nodes' rays, as a share of their size.
constexpr double wider = 0.125;

} // namespace

int Certainty::wave_at(Sheet const& sheet, double at) const {
  if (!chains_[sheet.chain].disperses) return Waves::whole;
  auto const pieces = static_cast<double>(spectrum_.size() - 1);
  return spectrum_[static_cast<std::size_t>(std::lround(at * pieces))];
}

bool Certainty::convex(Chain const& chain) const {
  return std::ranges::all_of(chain.steps, [&](Step const& step) {
    auto const lone = stage_.world->lone(step.solid);
    return lone && stage_.world->shape(*lone).one_interval();
  });
}

bool Certainty::clear(std::span<Vec3 const> from, std::span<Vec3 const> to, Step const* left,
                      Step const& met) {
  for (int part = 0; part < parts; ++part) {
    geometry::Bounds box{Vec3(INFINITY), Vec3(-INFINITY)};
    for (std::size_t k = 0; k < from.size(); ++k)
      for (int const end : {part, part + 1}) {
        Vec3 const at = from[k] + static_cast<double>(end) / parts * (to[k] - from[k]);
        box.low = glm::min(box.low, at);
        box.high = glm::max(box.high, at);
      }
    Vec3 const more = wider * (box.high - box.low);
    box.low -= more;
    box.high += more;
    near_.clear();
    stage_.world->meeting(box.low, box.high, near_);
    for (geometry::SolidId const solid : near_) {
      if (solid == met.solid || (left != nullptr && solid == left->solid)) continue;
      auto const lone = stage_.world->lone(solid);
      if (!lone || !is_plane(stage_.world->shape(*lone))
          || plane_may_be_in(*stage_.world, *lone, box.low, box.high))
        return false;
    }
  }
  return true;
}

bool Certainty::clear(Sheet const& sheet, int wave) {
  Chain const& chain = chains_[sheet.chain];
  std::vector<Vec3> from, points;
  for (int k = 0; k < 9; ++k)
    from.push_back(emission_.origin(
        {sheet.cell.face, sheet.cell.low() + 0.5 * sheet.cell.size() * node_place(k)}));
  rays_.points = &points;
  bool const there = forced_.follow_nodes(chain, emission_, sheet.cell, wave, rays_);
  rays_.points = nullptr;
  if (!there) return false;
  for (std::size_t step = 0; step < chain.steps.size(); ++step) {
    auto const to = std::span<Vec3 const>(points).subspan(9 * step, 9);
    if (!clear(from, to, step > 0 ? &chain.steps[step - 1] : nullptr, chain.steps[step]))
      return false;
    from.assign(to.begin(), to.end());
  }
  return true;
}

void Certainty::follow(std::span<Sheet*> sheets) {
  LightPaths::Starts starts;
  for (Sheet* const sheet : sheets)
    for (double const end : {sheet->from, sheet->to})
      for (int k = 0; k < 9; ++k) {
        Emission::Place const place{sheet->cell.face,
                                    sheet->cell.low() + 0.5 * sheet->cell.size() * node_place(k)};
        starts.origin.push_back(emission_.origin(place));
        starts.direction.push_back(emission_.direction(place));
        starts.wave.push_back(wave_at(*sheet, end));
        starts.channels.push_back(0);
        starts.target.push_back(sheet->chain);
      }
  if (starts.count() == 0) return;
  starts.lamp = static_cast<std::size_t>(sheets.front()->lamp);
  std::vector<LightPaths::Segment> segments;
  std::vector<double> light;
  paths_.along_targets(starts, chains_, segments, light);
  std::vector<int> made(sheets.size(), 0);
  for (auto const& segment : segments) ++made[segment.ray / 18];
  for (std::size_t k = 0; k < sheets.size(); ++k) sheets[k]->certain = made[k] == 18;
}

void Certainty::find(std::span<Sheet> sheets) {
  std::vector<Sheet*> clear_ones;
  for (Sheet& sheet : sheets) {
    Chain const& chain = chains_[sheet.chain];
    if (sheet.map < 0 || !chain.plain || !convex(chain)) continue;
    if (clear(sheet, wave_at(sheet, sheet.from)) && clear(sheet, wave_at(sheet, sheet.to)))
      clear_ones.push_back(&sheet);
  }
  constexpr std::size_t at_once = 256;
  for (std::size_t first = 0; first < clear_ones.size(); first += at_once)
    follow(std::span(clear_ones).subspan(first, std::min(at_once, clear_ones.size() - first)));
}

} // namespace abbe::transport::caustics
