// SPDX-License-Identifier: MIT
#include "base/random.hpp"
#include "simd/math.hpp"
#include "transport/caustics/caustic_lights.hpp"
#include "transport/shader.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

/// What lamps add to a surface.
namespace abbe::transport {

namespace {

/// Random, the same for the same point: 0 .. 1.
double grain_at(Vec3 const& point) {
  RandomKey key;
  for (int axis = 0; axis < 3; ++axis) key = key.child(std::bit_cast<std::uint64_t>(point[axis]));
  return key.uniform(0);
}

} // namespace

template <int Lanes>
void Shader<Lanes>::find_highlights(surface::CompiledFinish const& finish, Aim const& aim,
                                    bool double_illuminate, RaySet rays, Lit& out) {
  if (!out.shines) return;
  std::size_t const count = chunk_.count;
  std::fill_n(out.shine.value, count, 0.0);
  RaySet lit = 0;
  each_of(rays, [&](std::size_t r) { lit |= RaySet{aim.cosine[r] > 0 || double_illuminate} << r; });
  // Where the cosine is not above zero there is none.
  auto const add = [&](double share, Values& cosine, double exponent) {
    if (share == 0) return;
    RaySet shining = 0;
    each_of(lit, [&](std::size_t r) { shining |= RaySet{cosine[r] > 0} << r; });
    if (shining == 0) return;
    if (exponent != 1) raise(cosine, count, exponent);
    each_of(shining, [&](std::size_t r) { out.shine[r] += share * cosine[r]; });
  };
  add(finish.phong, out.surface.mirrored, finish.phong_size);
  add(finish.specular, out.surface.half, 1 / finish.roughness);
}

template <int Lanes>
RaySet Shader<Lanes>::light_up(Lamp const* lamp, Aim const& aim, Vectors const& normal,
                               surface::CompiledFinish const& finish, Pigments const& pigment,
                               bool double_illuminate, RaySet rays, Lit& out) {
  rays &= aim.comes;
  out.weakens = lamp != nullptr && lamp->strengths(aim, rays, chunk_.count, out.strength.value);
  bool const shines =
      !(lamp != nullptr && lamp->shadowless()) && (finish.phong != 0 || finish.specular != 0);
  double const behind = double_illuminate ? finish.diffuse : finish.diffuse_back;
  light_surfaces({&aim, &chunk_.direction, &normal, pigment.opaque.value, finish.diffuse, behind,
                  shines && finish.phong != 0, shines && finish.specular != 0},
                 chunk_.count, out.surface);
  Values& diffuse = out.surface.diffuse;
  if (finish.brilliance != 1)
    each_of(rays, [&](std::size_t r) {
      double const cosine = aim.cosine[r];
      if (diffuse[r] != 0)
        diffuse[r] = pigment.opaque[r] * (cosine > 0 ? finish.diffuse : behind)
                     * simd::pow(std::abs(cosine), finish.brilliance);
    });
  if (finish.crand != 0)
    each_of(rays, [&](std::size_t r) {
      if (diffuse[r] == 0) return;
      double const grain = finish.crand * grain_at(chunk_.point.get(r));
      diffuse[r] = std::max(0.0, diffuse[r] - pigment.opaque[r] * grain);
    });
  out.shines = shines;
  find_highlights(finish, aim, double_illuminate, rays, out);
  RaySet lit = 0;
  each_of(rays, [&](std::size_t r) {
    bool const is = diffuse[r] != 0 || (shines && out.shine[r] != 0);
    lit |= RaySet{is && !(out.weakens && out.strength[r] == 0)} << r;
  });
  return lit;
}

template <int Lanes>
void Shader<Lanes>::add_film(surface::CompiledFinish const& finish, Aim const& aim,
                             Facing const& facing, RaySet rays, double* light) {
  each_of(rays, [&](std::size_t r) {
    double thickness = finish.irid_thickness;
    if (finish.irid_turbulence != 0) {
      texture::Turbulence const eddies{Vec3(0), 5, 0.5, 2};
      double const t = texture::turbulence(chunk_.point.get(r) + stage_.eye, eddies);
      thickness *= 1 + finish.irid_turbulence * (2 * t - 1);
    }
    double const way =
        2 * std::numbers::pi * thickness * (std::abs(aim.cosine[r]) + std::abs((*facing.cos_i)[r]));
    for (std::size_t k = r * each(); k < (r + 1) * each(); ++k)
      light[k] *= 1 + finish.irid * simd::cos(way / finish.irid_wavelength[chunk_.channels[k]]);
  });
}

template <int Lanes>
RaySet Shader<Lanes>::lit_by(std::size_t lamp, Side const& side, RaySet rays) const {
  if (stage_.lit_groups.empty()) return rays;
  RaySet lit = 0;
  each_of(rays, [&](std::size_t r) {
    auto const solid = side.crossing != nullptr ? side.crossing->solid : chunk_.hit[r].solid;
    lit |= RaySet{stage_.lit_groups[stage_.solids[solid].light_group][lamp]} << r;
  });
  return lit;
}

template <int Lanes>
RaySet Shader<Lanes>::find_added(LampLight const& light, Aim const& aim,
                                 surface::CompiledFinish const& finish, Pigments const& pigment,
                                 Facing const& facing, bool double_illuminate, RaySet rays,
                                 SurfaceLight const& surface, double* out) {
  Lit lit;
  rays = light_up(light.lamp, aim, *facing.normal, finish, pigment, double_illuminate, rays, lit);
  if (rays == 0) return 0;
  Values tint;
  if (finish.metallic != 0)
    each_of(rays, [&](std::size_t r) {
      tint[r] = finish.metallic * (1 - metallic_falloff(aim.cosine[r]));
    });
  find_gloss(lanes_of(surface.passed, pigment),
             {light.value, lit.weakens ? lit.strength.value : nullptr, lit.surface.diffuse.value,
              lit.shines ? lit.shine.value : nullptr, finish.metallic != 0 ? tint.value : nullptr},
             out);
  if (finish.irid != 0) add_film(finish, aim, facing, rays, out);
  return rays;
}

template <int Lanes>
RaySet Shader<Lanes>::add_places(std::size_t number, Aim const& middle,
                                 surface::CompiledFinish const& finish, Pigments const& pigment,
                                 Facing const& facing, bool double_illuminate, RaySet rays,
                                 SurfaceLight const& surface, double* out) {
  Lamp const& lamp = *stage_.lamps[number];
  Area const& area = *lamp.area();
  auto* const axes = arena_.take<Area::Axes>(chunk_.count);
  for (std::size_t r = 0; r < chunk_.count; ++r) axes[r] = area.axes(middle.direction.get(r));
  auto* const points = arena_.take<Vectors>(1);
  auto* const aim = arena_.take<Aim>(1);
  double* const added = take_lanes();
  double const share = 1.0 / static_cast<double>(area.places());
  LampLight const light = light_of(lamp);
  RaySet lit = 0;
  for (int v = 0; v < area.grid().size2; ++v)
    for (int u = 0; u < area.grid().size1; ++u) {
      // The lamp moved one way is the surface moved the other way.
      for (std::size_t r = 0; r < (chunk_.count + 7) / 8 * 8; ++r) {
        std::size_t const own = std::min(r, chunk_.count - 1);
        RandomKey const key = chunk_.jitter[chunk_.sample[own]].child(number);
        points->set(r, chunk_.point.get(own) - area.offset(axes[own], u, v, key));
      }
      lamp.aim(*points, *facing.normal, chunk_.count, *aim);
      RaySet const from_here =
          find_added(light, *aim, finish, pigment, facing, double_illuminate, rays, surface, added);
      each_lane(from_here, [&](std::size_t, std::size_t k) { out[k] += share * added[k]; });
      lit |= from_here;
    }
  return lit;
}

template <int Lanes>
void Shader<Lanes>::add_lamp(std::size_t number, surface::CompiledFinish const& finish,
                             Pigments const& pigment, Facing const& facing, bool double_illuminate,
                             RaySet rays, SurfaceLight& out) {
  if (rays == 0) return;
  Lamp const& lamp = *stage_.lamps[number];
  if (out.lit[number] == 0) lamp.aim(chunk_.point, chunk_.normal, chunk_.count, aims_[number]);
  Aim* of_layer = nullptr;
  if (facing.own != nullptr) {
    of_layer = arena_.take<Aim>(1);
    lamp.aim(chunk_.point, *facing.normal, chunk_.count, *of_layer);
  }
  Aim const& aim = of_layer != nullptr ? *of_layer : aims_[number];
  double* const added = take_lanes();
  if (lamp.area() != nullptr && lamp.area()->grid().illumination) {
    std::fill_n(added, chunk_.count * each(), 0.0);
    rays = add_places(number, aim, finish, pigment, facing, double_illuminate, rays, out, added);
  } else {
    rays = find_added(light_of(lamp), aim, finish, pigment, facing, double_illuminate, rays, out,
                      added);
  }
  if (rays == 0) return;
  // Light without shadows is the surface's own.
  double*& to = lamp.shadowless() ? out.own : out.of_lamp[number];
  if (to == nullptr) to = take_lanes(0.0);
  add(rays, added, to);
  out.lit[number] |= rays;
}

template <int Lanes>
void Shader<Lanes>::add_thrown(surface::CompiledFinish const& finish, Pigments const& pigment,
                               Facing const& facing, Side const& side, RaySet rays,
                               SurfaceLight& out) {
  auto const& lights = thrown_->lights();
  double* const added = take_lanes();
  double* const values = take_lanes();
  auto* const aim = arena_.take<Aim>(1);
  std::size_t const whole = (chunk_.count + 7) / 8 * 8;
  for (std::size_t first = 0; first < lights.size();) {
    // One light of each ray at a time.
    std::size_t const lamp = lights[first].lamp;
    RaySet having = 0;
    std::fill_n(values, chunk_.count * each(), 0.0);
    for (std::size_t r = 0; r < whole; ++r) {
      aim->direction.set(r, Vec3(0, 0, 1));
      aim->distance[r] = aim->cosine[r] = 1;
    }
    std::size_t at = first;
    for (; at < lights.size() && lights[at].lamp == lamp; ++at) {
      caustics::CausticLight const& light = lights[at];
      std::size_t const r = light.ray;
      if ((having >> r & 1) != 0) break;
      having |= RaySet{1} << r;
      aim->direction.set(r, light.toward);
      aim->distance[r] = light.distance;
      aim->cosine[r] = glm::dot(facing.normal->get(r), light.toward);
      double const* const own = light.channel < 0 ? thrown_->values(light) : nullptr;
      for (std::size_t k = 0; k < each(); ++k)
        values[r * each() + k] = own != nullptr                                     ? own[k]
                                 : chunk_.channels[r * each() + k] == light.channel ? light.value
                                                                                    : 0;
    }
    first = at;
    aim->comes = having;
    if (stage_.has_non_collectors)
      each_of(having, [&](std::size_t r) {
        if (!stage_.casts[chunk_.hit[r].solid].collects) having &= ~(RaySet{1} << r);
      });
    RaySet const lit =
        find_added({nullptr, {values, false}}, *aim, finish, pigment, facing,
                   side.double_illuminate, lit_by(lamp, side, rays & having), out, added);
    if (lit == 0) continue;
    if (out.own == nullptr) out.own = take_lanes(0.0);
    add(lit, added, out.own);
  }
}

template class Shader<0>;
template class Shader<1>;
template class Shader<3>;

} // namespace abbe::transport
