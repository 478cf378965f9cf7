// SPDX-License-Identifier: MIT
#include "transport/caustics/connector.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::transport::caustics {
namespace {

/// How far outside of a triangle of nodes a guess may be: the map is not quite what they say.
constexpr double most_slack = 0.5, flat_slack = 0.25;
constexpr int most_turns = 40;
/// Area of a map beside the square of its length.
constexpr double thin = 0.05;
/// How far from where it is a root of a map may be inside of a cell, in half sides of it.
constexpr double most_astray = 0x1p-6;

using Axes = std::pair<Vec3, Vec3>;

/// By how much a ray passes a point, on two axes across another ray.
Vec2 passes(Axes const& axes, Vec3 const& point, Vec3 const& origin, Vec3 const& direction) {
  Vec3 const from = point - origin;
  Vec3 const off = from - glm::dot(from, direction) * direction;
  return {glm::dot(off, axes.first), glm::dot(off, axes.second)};
}

/// Of half a cell: far more than a root is off; and than polynomials are.
constexpr double at_edge = 0x1p-16, at_edge_of_map = 0x1p-7;

double edge_of(Sheet const& sheet) {
  return sheet.map >= 0 ? at_edge_of_map : at_edge;
}

} // namespace

Connector::Connector(Stage const& stage, Caustics const& caustics, Waves const& waves)
    : stage_(stage),
      caustics_(caustics),
      waves_(waves),
      forced_(stage, waves),
      paths_(stage, waves, caustics.limits()),
      scratch_(geometry::World::make_scratch()) {}

void Connector::guess(Sheet const& sheet, std::uint32_t ask, std::uint32_t number,
                      Vec3 const& point, double weight) {
  if (weight < sheet.from || weight > sheet.to) return;
  double const own = (weight - sheet.from) / (sheet.to - sheet.from);
  Vec3 const from = point - sheet.middle;
  auto const ahead = static_cast<float>(glm::dot(from, sheet.along)),
             px = static_cast<float>(glm::dot(from, sheet.across)),
             py = static_cast<float>(glm::dot(from, sheet.up)), share = static_cast<float>(own);
  float x[9], y[9];
  float low_x = INFINITY, high_x = -INFINITY, low_y = INFINITY, high_y = -INFINITY;
  for (std::size_t k = 0; k < 9; ++k) {
    auto const pass = [&](auto const& at, auto const& slope, float p) {
      float const low = at[k] + ahead * slope[k], high = at[k + 9] + ahead * slope[k + 9];
      return low + share * (high - low) - p;
    };
    x[k] = pass(sheet.x, sheet.slope_x, px);
    y[k] = pass(sheet.y, sheet.slope_y, py);
    low_x = std::min(low_x, x[k]);
    high_x = std::max(high_x, x[k]);
    low_y = std::min(low_y, y[k]);
    high_y = std::max(high_y, y[k]);
  }
  float const more_x = sheet.margin * (high_x - low_x), more_y = sheet.margin * (high_y - low_y);
  if (low_x - more_x > 0 || high_x + more_x < 0 || low_y - more_y > 0 || high_y + more_y < 0)
    return;
  std::array<Vec2, 9> q;
  for (std::size_t k = 0; k < 9; ++k) q[k] = {x[k], y[k]};
  struct Guess {
    double slack;
    Vec2 at;
  };
  std::array<Guess, 8> guesses;
  bool left = false, right = false;
  for (std::size_t k = 0; k < 8; ++k) {
    auto const& corners = sheet_triangles[k];
    auto const corner = [&](std::size_t i) { return q[static_cast<std::size_t>(corners[i])]; };
    Vec2 const u = corner(1) - corner(0), v = corner(2) - corner(0), w = -corner(0);
    double const turn = u.x * v.y - u.y * v.x;
    left = left || turn > 0;
    right = right || turn < 0;
    double const s = (w.x * v.y - w.y * v.x) / turn, t = (u.x * w.y - u.y * w.x) / turn;
    Vec2 const a = node_place(corners[0]), b = node_place(corners[1]), c = node_place(corners[2]);
    double const least = std::min({s, t, 1 - s - t});
    guesses[k] = {std::isfinite(least) ? -least : INFINITY, a + s * (b - a) + t * (c - a)};
  }
  auto const add = [&](Vec2 const& at) {
    Task task;
    task.ask = ask;
    task.sheet = number;
    Vec2 const inside = glm::clamp(at, Vec2(0), Vec2(2));
    task.u = sheet.cell.low() + 0.5 * sheet.cell.size() * inside;
    task.rest = INFINITY;
    tasks_.push_back(task);
  };
  if (left && right) {
    for (Guess const& one : guesses)
      if (one.slack <= most_slack) add(one.at);
    return;
  }
  // Where all nodes are nearly on a line, places in triangles tell little.
  Vec2 const by_x = q[5] - q[3], by_y = q[7] - q[1];
  if (std::abs(by_x.x * by_y.y - by_x.y * by_y.x)
      < thin * (glm::dot(by_x, by_x) + glm::dot(by_y, by_y))) {
    auto const nearest = std::min_element(q.begin(), q.end(), [](Vec2 const& i, Vec2 const& k) {
      return glm::dot(i, i) < glm::dot(k, k);
    });
    return add(node_place(static_cast<int>(nearest - q.begin())));
  }
  auto const best =
      std::min_element(guesses.begin(), guesses.end(),
                       [](auto const& a, auto const& b) { return a.slack < b.slack; });
  if (best->slack <= flat_slack) add(best->at);
}

std::array<double, 2> Connector::steps_of(Task const& task, double scale) const {
  Sheet const& sheet = sheet_of(task);
  double const root = std::ldexp(1.0, 1 - of_->root_level);
  double const size = sheet.cell.size();
  double const h =
      std::min(size / 8, scale * std::max(std::ldexp(root, -20), std::ldexp(1.0, -28)));
  // Toward the middle, where the chain is surely there.
  Vec2 const middle = 0.5 * (sheet.cell.low() + sheet.cell.high());
  return {task.u.x > middle.x ? -h : h, task.u.y > middle.y ? -h : h};
}

void Connector::put(Task const& task, Vec2 const& u, std::size_t at) {
  Emission::Place const place{sheet_of(task).cell.face, u};
  rays_.origin.set(at, of_->emission->origin(place));
  rays_.direction.set(at, of_->emission->direction(place));
  rays_.wave[at] = asks_->asks[task.ask].wave;
}

template <class Visit>
void Connector::by_chain(Task::State state, std::size_t most, Visit const& visit) {
  order_.clear();
  for (std::uint32_t k = 0; k < tasks_.size(); ++k)
    if (tasks_[k].state == state) order_.push_back(k);
  std::stable_sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
    return sheet_of(tasks_[a]).chain < sheet_of(tasks_[b]).chain;
  });
  for (std::size_t first = 0; first < order_.size();) {
    int const chain = sheet_of(tasks_[order_[first]]).chain;
    std::size_t last = first;
    while (last < order_.size() && last - first < most
           && sheet_of(tasks_[order_[last]]).chain == chain)
      ++last;
    visit(chain, std::span(order_).subspan(first, last - first));
    first = last;
  }
}

void Connector::advance(Task& task, std::size_t first, std::array<double, 2> const& h) {
  Sheet const& sheet = sheet_of(task);
  double const size = sheet.cell.size();
  using State = Task::State;
  if ((rays_.valid >> first & 7) != 7) {
    // Off the chain: half of the way back.
    if (task.turns == 0 || ++task.halved > 4) {
      task.state = State::Lost;
      return;
    }
    task.step *= 0.5;
    task.u -= task.step;
    return;
  }
  Vec3 const& x = point_of(task);
  Vec3 const d = rays_.direction.get(first);
  Axes const axes = axes_across(d);
  std::array<Vec2, 3> r;
  for (std::size_t k = 0; k < 3; ++k)
    r[k] = passes(axes, x, rays_.origin.get(first + k), rays_.direction.get(first + k));
  Vec2 const a = (r[1] - r[0]) / h[0], b = (r[2] - r[0]) / h[1];
  double const det = a.x * b.y - a.y * b.x;
  Vec2 step{(-r[0].x * b.y + r[0].y * b.x) / det, (-a.x * r[0].y + a.y * r[0].x) / det};
  double const rest = glm::length(r[0]);
  if (!std::isfinite(step.x) || !std::isfinite(step.y)) {
    task.state = State::Lost;
    return;
  }
  double const long_way = std::max(std::abs(step.x), std::abs(step.y));
  if (long_way > 0.7 * size) step *= 0.7 * size / long_way;
  task.slow = rest > 0.7 * task.rest ? task.slow + 1 : 0;
  task.rest = rest;
  task.u += step;
  task.step = step;
  task.halved = 0;
  ++task.turns;
  Vec2 const low = sheet.cell.low() - Vec2(0.6 * size), high = sheet.cell.high() + Vec2(0.6 * size);
  bool const inside =
      low.x <= task.u.x && task.u.x <= high.x && low.y <= task.u.y && task.u.y <= high.y;
  if (!inside || task.slow >= 3 || task.turns > most_turns)
    task.state = State::Lost;
  else if (long_way <= std::ldexp(size, -13))
    task.state = State::Found;
}

void Connector::iterate() {
  constexpr std::size_t most = chunk_width / 3;
  for (bool going = true; going;) {
    going = false;
    by_chain(Task::State::Going, most, [&](int chain, std::span<std::uint32_t const> some) {
      going = true;
      std::array<std::array<double, 2>, most> h;
      rays_.count = 3 * some.size();
      for (std::size_t k = 0; k < some.size(); ++k) {
        Task const& task = tasks_[some[k]];
        h[k] = steps_of(task, 1);
        put(task, task.u, 3 * k);
        put(task, task.u + Vec2(h[k][0], 0), 3 * k + 1);
        put(task, task.u + Vec2(0, h[k][1]), 3 * k + 2);
      }
      forced_.follow(caustics_.chains()[chain], rays_);
      for (std::size_t k = 0; k < some.size(); ++k) advance(tasks_[some[k]], 3 * k, h[k]);
    });
  }
}

void Connector::solve(Sheet const& sheet, BeamMap const& map, std::size_t first, Vec3 const& point,
                      double weight) {
  if (first == tasks_.size()) return;
  double const w = 2 * (weight - sheet.from) / (sheet.to - sheet.from) - 1;
  Vec3 const off = point - sheet.middle;
  Vec3 const local(glm::dot(off, sheet.across), glm::dot(off, sheet.up),
                   glm::dot(off, sheet.along));
  BeamMap::Passing const passing = map.passing(w, local);
  double const half = 0.5 * sheet.cell.size();
  Vec2 const middle = sheet.cell.low() + Vec2(half);
  // Where the map is nearly folded its polynomials may tell less than where the ray is.
  auto const astray = [&](BeamMap::Offset const& o, double det) {
    double const longest = glm::dot(o.by_u, o.by_u) + glm::dot(o.by_v, o.by_v);
    return map.off() * longest / std::abs(det);
  };
  for (std::size_t k = first; k < tasks_.size(); ++k) {
    Task& task = tasks_[k];
    task.state = Task::State::Lost;
    Vec2 u = (task.u - middle) / half;
    BeamMap::Offset o{};
    double rest = INFINITY, det = 0;
    int slow = 0;
    for (int turns = 0; turns < most_turns; ++turns) {
      o = BeamMap::offset(passing, u);
      det = o.by_u.x * o.by_v.y - o.by_u.y * o.by_v.x;
      Vec2 step{(-o.at.x * o.by_v.y + o.at.y * o.by_v.x) / det,
                (-o.by_u.x * o.at.y + o.by_u.y * o.at.x) / det};
      double const long_way = std::max(std::abs(step.x), std::abs(step.y));
      if (!std::isfinite(long_way)) {
        task.state = Task::State::Going;
        break;
      }
      if (long_way > 1.4) step *= 1.4 / long_way;
      double const now = glm::dot(o.at, o.at);
      slow = now > 0.5 * rest ? slow + 1 : 0;
      rest = now;
      u += step;
      if (!(std::abs(u.x) <= 2.2 && std::abs(u.y) <= 2.2) || slow >= 3) {
        if (!(astray(o, det) < 0.5)) task.state = Task::State::Going;
        break;
      }
      if (long_way > 0x1p-20) continue;
      double const by = astray(o, det);
      double const to_edge = std::abs(std::max(std::abs(u.x), std::abs(u.y)) - 1);
      if (!(by <= 0.5 * at_edge_of_map) && !(by <= most_astray && to_edge > 4 * by)) {
        task.state = Task::State::Going;
        break;
      }
      if (std::abs(u.x) <= 1 + at_edge_of_map && std::abs(u.y) <= 1 + at_edge_of_map)
        task.state = Task::State::Measured;
      break;
    }
    if (task.state != Task::State::Measured) continue;
    BeamMap::Ray const ray = map.ray(w, u);
    double const lean = std::sqrt(1 + ray[BeamMap::SlopeX] * ray[BeamMap::SlopeX]
                                  + ray[BeamMap::SlopeY] * ray[BeamMap::SlopeY]);
    Root& root = task.root;
    task.u = middle + half * u;
    root.ask = task.ask;
    root.sheet = task.sheet;
    root.chain = sheet.chain;
    root.turned = det < 0;
    root.spread = std::abs(det) / (half * half * lean);
    root.distance = (local.z - ray[BeamMap::Begin]) * lean;
    root.direction =
        (sheet.along + ray[BeamMap::SlopeX] * sheet.across + ray[BeamMap::SlopeY] * sheet.up)
        / lean;
    root.way = ray[BeamMap::Way];
    root.share = ray[BeamMap::Share];
    root.inside = {ray[BeamMap::Inside], ray[BeamMap::Inside2]};
    root.name = of_->emission->name({sheet.cell.face, task.u});
    if (!(root.distance > 0)) task.state = Task::State::Lost;
  }
}

void Connector::own() {
  using State = Task::State;
  // The owner of a root is the cell that it lies in; at its edge, within rounding, so is the next.
  for (Task& task : tasks_) {
    if (task.state != State::Found) continue;
    Sheet const& sheet = sheet_of(task);
    Cell const& cell = sheet.cell;
    Vec2 const at = 2.0 * (task.u - cell.low()) / cell.size();
    double const low = -edge_of(sheet), high = 2 + edge_of(sheet);
    if (!(at.x >= low && at.x <= high && at.y >= low && at.y <= high)) task.state = State::Lost;
  }
}

void Connector::measure() {
  using State = Task::State;
  by_chain(State::Found, chunk_width / 5, [&](int chain, std::span<std::uint32_t const> some) {
    rays_.count = 5 * some.size();
    std::array<std::array<double, 2>, chunk_width / 5> h;
    for (std::size_t k = 0; k < some.size(); ++k) {
      Task const& task = tasks_[some[k]];
      h[k] = steps_of(task, 8);
      put(task, task.u, 5 * k);
      for (std::size_t i = 0; i < 4; ++i) {
        double const side = i < 2 ? 1 : -1;
        Vec2 off{0};
        off[static_cast<int>(i % 2)] = side * h[k][i % 2];
        put(task, task.u + off, 5 * k + 1 + i);
      }
    }
    forced_.follow(caustics_.chains()[chain], rays_);
    for (std::size_t k = 0; k < some.size(); ++k) {
      Task& task = tasks_[some[k]];
      RaySet const valid = rays_.valid >> (5 * k);
      if ((valid & 7) != 7) {
        task.state = State::Lost;
        continue;
      }
      Vec3 const& x = point_of(task);
      Vec3 const o = rays_.origin.get(5 * k), d = rays_.direction.get(5 * k);
      Axes const axes = axes_across(d);
      auto const r = [&](std::size_t i) {
        return passes(axes, x, rays_.origin.get(5 * k + i), rays_.direction.get(5 * k + i));
      };
      // On one side alone where the other has no such rays.
      auto const slope = [&](std::size_t i) {
        bool const both = (valid >> (3 + i) & 1) != 0;
        return both ? (r(1 + i) - r(3 + i)) / (2 * h[k][i]) : (r(1 + i) - r(0)) / h[k][i];
      };
      Vec2 const a = slope(0), b = slope(1);
      double const det = a.x * b.y - a.y * b.x;
      task.root.ask = task.ask;
      task.root.sheet = task.sheet;
      task.root.chain = chain;
      task.root.turned = det < 0;
      task.root.spread = std::abs(det);
      task.root.distance = glm::dot(x - o, d);
      task.root.direction = d;
      task.root.way = rays_.length[5 * k];
      task.root.share = rays_.share[5 * k];
      task.root.inside = {rays_.inside[0][5 * k], rays_.inside[1][5 * k]};
      Emission::Place const place{sheet_of(task).cell.face, task.u};
      task.root.name = of_->emission->name(place);
      task.state = task.root.distance > 0 ? State::Measured : State::Lost;
    }
  });
}

void Connector::drop_twins() {
  using State = Task::State;
  // One that was found twice is one: others of the same chain and side are never so near.
  for (std::size_t k = 0; k < tasks_.size(); ++k) {
    Task& task = tasks_[k];
    if (task.state != State::Measured) continue;
    Sheet const& own = sheet_of(task);
    double const near = 8 * edge_of(own) * own.cell.size();
    for (std::size_t i = k; i-- > 0 && tasks_[i].ask == task.ask;) {
      Task const& other = tasks_[i];
      if (other.state == State::Measured && other.root.chain == task.root.chain
          && other.root.turned == task.root.turned
          && glm::distance(other.root.name, task.root.name)
                 <= std::max(near, 8 * edge_of(sheet_of(other)) * sheet_of(other).cell.size())) {
        task.state = State::Lost;
        break;
      }
    }
  }
}

void Connector::strengths(std::vector<Root>& roots) const {
  Lamp const& lamp = *stage_.lamps[lamp_];
  Vectors points, normals;
  Aim aim;
  Values strength;
  std::vector<Sheet> const& sheets = of_->index.sheets();
  for (std::size_t first = 0; first < roots.size(); first += chunk_width) {
    std::size_t const count = std::min(chunk_width, roots.size() - first);
    std::array<Emission::Place, chunk_width> places;
    for (std::size_t k = 0; k < count; ++k) {
      Root const& root = roots[first + k];
      // As if nothing had been in the way that the light has gone.
      Cell const& cell = sheets[root.sheet].cell;
      places[k].face = cell.face;
      Vec3 const origin = of_->emission->parallel()
                              ? of_->emission->origin({cell.face, Vec2(root.name.x, root.name.y)})
                              : of_->emission->origin({});
      Vec3 const way = of_->emission->parallel() ? of_->emission->direction({}) : root.name;
      points.set(k, origin + (root.way + root.distance) * way);
      normals.set(k, -way);
    }
    for (std::size_t k = count; k % 8 != 0; ++k) {
      points.set(k, points.get(count - 1));
      normals.set(k, normals.get(count - 1));
    }
    lamp.aim(points, normals, count, aim);
    bool const weakens = lamp.strengths(aim, first_rays(count), count, strength.value);
    for (std::size_t k = 0; k < count; ++k) {
      Root& root = roots[first + k];
      double const way = root.way + root.distance;
      double density = 0;
      if (of_->emission->parallel()) {
        density = of_->emission->density({});
      } else {
        // (1 + u^2)^(-3/2) of the place on its face is the largest component cubed.
        Vec3 const size = glm::abs(root.name);
        double const largest = std::max({size.x, size.y, size.z});
        density = largest * largest * largest * way * way;
      }
      root.flux = (weakens ? strength[k] : 1) * density;
    }
  }
}

void Connector::verify(Asks const& asks, std::vector<Root>& roots, std::vector<double>& light) {
  std::vector<std::uint32_t> of;
  for (std::uint32_t k = 0; k < tasks_.size(); ++k)
    if (tasks_[k].state == Task::State::Measured) of.push_back(k);
  if (of.empty()) return;
  std::size_t const first = roots.size();
  light.resize((first + of.size()) * asks.each);
  std::vector<std::uint8_t> real(of.size(), 0);
  follow_real(asks, of, real, light.data() + first * asks.each);
  look_back(asks, of, real);
  for (std::size_t i = 0; i < of.size(); ++i) {
    Root& root = tasks_[of[i]].root;
    root.real = real[i] != 0;
    roots.push_back(root);
    if (!root.real) continue;
    double* const own = light.data() + (first + i) * asks.each;
    Chain const& chain = caustics_.chains()[root.chain];
    Passage way{1, asks.each, asks.channels.data() + root.ask * asks.each, nullptr, own, true};
    if (sheet_of(tasks_[of[i]]).certain) {
      std::fill_n(own, asks.each, root.share);
      for (std::size_t m = 0; m < chain.absorbing.size(); ++m) {
        way.distance = &root.inside[m];
        Way::along(stage_.medium(chain.absorbing[m]), way);
      }
    }
    Step const& last = chain.steps.back();
    Medium const& medium = stage_.medium(last.mirror ? last.before : last.after);
    if (medium.segments.empty()) continue;
    way.distance = &root.distance;
    Way::along(medium, way);
    Way::leave(medium, way);
  }
}

void Connector::follow_real(Asks const& asks, std::vector<std::uint32_t> const& of,
                            std::vector<std::uint8_t>& real, double* light) {
  LightPaths::Starts starts;
  starts.each = asks.each;
  starts.in_order = asks.in_order;
  starts.lamp = lamp_;
  std::vector<std::uint32_t> followed;
  for (std::uint32_t i = 0; i < of.size(); ++i) {
    Task const& task = tasks_[of[i]];
    if (sheet_of(task).certain) {
      real[i] = 1;
      continue;
    }
    Emission::Place const place{sheet_of(task).cell.face, task.u};
    starts.origin.push_back(of_->emission->origin(place));
    starts.direction.push_back(of_->emission->direction(place));
    starts.wave.push_back(asks.asks[task.ask].wave);
    starts.target.push_back(task.root.chain);
    std::size_t const lane = task.ask * asks.each;
    starts.channels.insert(starts.channels.end(),
                           asks.channels.begin() + static_cast<std::ptrdiff_t>(lane),
                           asks.channels.begin() + static_cast<std::ptrdiff_t>(lane + asks.each));
    followed.push_back(i);
  }
  if (followed.empty()) return;
  paths_.along_targets(starts, caustics_.chains(), segments_, arrived_);
  for (auto const& segment : segments_) real[followed[segment.ray]] = 1;
  for (std::size_t k = 0; k < followed.size(); ++k)
    std::copy_n(arrived_.data() + k * asks.each, asks.each, light + followed[k] * asks.each);
}

void Connector::look_back(Asks const& asks, std::vector<std::uint32_t> const& of,
                          std::vector<std::uint8_t>& real) {
  // From the place, the first surface in the way of the light is the chain's last.
  std::vector<double> vectors[9];
  std::vector<geometry::RayStart> start;
  std::vector<std::uint32_t> looking;
  for (std::uint32_t i = 0; i < of.size(); ++i) {
    if (real[i] == 0) continue;
    Task const& task = tasks_[of[i]];
    LitPlace const& place = (*places_)[asks.asks[task.ask].place];
    Vec3 const back = -task.root.direction;
    for (int axis = 0; axis < 3; ++axis) {
      vectors[axis].push_back(place.point[axis]);
      vectors[3 + axis].push_back(back[axis]);
      vectors[6 + axis].push_back(place.point_error[axis]);
    }
    start.push_back(place.start);
    start.back().through = glm::dot(place.geometric, back) < 0;
    looking.push_back(i);
  }
  if (looking.empty()) return;
  auto const arrays = [&](int first) {
    return geometry::VectorArrays{vectors[first].data(), vectors[first + 1].data(),
                                  vectors[first + 2].data()};
  };
  geometry::RayLines const lines{looking.size(), arrays(0),    arrays(3),
                                 arrays(6),      start.data(), groups_};
  stage_.world->intersect(lines, light_bits, nullptr, *scratch_, hits_);
  for (std::size_t k = 0; k < looking.size(); ++k) {
    Root const& root = tasks_[of[looking[k]]].root;
    Step const& last = caustics_.chains()[root.chain].steps.back();
    geometry::RayHit const& hit = hits_.hit[k];
    bool is = hit.kind != geometry::RayHit::Kind::Nothing && hit.primitive == last.primitive;
    if (hit.kind == geometry::RayHit::Kind::Group)
      for (auto const& crossing : hits_.groups[hits_.group[k]].crossings)
        is = is || crossing.primitive == last.primitive;
    // Another crossing of the same surface is not as near as this.
    double const share = of_->index.sheets()[root.sheet].map >= 0 ? 0x1p-7 : 0x1p-16;
    double const close = share * root.distance + 16 * hits_.error[k];
    if (!is || !(std::abs(hits_.t[k] - root.distance) <= close)) real[looking[k]] = 0;
  }
}

void Connector::find(std::size_t lamp, std::vector<LitPlace> const& places,
                     geometry::Groups const& groups, Asks const& asks, std::vector<Root>& roots,
                     std::vector<double>& light) {
  lamp_ = lamp;
  of_ = &caustics_.lamps()[lamp];
  places_ = &places;
  groups_ = &groups;
  asks_ = &asks;
  roots.clear();
  light.clear();
  tasks_.clear();
  std::vector<Sheet> const& sheets = of_->index.sheets();
  for (std::uint32_t a = 0; a < asks.asks.size(); ++a) {
    Ask const& ask = asks.asks[a];
    for (std::uint32_t k = ask.first; k < ask.last; ++k) {
      SheetIndex::Over const& over = asks.sheets[k];
      if (!(over.from <= ask.weight && ask.weight <= over.to)) continue;
      Sheet const& sheet = sheets[over.sheet];
      std::size_t const before = tasks_.size();
      guess(sheet, a, over.sheet, places[ask.place].point, ask.weight);
      if (sheet.map >= 0)
        solve(sheet, of_->maps[static_cast<std::size_t>(sheet.map)], before,
              places[ask.place].point, ask.weight);
    }
  }
  iterate();
  own();
  measure();
  drop_twins();
  verify(asks, roots, light);
  strengths(roots);
}

} // namespace abbe::transport::caustics
