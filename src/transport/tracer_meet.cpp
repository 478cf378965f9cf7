// SPDX-License-Identifier: MIT
#include "transport/sky.hpp"
#include "transport/tracer.hpp"

#include <algorithm>
#include <utility>

/// What happens where rays meet a surface: Fresnel and Snell, textures, then the mirrored and the
/// onward rays, split by wavelength where the material disperses.
namespace abbe::transport {

void Tracer::meet(BucketKey const& key) {
  chunk_.medium_before = key.before;
  chunk_.medium_after = key.after;
  bool const displaced = key.kind == BucketKey::Kind::Displaced
                         || (key.kind == BucketKey::Kind::Several && chunk_.crossings.empty());
  travel(displaced ? 0 : key.left);
  if (key.kind == BucketKey::Kind::Nothing) return escape();
  if (displaced) return pass_on();
  find_normals();
  Face const face = face_of(chunk_.kind);
  if (face.splits && face.comb != no_comb && chunk_.kind.comb == no_comb)
    meet_comb(face);
  else
    share(face);
}

void Tracer::pass_air() {
  if (air_.rays == 0) return;
  Chunk const& c = chunk_;
  auto* const left = arena_.take<double>(c.lanes());
  auto* const added = arena_.take<double>(c.lanes());
  std::fill_n(left, c.lanes(), 1.0);
  std::fill_n(added, c.lanes(), 0.0);
  AirWay const way{c.each,     air_.rays, &air_.origin, &c.direction, air_.distance.value,
                   c.channels, left,      added};
  for (auto const& effect : stage_.air) effect->along(way);
  each_of(air_.rays, [&](std::size_t r) {
    for (std::size_t i = 0, k = r * c.each; i < c.each; ++i, ++k) {
      double const gained = c.light[k] * added[k];
      film_[c.slot[r] + static_cast<std::uint32_t>(i)] += gained;
      if (paths_.records())
        paths_.add(c.path[r], gained, film_.is_sample(film_.block_of(c.slot[r])));
      c.light[k] *= left[k];
    }
  });
}

void Tracer::travel(int left) {
  if (!stage_.air.empty()) pass_air();
  Passage way{chunk_.count, chunk_.each, chunk_.channels, chunk_rest_.value, chunk_.light, false};
  Way::along(stage_.medium(chunk_.medium_before), way);
  if (left == 0) return;
  way.distance = chunk_way_.value;
  Way::leave(stage_.medium(left), way);
}

void Tracer::escape() {
  if (!has_sky(stage_)) return;
  Chunk const& c = chunk_;
  auto* const light = arena_.take<double>(c.each);
  for (std::size_t r = 0; r < c.count; ++r) {
    find_sky(stage_, arena_, c.direction.get(r), c.channels + r * c.each, c.each, light);
    for (std::uint32_t k = 0; k < c.each; ++k) {
      double const added = c.light[r * c.each + k] * light[k];
      film_[c.slot[r] + k] += added;
      if (paths_.records())
        paths_.add(c.path[r], added, film_.is_sample(film_.block_of(c.slot[r])));
    }
  }
}

void Tracer::pass_on() {
  Chunk const& c = chunk_;
  Departing out = emitter_.room(c.kind, c.count);
  out.count = c.count;
  for (std::size_t r = 0; r < c.count; ++r) {
    out.ray[r] = static_cast<std::uint32_t>(r);
    out.x[r] = c.direction.x[r];
    out.y[r] = c.direction.y[r];
    out.z[r] = c.direction.z[r];
    out.level[r] = c.level[r];
    out.slot[r] = c.slot[r];
    out.channel[r] = c.channels[r * c.each];
    out.tooth[r] = c.tooth[r];
  }
  out.light = c.light;
  if (c.kind.listed()) out.channels = c.channels;
  emitter_.send(c, out);
}

Tracer::Face Tracer::face_of(LightKind const& kind) const {
  Face face;
  int const number_before = chunk_.medium_before, number_after = chunk_.medium_after;
  Medium const &before = stage_.medium(number_before), &after = stage_.medium(number_after);
  face.fresnel = before.fresnel || after.fresnel;
  face.governing = after.dispersive ? &after : &before;
  bool const disperses =
      number_before != number_after && !kind.locked && face.governing->dispersive;
  face.comb = kind.comb != no_comb ? kind.comb : face.governing->comb;
  face.split_wave = band_means;
  // The companion of a comb goes on as if nothing dispersed.
  face.splits = disperses && !(kind.control && face.comb != no_comb);
  if (!disperses || face.comb == no_comb) return face;
  optics::Comb const& comb = stage_.comb(face.comb);
  face.doubles = comb.follow == optics::Comb::Follow::Doubled;
  face.picks = comb.picks_one();
  face.split_wave = face.doubles && kind.comb != no_comb ? waves_.second_draw(face.comb)
                                                         : waves_.first_draw(face.comb);
  return face;
}

void Tracer::find_indices() {
  Chunk& c = chunk_;
  auto const find = [&](int number, Values& out) {
    Medium const& medium = stage_.medium(number);
    if (medium.dispersive && c.kind.monochromatic()) {
      if (c.kind.wave == band_means)
        for (std::size_t r = 0; r < c.count; ++r) out[r] = medium.index[c.tooth[r]];
      else
        for (std::size_t r = 0; r < c.count; ++r)
          out[r] = waves_.index(number, c.kind.wave, c.sample[r], c.tooth[r]);
    } else {
      std::fill_n(out.value, c.count, medium.index_d);
    }
    for (std::size_t r = c.count; r % 8 != 0; ++r) out[r] = out[c.count - 1];
  };
  find(c.medium_before, c.n1);
  find(c.medium_after, c.n2);
  refract_rays(c);
}

Shares Tracer::split_lanes(Face const& face) {
  Chunk const& c = chunk_;
  std::size_t const each = c.each, lanes = c.lanes() + 8, whole = (each + 3) / 4 * 4;
  auto const values = [&](std::size_t count) { return arena_.take<double>(count); };
  double *const n1 = values(whole), *const n2 = values(whole);
  Shares out;
  SplitLanes& ways = out.ways;
  ways = {values(lanes), values(lanes), arena_.take<bool>(lanes),
          values(lanes), values(lanes), values(lanes)};
  bool const by_sample = face.comb != no_comb;
  for (std::size_t r = 0; r < c.count; ++r) {
    if (r == 0 || (by_sample && (c.sample[r] != c.sample[r - 1] || c.doubles))) {
      auto const take = [&](int medium, double* to) {
        auto const indices = waves_.indices(medium, face.split_wave, c.sample[r]);
        for (std::size_t k = 0; k < whole; ++k)
          to[k] = indices[static_cast<std::size_t>(c.tooth_of(r, std::min(k, each - 1)))];
      };
      take(c.medium_before, n1);
      take(c.medium_after, n2);
    }
    std::size_t const at = r * each;
    refract_lanes(c, r, n1, n2,
                  {ways.reflectance + at, ways.transmittance + at, ways.total + at, ways.x + at,
                   ways.y + at, ways.z + at});
  }
  return out;
}

SurfaceLight Tracer::shade_chunk(Face const& face, Shares const& shares, bool lit) {
  Chunk const& c = chunk_;
  LaneReflectance const reflectance{face.splits ? shares.ways.reflectance : nullptr,
                                    c.reflectance.value};
  caustics::CausticLights* const thrown = lit ? caustic_lights_.get() : nullptr;
  if (thrown != nullptr) thrown->look_at(c, starts_);
  SurfaceLight const surface = shade(stage_, arena_, aims_, c, reflectance, lit, thrown);
  if (surface.own != nullptr)
    for (std::size_t r = 0, k = 0; r < c.count; ++r)
      for (std::uint32_t i = 0; i < c.each; ++i, ++k) {
        film_[c.slot[r] + i] += surface.own[k];
        if (paths_.records())
          paths_.add(c.path[r], surface.own[k], film_.is_sample(film_.block_of(c.slot[r])));
      }
  for (std::size_t lamp = 0; lamp < stage_.lamps.size(); ++lamp) {
    if (surface.of_lamp[lamp] == nullptr) continue;
    RaySet const rays = surface.lit[lamp];
    if (stage_.lamps[lamp]->area() == nullptr)
      emitter_.counts.shadow += static_cast<std::uint64_t>(std::popcount(rays));
    each_of(rays, [&](std::size_t r) { emitter_.count_ray(c.sample[r]); });
    shadows_.add(c, lamp, aims_[lamp], rays, surface.of_lamp[lamp]);
  }
  return surface;
}

void Tracer::mirror(Face const& face, SurfaceLight const* surface, Shares const& shares) {
  Chunk const& c = chunk_;
  RaySet rays = shares.returning, bent = 0;
  RaySet const mirrors = surface != nullptr ? surface->mirrors & rays : 0;
  each_of(mirrors, [&](std::size_t r) {
    bool powers = surface->exponent[r] != 1;
    if (powers && face.splits)
      powers = std::none_of(shares.ways.total + r * c.each, shares.ways.total + (r + 1) * c.each,
                            [](bool total) { return total; });
    else if (powers)
      powers = (c.total >> r & 1) == 0;
    bent |= RaySet{powers} << r;
  });
  if (rays != 0)
    send_back(face, {1, shares.back, rays, bent, &c.mirrored,
                     surface != nullptr ? &surface->exponent : nullptr});
  if (surface == nullptr) return;
  for (OwnMirror const* const own : surface->own_mirrors) {
    auto* const light = arena_.take<double>(c.lanes() + 8);
    Mirrored mirrored{own->number, light, 0, 0, &own->way, &own->exponent};
    each_of(own->rays, [&](std::size_t r) {
      bool any = false;
      for (std::size_t k = r * c.each; k < (r + 1) * c.each; ++k) {
        light[k] = c.light[k] * own->light[k];
        any = any || light[k] != 0;
      }
      mirrored.rays |= RaySet{any} << r;
      mirrored.bent |= RaySet{any && own->exponent[r] != 1} << r;
    });
    if (mirrored.rays != 0) send_back(face, mirrored);
  }
}

void Tracer::send_back(Face const& face, Mirrored const& mirrored) {
  Chunk const& c = chunk_;
  if (mirrored.bent != 0) mirror_bent(face, mirrored);
  RaySet const rays = mirrored.rays & ~mirrored.bent;
  if (rays == 0) return;
  auto const send = [&](ChunkLight const& light, double const* values) {
    emitter_.send(c, Onward{light, light.slot, values, *mirrored.way, rays, rays, mirrored.number,
                            &RayCounts::reflected});
  };
  if (face.splits && face.doubles && c.kind.comb == no_comb) {
    ChunkLight const doubled = comb_light_.doubled(c, mirrored.light, face.comb);
    return send(doubled, doubled.light);
  }
  send(c, mirrored.light);
}

void Tracer::mirror_bent(Face const& face, Mirrored const& mirrored) {
  Chunk const& c = chunk_;
  double* const back = mirrored.light;
  LightKind const& kind = c.kind;
  // Light of combs that is met later would stand apart from the rest, and powers want the whole: it
  // is parted here, as by stochastic material.
  bool const meets =
      kind.comb == no_comb && !kind.locked && !stage_.combs.empty() && film_.has_control(0);
  bool const doubled = face.splits && face.doubles && kind.comb == no_comb;
  int const comb = doubled ? face.comb : 0;
  Arena::Scope const scope(arena_);
  ChunkLight const arrived = c;
  chunk_.light = back;
  ChunkLight parts[2] = {c, c};
  std::size_t count = 1;
  if (doubled || (meets && stage_.comb(0).follow == optics::Comb::Follow::Doubled)) {
    parts[0] = comb_light_.doubled(c, back, comb);
  } else if (meets) {
    parts[0] = comb_light_.teeth(c, 0);
  }
  if (meets && !doubled) parts[count++] = comb_light_.control(c, 0);
  each_of(mirrored.bent, [&](std::size_t r) {
    if (!any_above(back + r * arrived.each, arrived.each, stage_.adc_bailout))
      return emitter_.cut(arrived.slot[r], back + r * arrived.each, arrived.each);
    for (std::size_t i = 0; i < count; ++i) capture(parts[i], r, mirrored);
  });
  static_cast<ChunkLight&>(chunk_) = arrived;
}

void Tracer::capture(ChunkLight const& light, std::size_t r, Mirrored const& mirrored) {
  Chunk const& c = chunk_;
  std::size_t const n = light.each;
  std::uint16_t* const channels = light.channels + r * n;
  std::uint32_t const slot =
      captures_.add(light.kind, light.slot[r], channels, light.light + r * n,
                    (*mirrored.exponent)[r], paths_.records() ? c.path[r] : Paths::none);
  Departing out = emitter_.room(light.kind, 1);
  out.mirrored = mirrored.number;
  out.counted = &RayCounts::reflected;
  out.count = 1;
  out.ray[0] = static_cast<std::uint32_t>(r);
  out.x[0] = mirrored.way->x[r];
  out.y[0] = mirrored.way->y[r];
  out.z[0] = mirrored.way->z[r];
  out.level[0] = static_cast<std::uint16_t>(c.level[r] + 1);
  out.slot[0] = slot;
  out.channel[0] = channels[0];
  out.tooth[0] = light.tooth[r];
  if (light.kind.listed()) std::copy_n(channels, n, out.channels);
  std::fill_n(out.light, n, 1.0);
  emitter_.send(c, out);
}

void Tracer::go_on(Face const& face, Shares const& shares) {
  Chunk const& c = chunk_;
  std::size_t const n = c.each;
  if (shares.passing == 0) return;
  if (face.splits) {
    if (!c.kind.monochromatic())
      for (std::size_t r = 0; r < c.count; ++r)
        emitter_.counts.splits += any_above(shares.on + r * n, n, stage_.adc_bailout);
    SplitTools const tools{stage_, arena_, waves_, film_, emitter_, adaptive_};
    face.governing->policy->split(tools, {c, shares.on, shares.ways, face.split_wave, face.comb,
                                          face.governing->tolerance_px});
    return;
  }
  RaySet bent = 0;
  RaySet const rays = shares.passing & ~c.total;
  if (rays == 0) return;
  each_of(rays, [&](std::size_t r) { bent |= RaySet{c.n1[r] != c.n2[r]} << r; });
  std::uint32_t const* slot = c.slot;
  std::uint32_t picked[chunk_width];
  if (face.picks) {
    for (std::size_t r = 0; r < c.count; ++r)
      picked[r] =
          film_.picked_control_slot(film_.block_of(c.slot[r]), face.comb, c.channels[r * n]);
    slot = picked;
  }
  // Where nothing bends, the refracted direction is the ray's.
  emitter_.send(c,
                Onward{c, slot, shares.on, c.refracted, rays, bent, false, &RayCounts::refracted});
}

void Tracer::share(Face const& face) {
  Shares shares;
  if (face.splits)
    shares = split_lanes(face);
  else
    find_indices();
  if (is_bare(stage_, chunk_)) {
    find_shares(face, nullptr, shares);
    mirror(face, nullptr, shares);
  } else {
    SurfaceLight const surface = shade_chunk(face, shares, true);
    find_shares(face, &surface, shares);
    mirror(face, &surface, shares);
  }
  go_on(face, shares);
}

void Tracer::meet_comb(Face const& face) {
  // First its companion, which also carries what the surface adds.
  Chunk& c = chunk_;
  ChunkLight const arrived = c;
  Face flat = face;
  flat.splits = flat.doubles = false;
  find_indices();
  Shares shares;
  SurfaceLight surface;
  bool const bare = is_bare(stage_, chunk_);
  if (!bare) surface = shade_chunk(flat, shares, true);
  if (film_.has_control(face.comb)) {
    static_cast<ChunkLight&>(c) = comb_light_.control(c, face.comb);
    find_shares(flat, bare ? nullptr : &surface, shares);
    mirror(flat, bare ? nullptr : &surface, shares);
    go_on(flat, shares);
    static_cast<ChunkLight&>(c) = arrived;
  }
  // Then the light at the drawn wavelengths.
  if (!face.doubles) static_cast<ChunkLight&>(c) = comb_light_.teeth(c, face.comb);
  Shares own = split_lanes(face);
  if (!bare && surface.explicit_reflection != 0) { // it may mirror by its Fresnel reflectance
    surface = shade_chunk(face, own, false);
  } else if (!bare && !face.doubles) {
    auto const spread = [&](double*& lanes) {
      double const* const channels = std::exchange(lanes, arena_.take<double>(c.lanes() + 8));
      for (std::size_t r = 0, k = 0; r < c.count; ++r)
        for (std::size_t i = 0; i < c.each; ++i, ++k)
          lanes[k] = channels[r * arrived.each + c.channels[k]];
    };
    spread(surface.passed);
    spread(surface.mirrored);
    for (OwnMirror* const layer : surface.own_mirrors) spread(layer->light);
  }
  find_shares(face, bare ? nullptr : &surface, own);
  mirror(face, bare ? nullptr : &surface, own);
  go_on(face, own);
  static_cast<ChunkLight&>(c) = arrived;
}

} // namespace abbe::transport
