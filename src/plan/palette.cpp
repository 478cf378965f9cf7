// SPDX-License-Identifier: MIT
#include "plan/palette.hpp"

#include "optics/spectrum.hpp"
#include "optics/uplift.hpp"
#include "plan/working_space.hpp"

#include <algorithm>
#include <functional>
#include <set>
#include <tuple>

namespace abbe::plan {
namespace {

using scene::Colour;

/// Shows every colour of a scene to one of two functions.
class Walk {
public:
  using Visit = std::function<void(Colour const&)>;
  Walk(Visit light, Visit colour) : light_(std::move(light)), colour_(std::move(colour)) {}

  void scene(scene::Scene const& scene) {
    for (auto const& light : scene.lights) light_(light.colour);
    light_(scene.background);
    for (auto const& fog : scene.fogs) light_(fog.colour);
    for (auto const& rainbow : scene.rainbows)
      for (auto const& entry : rainbow.entries) light_(entry.colour);
    light_(scene.settings.ambient_light);
    if (scene.sky_sphere) {
      light_(scene.sky_sphere->emission);
      for (auto const& pigment : scene.sky_sphere->pigments) this->pigment(pigment);
    }
    for (auto const& object : scene.objects) this->object(object);
  }

private:
  void object(scene::Object const& object) {
    if (object.texture) layers(*object.texture);
    if (object.interior_texture) layers(*object.interior_texture);
    for (auto const& face : object.face_textures) layers(face);
    if (object.interior && object.interior->fade_distance != 0)
      colour_(object.interior->fade_colour);
    for (auto const& child : object.children) this->object(child);
    if (object.instance && seen_.insert(object.instance.get()).second)
      this->object(*object.instance);
  }
  void layers(scene::Layers const& layers) {
    for (auto const& texture : layers) {
      if (texture.map)
        for (auto const& entry : texture.map->entries) this->layers(entry.layers);
      if (texture.map) continue;
      pigment(texture.pigment);
      colour_(texture.finish->ambient);
      light_(texture.finish->emission);
      if (!texture.finish->reflection) continue;
      colour_(texture.finish->reflection->minimum);
      colour_(texture.finish->reflection->maximum);
    }
  }
  void pigment(scene::Pigment const& pigment) {
    if (!pigment.pattern) return colour_(pigment.colour);
    for (auto const& entry : pigment.entries)
      if (seen_.insert(entry.pigment.get()).second) this->pigment(*entry.pigment);
  }

  Visit light_, colour_;
  std::set<void const*> seen_;
};

bool is_black(std::vector<double> const& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return v == 0; });
}

std::vector<double> product(std::vector<double> a, std::vector<double> const& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] *= b[i];
  return a;
}

} // namespace

Palette find_palette(scene::Scene const& scene, optics::Bands const& grid) {
  WorkingSpace const space(scene.settings);
  Palette out;
  out.lights.emplace_back(static_cast<std::size_t>(grid.count()), 1.0);
  std::set<std::tuple<double, double, double, void const*, bool>> seen;
  auto const values = [&](Colour const& colour, bool light) {
    Vec3 const rgb = space.to_linear(colour.rgb);
    auto const tint = optics::uplift(rgb, grid);
    if (!colour.spectrum) return tint;
    if (light) return product(optics::light_bands(*colour.spectrum, grid), tint);
    auto const reflected = optics::reflectance_bands(*colour.spectrum, grid);
    ABBE_ASSERT(reflected);
    return product(*reflected, tint);
  };
  auto const add = [&](Colour const& colour, bool light) {
    auto& list = light ? out.lights : out.colours;
    if (list.size() >= palette_limit) return;
    // Grey is white, or nothing.
    if (!colour.spectrum && colour.rgb.x == colour.rgb.y && colour.rgb.y == colour.rgb.z) return;
    if (!seen.insert({colour.rgb.x, colour.rgb.y, colour.rgb.z, colour.spectrum.get(), light})
             .second)
      return;
    auto found = values(colour, light);
    if (!is_black(found)) list.push_back(std::move(found));
  };
  Walk([&](Colour const& c) { add(c, true); }, [&](Colour const& c) { add(c, false); })
      .scene(scene);
  return out;
}

std::vector<std::vector<double>> Palette::products() const {
  std::vector<std::vector<double>> out;
  for (auto const& light : lights) {
    out.push_back(light);
    for (std::size_t i = 0; i < colours.size(); ++i) {
      out.push_back(product(light, colours[i]));
      if (i >= palette_pair_limit) continue;
      auto const once = out.back();
      for (std::size_t j = 0; j <= i; ++j) out.push_back(product(once, colours[j]));
    }
  }
  return out;
}

std::vector<double> find_lines_nm(scene::Scene const& scene, optics::Bands const& bands) {
  std::set<double> lines;
  auto const add = [&](Colour const& colour) {
    if (!colour.spectrum) return;
    for (auto const& line : colour.spectrum->split(bands).lines) lines.insert(line[0]);
  };
  Walk(add, [](Colour const&) {}).scene(scene);
  return {lines.begin(), lines.end()};
}

} // namespace abbe::plan
