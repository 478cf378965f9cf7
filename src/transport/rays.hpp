// SPDX-License-Identifier: MIT
#pragma once

#include "geometry/batch.hpp"

#include <compare>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace abbe::transport {

/// The wavelengths that the lanes of a ray stand for, as number of a wave table (wave_tables.hpp).
/// Polychromatic: the whole of each channel; a ray that no dispersing surface has split yet.
inline constexpr int polychromatic = -2;
/// The mean wavelength of each channel: the deterministic modes.
inline constexpr int band_means = -1;
/// Of light that no stochastic material has met.
inline constexpr int no_comb = -1;

/// What the light of all rays of a queue has in common.
///
/// A polychromatic ray has a lane a channel, or a tooth of a comb, in order; a monochromatic one
/// has one lane, several where neighbouring bands share a route (the adaptive mode), and the
/// published stochastic scheme (optics::Comb::Follow::Doubled) has two lanes on one ray: the bands
/// between which its wavelength falls.
struct LightKind {
  int lanes = 0;
  int wave = polychromatic;
  /// Light that met a stochastic material keeps the wavelengths that were drawn there, whatever it
  /// meets later.
  int comb = no_comb;
  /// Not to be split again: false for polychromatic light and for the published scheme's doubled
  /// rays before their second refraction.
  bool locked = false;
  /// The companion of light that met a stochastic material: it goes on as if such materials did not
  /// disperse (SampleFilm says what for).
  bool control = false;

  auto operator<=>(LightKind const&) const = default;
  bool monochromatic() const { return wave != polychromatic; }
  std::size_t size() const { return static_cast<std::size_t>(lanes); }
  /// Each lane is a channel, from the first to the last.
  bool in_order() const { return !monochromatic() && (comb == no_comb || control); }
  /// Each lane's channel is listed (Rays::channels); else they follow the first one by one.
  bool listed() const { return comb != no_comb && !control && lanes > 1; }
};

/// Rays of one kind on their way, in any number; values a ray stand side by side. Adding to them
/// moves the arrays.
class Rays {
public:
  /// What only some scenes ask for.
  struct Fields {
    bool travelled = false, path = false, rest = false;
  };
  Rays(LightKind const& kind, Fields fields) : kind_(kind), fields_(fields) {}

  LightKind const& kind() const { return kind_; }
  Fields const& fields() const { return fields_; }
  std::size_t count() const { return count_; }
  void clear() { count_ = 0; }
  /// Room for some more. @return the place of the first
  std::size_t add(std::size_t some);
  geometry::RayLines lines(geometry::Groups const& groups) const {
    return {count_, origin, direction, origin_error, start.data(), &groups};
  }
  /// Adds a ray that others of the same kind have.
  void copy(Rays const& from, std::size_t place) { put(add(1), from, place); }
  /// A ray takes the place of another.
  void move(std::size_t from, std::size_t to) {
    if (from != to) put(to, *this, from);
  }
  void keep_first(std::size_t count) { count_ = count; }
  double* light_of(std::size_t k) { return light.data() + k * kind_.size(); }
  double const* light_of(std::size_t k) const { return light.data() + k * kind_.size(); }

  geometry::VectorArrays origin, direction, origin_error;
  std::vector<geometry::RayStart> start;
  std::vector<std::uint32_t> stack;    ///< what it is inside of (MediaStacks)
  std::vector<std::uint32_t> slot;     ///< of the film, of the first lane; the others follow
  std::vector<std::uint16_t> channel;  ///< of materials and lights, of the first lane
  std::vector<std::uint16_t> tooth;    ///< of the wave table, of the first lane
  std::vector<std::uint16_t> level;    ///< how often it was bent or mirrored
  std::vector<double> light;           ///< throughput, a value a lane
  std::vector<std::uint16_t> channels; ///< of each lane, where they are listed
  std::vector<double> travelled;       ///< before the origin, since the last real surface
  std::vector<std::uint32_t> path;     ///< of Paths
  std::vector<double> rest;            ///< way to the lamp

private:
  void grow(std::size_t room);
  void put(std::size_t to, Rays const& from, std::size_t place);

  LightKind kind_;
  Fields fields_;
  std::size_t count_ = 0, room_ = 0;
  std::vector<double> vectors_[9];
};

/// Rays by what they have in common.
template <class Key>
class Queues {
public:
  Rays& of(Key const& key, LightKind const& kind, Rays::Fields const& fields) {
    auto& rays = rays_[key];
    if (!rays) rays = std::make_unique<Rays>(kind, fields);
    return *rays;
  }
  /// visit(key, rays) in the order of the keys, of those that have rays.
  template <class Visit>
  void each(Visit&& visit) {
    for (auto& [key, rays] : rays_)
      if (rays->count() > 0) visit(key, *rays);
  }
  std::size_t count() const {
    std::size_t sum = 0;
    for (auto const& [key, rays] : rays_) sum += rays->count();
    return sum;
  }
  void clear() {
    for (auto& [key, rays] : rays_) rays->clear();
  }

private:
  std::map<Key, std::unique_ptr<Rays>> rays_;
};

} // namespace abbe::transport
