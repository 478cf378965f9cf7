// SPDX-License-Identifier: MIT
#include "study/way.hpp"

#include <array>

namespace abbe::study {
namespace {

using Mode = scene::DispersionMode;
using Follow = optics::Comb::Follow;

Mode none(double) {
  Mode mode;
  mode.kind = Mode::Kind::None;
  return mode;
}
Mode deterministic(double) {
  Mode mode;
  mode.kind = Mode::Kind::Deterministic;
  return mode;
}
Mode adaptive(double tolerance_px) {
  Mode mode;
  mode.kind = Mode::Kind::Adaptive;
  mode.tolerance_px = tolerance_px;
  return mode;
}
Mode drawn(int teeth, Follow follow) {
  Mode mode;
  mode.kind = Mode::Kind::Stochastic;
  mode.comb.teeth = teeth;
  mode.comb.follow = follow;
  return mode;
}
Mode rays(double teeth) {
  return drawn(static_cast<int>(teeth), Follow::Every);
}
Mode clusters(double teeth) {
  return drawn(static_cast<int>(teeth), Follow::Importance);
}
Mode hero(double teeth) {
  return drawn(static_cast<int>(teeth), Follow::Hero);
}

constexpr std::array one_step{0.0};
constexpr std::array rays_steps{1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0};
constexpr std::array cluster_steps{8.0};
constexpr std::array hero_steps{4.0};
constexpr std::array tolerance_steps{2.0, 0.5, 0.25};

constexpr std::array table{
    Way{"none", none, one_step, 8},
    Way{"stochastic rays", rays, rays_steps, 8},
    Way{"deterministic", deterministic, one_step, 4},
    Way{"clusters", clusters, cluster_steps, 4},
    Way{"hero", hero, hero_steps, 4},
    Way{"adaptive", adaptive, tolerance_steps, 16},
};
constexpr Way as_it_is{"", nullptr, one_step, 4};

} // namespace

std::span<Way const> ways() {
  return table;
}

Way const& way_of_the_scene() {
  return as_it_is;
}

} // namespace abbe::study
