// SPDX-License-Identifier: MIT
#pragma once

#include "texture/pattern.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace abbe::texture {

/// A picture as patterns look at it; rows from the top.
struct Picture {
  int width = 0, height = 0;
  struct Texel {
    float r = 0, g = 0, b = 0;
    float filter = 0, transmit = 0;
  };
  std::vector<Texel> texels;
  std::vector<std::uint16_t> index; ///< numbers of palette entries; empty: no palette
};

/** @scene image_map { FILE ITEMS } | image_pattern { FILE ITEMS } | bump_map { FILE ITEMS }
 * A picture over the unit square of x and y, again and again.
 * | item            | default | meaning |
 * | once            | off     | a single time: nothing around it |
 * | map_type T      | 0       | 0 flat, 1 on a sphere, 2 on a cylinder, 5 on a torus |
 * | interpolate I   | 0       | between pixels: 2 linear, 3 cubic, 4 by distance |
 * | use_color, use_alpha | use_color | what of a pixel counts as its value: its grey or alpha |
 * | use_index       | off     | in bump_map: the number of its palette entry |
 */
class ImagePattern final : public Pattern {
public:
  enum class Use : std::uint8_t { Colours, Values, Bumps, Numbers };
  ImagePattern(std::shared_ptr<Picture const> picture, Use use)
      : picture_(std::move(picture)), use_(use) {}

  double raw(Vec3 const& point, PatternModifiers const&) const override;
  double default_frequency() const override { return 0; }
  bool has_colours() const override { return use_ == Use::Colours; }
  bool has_value() const override { return use_ != Use::Bumps; }
  PatternColour colour_at(Vec3 const& point) const override;
  bool lets_light_pass() const override;
  bool tilt(Vec3 const& point, PatternModifiers const&, double amount, Vec3& normal) const override;
  std::shared_ptr<Pattern const> read_item(Parameters&) const override;

private:
  struct Place {
    double x, y; ///< in pixels, from the left and from the bottom
  };
  /// Where on the picture a point lies; nullopt: beside it.
  std::optional<Place> place(Vec3 const& point) const;
  std::size_t place_of(int x, int y) const;
  template <class Of>
  double mixed(Place const& place, Of const& of) const;
  double value(Place const& place) const;

  std::shared_ptr<Picture const> picture_;
  Use use_;
  bool once_ = false, use_index_ = false, use_alpha_ = false;
  int map_type_ = 0, interpolate_ = 0;
  std::optional<double> bump_size_; ///< written among its items
};

} // namespace abbe::texture
