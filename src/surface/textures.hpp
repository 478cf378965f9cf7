// SPDX-License-Identifier: MIT
#pragma once

#include "base/vec.hpp"
#include "surface/surfaces.hpp"
#include "texture/pattern.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

/// The textures of a scene made ready for rays: every colour as one number a channel. Immutable
/// while rays are traced.
namespace abbe::surface {

/// Channels of light: the spectral bands, or r g b.
using Channels = std::vector<double>;

/// A map of pigments along a pattern.
struct CompiledPattern {
  std::shared_ptr<texture::PatternInstance const> pattern;
  std::vector<double> values;
  std::vector<int> entries; ///< numbers of pigments
};

/// What tilts a normal, with the ways of normals into its pattern's space and back.
struct CompiledNormal {
  std::shared_ptr<scene::Normal const> source;
  Mat3 in{1}, out{1};
  std::vector<double> values; ///< of a map or list
  std::vector<int> entries;   ///< numbers of normals
};

/// A million objects may each have their own: small, and without anything of its own to hold.
struct CompiledPigment {
  double filter = 0, transmit = 0; ///< of a plain one
  std::uint32_t colour = 0;        ///< of a plain one: number of its colour (Stage::colour)
  std::int32_t pattern = -1;       ///< in Stage::patterns; -1: the same everywhere
  bool opaque = true;              ///< nowhere does light pass
};

struct CompiledReflection {
  Channels minimum, maximum;
  bool fresnel = false;
  double falloff = 1;
  double exponent = 1;
  double metallic = 0;
  Channels metal_n, metal_k; ///< set for a metal by n and k
};

struct CompiledFinish {
  Channels ambient; ///< times the global ambient light; empty when zero
  Channels emission;
  double diffuse = 0, diffuse_back = 0, brilliance = 1;
  double phong = 0, phong_size = 40;
  double specular = 0, roughness = 0.05;
  double metallic = 0;
  std::optional<CompiledReflection> reflection;
  bool conserve_energy = false;
  bool tilts = false; ///< layers with this finish have normals of their own
  double crand = 0;
  double irid = 0, irid_thickness = 0, irid_turbulence = 0;
  Channels irid_wavelength; ///< in micrometres
};

/// World (relative to the camera) -> texture space.
struct TextureSpace {
  Mat3 linear{1};
  Vec3 offset{0};
};

/// A patterned texture.
struct CompiledTextureMap {
  std::shared_ptr<texture::PatternInstance const> pattern;
  Mat3 linear{1}; ///< of the way into the pattern's space
  std::vector<double> values;
  std::vector<std::vector<int>> entries; ///< numbers of layers
};

struct CompiledLayer {
  int pigment = 0;
  int finish = 0;  ///< in Stage::finishes
  int space = 0;   ///< in Stage::texture_spaces; used by patterns only
  int normal = -1; ///< in Textures::normals; -1: the surface's own
  int map = -1;    ///< in Textures::maps, in place of all else; -1: none
  bool uv = false; ///< asked for at <u, v, 0> of the surface
};

/// Flat arrays, in which one thing names another by its number.
struct Textures {
  int channels = 3;
  bool sees = false;            ///< some pattern looks at normals
  bool uses_uv = false;         ///< some texture is asked for at surface coordinates
  double opacity_version = 3.7; ///< < 3.7: POV-Ray's older rule of opacity
  Surfaces surfaces;            ///< by PrimitiveId
  std::vector<CompiledLayer> layers;
  std::vector<CompiledFinish> finishes;
  std::vector<TextureSpace> texture_spaces{{}}; ///< [0]: the world's
  std::vector<CompiledPigment> pigments;
  std::vector<CompiledPattern> patterns;
  std::vector<CompiledNormal> normals;
  std::vector<CompiledTextureMap> maps;
  /// Reflectances, channel by channel, of colours on a grid of r, g and b from 0 to 1, so many a
  /// side; for patterns that have colours of their own, where channels are not r, g and b.
  std::vector<double> colour_grid;
  int colour_grid_side = 0;
  std::vector<double> colours; ///< reflectances of plain pigments, channel by channel

  /// Channel by channel, that of a plain pigment.
  double const* colour(CompiledPigment const& pigment) const {
    return colours.data() + pigment.colour * static_cast<std::size_t>(channels);
  }
  CompiledFinish const& finish(CompiledLayer const& layer) const {
    return finishes[static_cast<std::size_t>(layer.finish)];
  }
  Vec3 to_texture(CompiledLayer const& layer, Vec3 const& point) const {
    TextureSpace const& space = texture_spaces[static_cast<std::size_t>(layer.space)];
    return space.linear * point + space.offset;
  }
  /// Does any texture of a surface ask for `reflection`?
  bool mirrors(Surface const& surface) const;
};

} // namespace abbe::surface
