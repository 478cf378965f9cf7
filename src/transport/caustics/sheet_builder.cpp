// SPDX-License-Identifier: MIT
#include "transport/caustics/sheet_builder.hpp"

#include "base/word_hash.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::transport::caustics {
namespace {

/// Of the emission's square, in nodes of the deepest cells.
constexpr int grid_level = 24;
constexpr int deepest = 20;
/// How many levels finer than the casters are large cells are looked at first: openings that light
/// comes through may be smaller than what it falls on.
constexpr int first_look = 3;
/// What whole chains may be left out for being weak, as a share of the error.
constexpr double weak_share = 0.1;
/// Pieces of the spectrum that are not cut further in looking for where it ends.
constexpr int whole_pieces = 16;
constexpr std::size_t most_sheets = 1'000'000, most_cells = 1'000'000;
/// How curved a map may be in a cell: second differences, taken back by its linear part. Newton's
/// iteration converges from a guess of the linear part below 1/2.
constexpr double most_curved = 0.25;

std::uint64_t key_of(Cell const& cell, int chain) {
  WordHash hash;
  hash.add(static_cast<std::uint64_t>(chain) << 32
           | static_cast<std::uint64_t>(cell.face * 32 + cell.level));
  hash.add(static_cast<std::uint64_t>(cell.i) << 32 | cell.j);
  return hash.value();
}

/// The larger singular value of a matrix of two columns.
double longest(Vec2 const& a, Vec2 const& b) {
  double const sum = glm::dot(a, a) + glm::dot(b, b);
  double const det = a.x * b.y - a.y * b.x;
  return std::sqrt(0.5 * (sum + std::sqrt(std::max(0.0, sum * sum - 4 * det * det))));
}

/// Is the map of nine rays to a plane at a distance straight enough, or a fold that is?
bool straight(std::array<BeamRay, 9> const& rays, double way) {
  Vec3 mean{0}, middle{0};
  for (BeamRay const& ray : rays) {
    mean += ray.direction;
    middle += ray.origin + way * ray.direction;
  }
  double const length = glm::length(mean);
  if (!(length > 4.5)) return false; // half of them go elsewhere
  mean = mean / length;
  middle = middle / 9.0;
  auto const [a, b] = axes_across(mean);
  std::array<Vec2, 9> q;
  for (std::size_t k = 0; k < 9; ++k) {
    double const along = glm::dot(rays[k].direction, mean);
    if (!(along > 0.1)) return false;
    double const t = glm::dot(middle - rays[k].origin, mean) / along;
    Vec3 const at = rays[k].origin + t * rays[k].direction - middle;
    q[k] = {glm::dot(at, a), glm::dot(at, b)};
  }
  // How far a step of Newton's iteration from the linear part would lead astray, in cells; and the
  // same beside the longest stretch.
  Vec2 const x = 0.5 * (q[2] + q[8] - q[0] - q[6]), y = 0.5 * (q[6] + q[8] - q[0] - q[2]);
  double const det = x.x * y.y - x.y * y.x;
  double astray = 0, bent = 0;
  for (auto const& [i, j, k] : {std::array<std::size_t, 3>{0, 1, 2},
                                {3, 4, 5},
                                {6, 7, 8},
                                {0, 3, 6},
                                {1, 4, 7},
                                {2, 5, 8}}) {
    Vec2 const off = q[i] - 2.0 * q[j] + q[k];
    bent = std::max(bent, glm::length(off));
    Vec2 const back{off.x * y.y - off.y * y.x, x.x * off.y - x.y * off.x};
    astray = std::max(astray, glm::length(back));
  }
  if (astray <= most_curved * std::abs(det)) return true;
  bool left = false, right = false;
  for (auto const& [i, j, k] : sheet_triangles) {
    Vec2 const u = q[static_cast<std::size_t>(j)] - q[static_cast<std::size_t>(i)],
               v = q[static_cast<std::size_t>(k)] - q[static_cast<std::size_t>(i)];
    double const turn = u.x * v.y - u.y * v.x;
    left = left || turn > 0;
    right = right || turn < 0;
  }
  return left && right && bent <= most_curved / 4 * longest(x, y);
}

/// Are rays at a wavelength half-way between those at the ends, to a tenth of the beam's width, at
/// some distances?
bool is_between(std::array<BeamRay, 9> const& low, std::array<BeamRay, 9> const& middle,
                std::array<BeamRay, 9> const& high, std::span<double const> ways) {
  for (double const way : ways) {
    Vec3 const d = middle[4].direction;
    Vec3 const centre = middle[4].origin + way * d;
    auto const [a, b] = axes_across(d);
    // On the plane there, as the beams cross it.
    auto const at = [&](BeamRay const& ray) {
      double const t = glm::dot(centre - ray.origin, d) / glm::dot(ray.direction, d);
      Vec3 const off = ray.origin + t * ray.direction - centre;
      return Vec2(glm::dot(off, a), glm::dot(off, b));
    };
    Vec2 const x = 0.5 * (at(middle[2]) + at(middle[8]) - at(middle[0]) - at(middle[6])),
               y = 0.5 * (at(middle[6]) + at(middle[8]) - at(middle[0]) - at(middle[2]));
    double const det = x.x * y.y - x.y * y.x;
    for (std::size_t k = 0; k < 9; ++k) {
      Vec2 const off = at(middle[k]) - 0.5 * (at(low[k]) + at(high[k]));
      Vec2 const back{off.x * y.y - off.y * y.x, x.x * off.y - x.y * off.x};
      bool const near =
          glm::length(back) <= 0.1 * std::abs(det) || glm::length(off) <= 0.02 * longest(x, y);
      if (!near) return false;
    }
  }
  return true;
}

bool meets(geometry::Bounds const& box, Vec3 const& low, Vec3 const& high) {
  for (int axis = 0; axis < 3; ++axis)
    if (box.high[axis] < low[axis] || box.low[axis] > high[axis]) return false;
  return true;
}

} // namespace

SheetBuilder::SheetBuilder(Stage const& stage, Waves const& waves, std::vector<int> const& spectrum,
                           Places const& places, Limits const& limits, double error,
                           ChainTable& chains)
    : stage_(stage),
      waves_(waves),
      spectrum_(spectrum),
      ends_{spectrum.front(), spectrum.back()},
      places_(places),
      limits_(limits),
      error_(error),
      chains_(chains),
      paths_(stage, waves, limits),
      forced_(stage, waves) {}

std::uint64_t SheetBuilder::key_of(Cell const& cell, int node) const {
  int const shift = grid_level - 1 - cell.level;
  std::uint64_t const x = (2 * std::uint64_t{cell.i} + static_cast<unsigned>(node % 3)) << shift,
                      y = (2 * std::uint64_t{cell.j} + static_cast<unsigned>(node / 3)) << shift;
  return static_cast<std::uint64_t>(cell.face) << 52 | x << 26 | y;
}

Emission::Place SheetBuilder::place_of(Cell const& cell, int node) const {
  return {cell.face, cell.low() + 0.5 * cell.size() * node_place(node)};
}

int SheetBuilder::find_root_level() const {
  // Two nodes for the smallest caster.
  double least = 1;
  for (Ball const& ball : places_.casters) {
    double size = 0;
    if (emission_->parallel()) {
      double const half = 0.5 * glm::length(places_.casters_hull.high - places_.casters_hull.low);
      size = ball.radius / half;
    } else {
      double const distance = glm::length(ball.centre - emission_->origin({}));
      size = distance > ball.radius ? ball.radius / distance : 1;
    }
    least = std::min(least, size);
  }
  return std::clamp(static_cast<int>(std::ceil(std::log2(2 / least))), 3, 12);
}

void SheetBuilder::roots(Cell const& cell, std::vector<std::uint32_t> const& balls, int level) {
  std::vector<std::uint32_t> near;
  for (std::uint32_t const ball : balls)
    if (emission_->may_meet(cell.face, cell.low(), cell.high(), places_.casters[ball]))
      near.push_back(ball);
  if (near.empty()) return;
  if (cell.level == level) {
    next_.push_back({cell, 0});
    return;
  }
  for (std::uint32_t k = 0; k < 4; ++k)
    roots({cell.face, cell.level + 1, 2 * cell.i + k % 2, 2 * cell.j + k / 2}, near, level);
}

void SheetBuilder::trace_nodes(std::vector<Work> const& cells) {
  LightPaths::Starts starts;
  starts.each = static_cast<std::size_t>(stage_.channels);
  starts.in_order = true;
  starts.lamp = static_cast<std::size_t>(lamp_);
  std::vector<std::uint32_t> node_of;
  std::size_t const ends = ends_[0] == ends_[1] ? 1 : 2;
  auto const finish = [&] {
    std::vector<LightPaths::Segment> segments;
    paths_.branches(starts, chains_, segments);
    for (auto const& s : segments) {
      Node& node = nodes_[node_of[s.ray]];
      auto const end = static_cast<std::uint8_t>(1U << (ends == 2 ? s.ray % 2 : 0));
      auto const known = std::find_if(node.begin(), node.end(),
                                      [&](Seen const& seen) { return seen.chain == s.chain; });
      double const way = std::isfinite(s.far) ? s.far : places_.far;
      if (known == node.end()) {
        node.push_back(
            {s.chain, end, s.power, s.far, s.receives, s.origin, s.origin + way * s.direction});
        ++seen_by_[s.chain];
      } else {
        known->ends |= end;
        known->power = std::max(known->power, s.power);
        known->far = std::max(known->far, s.far);
        known->receives = known->receives || s.receives;
      }
    }
    starts.clear();
    node_of.clear();
  };
  for (Work const& work : cells)
    for (int k = 0; k < 9; ++k) {
      auto const [at, fresh] =
          known_.emplace(key_of(work.cell, k), static_cast<std::uint32_t>(nodes_.size()));
      if (!fresh) continue;
      nodes_.emplace_back();
      Emission::Place const place = place_of(work.cell, k);
      for (std::size_t end = 0; end < ends; ++end) {
        starts.origin.push_back(emission_->origin(place));
        starts.direction.push_back(emission_->direction(place));
        starts.wave.push_back(ends_[end]);
        for (int c = 0; c < stage_.channels; ++c)
          starts.channels.push_back(static_cast<std::uint16_t>(c));
        node_of.push_back(at->second);
      }
      if (starts.count() >= 2048) finish();
    }
  finish();
}

std::uint32_t SheetBuilder::sheet_over(Cell cell, int chain) const {
  for (; cell.level >= root_level_; cell = cell.parent())
    if (auto const known = emitted_.find(caustics::key_of(cell, chain)); known != emitted_.end())
      return known->second;
  return none;
}

SheetBuilder::Verdict SheetBuilder::judge(Cell const& cell, int chain,
                                          std::span<double const> ways) {
  Verdict out;
  Chain const& own = chains_[chain];
  bool const disperses = own.disperses && spectrum_.size() > 1;
  if (!disperses) {
    if (!nine(cell, chain, own.disperses ? spectrum_[0] : Waves::whole, out.rays[0])) return out;
    out.rays[1] = out.rays[0];
    out.to = 1;
  } else {
    auto const at = [&](int piece, std::size_t end) {
      return nine(cell, chain, spectrum_[static_cast<std::size_t>(piece)], out.rays[end]);
    };
    out.to = spectrum_pieces;
    bool const low = at(out.from, 0), high = at(out.to, 1);
    if (!low && !high) return out;
    if (low != high) {
      // A part of the spectrum is reflected totally: to where?
      int good = low ? out.from : out.to, bad = low ? out.to : out.from;
      while (std::abs(good - bad) > whole_pieces) {
        int const middle = (good + bad) / 2;
        (at(middle, low ? 1 : 0) ? good : bad) = middle;
      }
      (low ? out.to : out.from) = good;
      if (out.from == out.to || !at(good, low ? 1 : 0)) return out;
    }
  }
  std::size_t const ends = disperses ? 2 : 1;
  Vec3 mean{0};
  for (BeamRay const& ray : out.rays[0]) mean += ray.direction;
  for (auto const& of_end : out.rays)
    for (BeamRay const& ray : of_end)
      if (!(glm::dot(ray.direction, mean) > 0.5)) return out;
  out.ok = true;
  for (std::size_t end = 0; end < ends && out.ok; ++end)
    for (double const way : ways)
      if (!straight(out.rays[end], way)) {
        out.ok = false;
        break;
      }
  return out;
}

bool SheetBuilder::nine(Cell const& cell, int chain, int wave, Nine& out) {
  ForcedRays rays;
  if (!forced_.follow_nodes(chains_[chain], *emission_, cell, wave, rays)) return false;
  for (std::size_t k = 0; k < 9; ++k) out[k] = {rays.origin.get(k), rays.direction.get(k)};
  return true;
}

void SheetBuilder::emit_piece(Sheet sheet, int from, int to, Nine const& low, Nine const& high,
                              std::span<double const> ways, double far,
                              std::vector<Sheet>& sheets) {
  int const middle = (from + to) / 2;
  Nine between;
  if (to - from > whole_pieces
      && nine(sheet.cell, sheet.chain, spectrum_[static_cast<std::size_t>(middle)], between)
      && !is_between(low, between, high, ways)) {
    emit_piece(sheet, from, middle, low, between, ways, far, sheets);
    emit_piece(sheet, middle, to, between, high, ways, far, sheets);
    return;
  }
  sheet.from = static_cast<double>(from) / spectrum_pieces;
  sheet.to = static_cast<double>(to) / spectrum_pieces;
  sheet.length = far;
  sheet.set({low, high});
  sheets.push_back(sheet);
}

void SheetBuilder::emit(Cell const& cell, int chain, Verdict const& verdict,
                        std::span<double const> ways, double far, std::vector<Sheet>& sheets) {
  emitted_.emplace(caustics::key_of(cell, chain), static_cast<std::uint32_t>(sheets.size()));
  Sheet sheet;
  sheet.lamp = lamp_;
  sheet.chain = chain;
  sheet.cell = cell;
  emit_piece(sheet, verdict.from, verdict.to, verdict.rays[0], verdict.rays[1], ways, far, sheets);
  if (!chains_[chain].disperses || spectrum_.size() == 1) sheets.back().to = 1;
}

void SheetBuilder::look(Work& work, std::vector<Sheet>& sheets) {
  struct Of {
    int nodes = 0;
    double power = 0, near = INFINITY, far = 0;
    bool receives = false, all_ends = true, ends_nowhere = false;
    Vec3 low{INFINITY}, high{-INFINITY};
  };
  std::map<int, Of> chains; // in their order: what is found has no other
  for (int k = 0; k < 9; ++k)
    for (Seen const& seen : nodes_[known_.at(key_of(work.cell, k))]) {
      Of& of = chains[seen.chain];
      ++of.nodes;
      of.power = std::max(of.power, seen.power);
      of.receives = of.receives || seen.receives;
      of.low = glm::min(of.low, glm::min(seen.origin, seen.landing));
      of.high = glm::max(of.high, glm::max(seen.origin, seen.landing));
      if (std::isfinite(seen.far)) {
        of.near = std::min(of.near, seen.far);
        of.far = std::max(of.far, seen.far);
      } else {
        of.ends_nowhere = true;
      }
      of.all_ends = of.all_ends && (ends_[0] == ends_[1] || seen.ends == 3);
    }
  double const size = work.cell.size();
  double const flux =
      emission_->density({work.cell.face, 0.5 * (work.cell.low() + work.cell.high())}) * size
      * size;
  work.bad = 0;
  for (auto& [chain, of] : chains) {
    bool wanted = of.receives;
    auto const& boxes = places_.receivers.boxes();
    for (std::size_t k = 0; !wanted && k < boxes.size(); ++k)
      wanted = meets(boxes[k], of.low, of.high);
    if (!wanted) continue;
    std::uint32_t over = sheet_over(work.cell, chain);
    bool ok = over != none;
    double far = of.ends_nowhere ? std::max(of.far, places_.far) : of.far;
    if (of.nodes < 9) far = 2 * far;
    if (!ok) {
      if (of.far == 0) of.near = of.far = places_.size;
      std::array const ways{of.near, 0.5 * (of.near + of.far), far};
      Verdict verdict = judge(work.cell, chain, ways);
      ok = verdict.ok;
      if (ok) {
        Cell cell = work.cell;
        while (cell.level > root_level_) {
          Verdict above = judge(cell.parent(), chain, ways);
          if (!above.ok) break;
          cell = cell.parent();
          verdict = above;
        }
        over = static_cast<std::uint32_t>(sheets.size());
        emit(cell, chain, verdict, ways, 1.0625 * far, sheets);
      }
    }
    if (over != none) sheets[over].length = std::max(sheets[over].length, 1.0625 * far);
    // A whole cell tells how large a piece comes through; a part of one, where no cell is whole.
    bool const whole = of.nodes == 9 && of.all_ends;
    if (over != none) {
      // Each leaf adds its own: a cell that is cut does not.
      sheets[over].flux += flux * of.power * of.nodes / 9;
      sheets[over].power = std::max(sheets[over].power, of.power);
      double& grain = sheets[over].grain; // below zero while no cell was whole
      if (whole)
        grain = std::max(grain, size);
      else if (grain <= 0)
        grain = grain == 0 ? -size : std::max(grain, -size);
    }
    if (!ok)
      work.bad += flux * of.power * of.nodes / 9;
    else if (of.nodes < 9 || !of.all_ends)
      work.bad += flux * of.power * std::min(of.nodes, 9 - of.nodes) / 9;
    if (seen_by_[chain] == 1)
      flux_of_[chain] = flux * of.power / 9;
    else
      flux_of_.erase(chain);
  }
}

double SheetBuilder::drop_weak(std::vector<Sheet>& sheets, double total) const {
  std::map<int, double> flux;
  for (Sheet const& sheet : sheets) flux[sheet.chain] += sheet.flux;
  std::vector<std::pair<double, int>> chains;
  for (auto const& [chain, sum] : flux) chains.emplace_back(sum, chain);
  std::ranges::sort(chains);
  double dropped = 0;
  std::vector<int> weak;
  for (auto const& [sum, chain] : chains) {
    if (dropped + sum > weak_share * error_ * total) break;
    dropped += sum;
    weak.push_back(chain);
  }
  std::erase_if(sheets, [&](Sheet const& sheet) {
    return std::ranges::find(weak, sheet.chain) != weak.end();
  });
  return dropped / total;
}

Found SheetBuilder::build(int lamp, Emission const& emission, std::vector<Sheet>& sheets) {
  lamp_ = lamp;
  emission_ = &emission;
  known_.clear();
  nodes_.clear();
  emitted_.clear();
  seen_by_.clear();
  flux_of_.clear();
  next_.clear();
  Found found;
  root_level_ = find_root_level();
  std::vector<std::uint32_t> balls(places_.casters.size());
  for (std::size_t k = 0; k < balls.size(); ++k) balls[k] = static_cast<std::uint32_t>(k);
  for (int face = 0; face < emission.faces(); ++face)
    roots({face, 0, 0, 0}, balls, std::min(root_level_ + first_look, deepest));
  double total = 0;
  for (Work const& work : next_) {
    double const size = work.cell.size();
    total += size * size
             * emission.density({work.cell.face, 0.5 * (work.cell.low() + work.cell.high())});
  }
  std::size_t const first = sheets.size();
  while (!next_.empty()) {
    std::vector<Work> const now = std::move(next_);
    next_.clear();
    trace_nodes(now);
    found.cells += now.size();
    std::vector<Work> bad;
    double sum = 0;
    for (Work work : now) {
      look(work, sheets);
      if (work.bad > 0) {
        bad.push_back(work);
        sum += work.bad;
      }
    }
    found.full = sheets.size() - first > most_sheets;
    found.full = found.full || found.cells > most_cells;
    bool const enough = found.missing + sum / total <= error_;
    if (enough || found.full || now.front().cell.level >= deepest) {
      found.missing += sum / total;
      break;
    }
    // What matters least is given up.
    std::stable_sort(bad.begin(), bad.end(),
                     [](Work const& a, Work const& b) { return a.bad < b.bad; });
    double const spare = error_ / deepest * total;
    double given_up = 0;
    std::size_t kept = 0;
    while (kept < bad.size() && given_up + bad[kept].bad <= spare) given_up += bad[kept++].bad;
    found.missing += given_up / total;
    for (Work const& work : std::span(bad).subspan(kept))
      for (std::uint32_t k = 0; k < 4; ++k)
        next_.push_back({{work.cell.face, work.cell.level + 1, 2 * work.cell.i + k % 2,
                          2 * work.cell.j + k / 2},
                         0});
  }
  for (auto const& [chain, flux] : flux_of_) found.missing += flux / total;
  // What stands within a larger sheet of the same chain is that sheet's.
  std::vector<Sheet> kept;
  for (std::size_t k = first; k < sheets.size(); ++k) {
    Sheet const& sheet = sheets[k];
    std::uint32_t const over =
        sheet.cell.level > root_level_ ? sheet_over(sheet.cell.parent(), sheet.chain) : none;
    if (over != none) {
      sheets[over].grain = std::max(sheets[over].grain, sheet.grain);
      sheets[over].power = std::max(sheets[over].power, sheet.power);
      sheets[over].length = std::max(sheets[over].length, sheet.length);
      continue;
    }
    kept.push_back(sheet);
  }
  for (std::size_t k = 0; k < kept.size(); ++k) {
    // Pieces of the spectrum share what the first of them knows.
    bool const piece =
        k > 0 && kept[k].chain == kept[k - 1].chain && kept[k].cell == kept[k - 1].cell;
    kept[k].grain = std::abs(piece ? kept[k - 1].grain : kept[k].grain);
    if (!piece) continue;
    kept[k].length = kept[k - 1].length;
    kept[k].power = kept[k - 1].power;
  }
  found.missing += drop_weak(kept, total);
  sheets.resize(first);
  for (Sheet& sheet : kept) sheet.far += sheet.length;
  sheets.insert(sheets.end(), kept.begin(), kept.end());
  found.rays = paths_.rays() + forced_.rays();
  found.cut = paths_.cut() / std::max<double>(1, static_cast<double>(nodes_.size()));
  return found;
}

} // namespace abbe::transport::caustics
