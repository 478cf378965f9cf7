// SPDX-License-Identifier: MIT
#pragma once

#include "render/pixel_order.hpp"
#include "render/render.hpp"

#include <optional>
#include <span>
#include <vector>

namespace abbe::render {

/// Colour of a pixel or sample, with its spectrum when that is wanted.
struct Sampled {
  Vec3 rgb{0};
  std::vector<double> bands;

  void add(Sampled const& other);
  void scale(double factor);
};

/// Samples the picture plane. The random numbers of a sample depend only on where it lies, so that
/// any thread, tile or order gives the same picture.
class PixelSampler {
public:
  PixelSampler(Stage const& stage, RenderOptions const& options, Tracer& tracer);

  /// One ray through the middle of each pixel, traced together where that can be. @param out one a
  /// pixel
  void centres(std::span<Pixel const> pixels, Sampled* out);
  /// Method 1: the mean of the grid of each pixel, and of its middle. @param middle false: of the
  /// grid alone
  void refined(std::span<Pixel const> pixels, bool middle, Sampled* out);
  /// Method 2: the pixel from its corners, subdivided where they differ.
  Sampled subdivided(Pixel const& pixel);

  /// Do two samples differ by more than the threshold, as the eye sees them (gamma 2.5)?
  bool differ(Vec3 const& a, Vec3 const& b) const;

  /// With RenderOptions::check_finite: the sample whose light is wrong, without its path; of
  /// several the first in rows.
  struct Wrong {
    BadSample::Kind kind;
    Pixel pixel;
    double x, y; ///< on the picture plane, pixels
    SampleKey key;
    Vec3 rgb;
  };
  std::optional<Wrong> const& wrong() const { return wrong_; }

private:
  /// A sample: where on the picture plane, and what its random numbers hang on.
  struct Spot {
    double x, y;
    SampleKey key;
    Pixel pixel; ///< that it is for
  };
  RandomKey key_of(Pixel const& pixel) const;
  Spot spot(double x, double y, RandomKey key, std::uint64_t number, Pixel const& pixel) const;
  Spot centre(Pixel const& pixel) const;
  void add_grid(Pixel const& pixel);
  Sampled at(Spot const& spot);
  /// at() for each, with the same bits. @param count any
  void at_all(Spot const* spots, std::size_t count, Sampled* out);
  void at_together(Spot const* spots, std::size_t count, Sampled* out);
  /// @param place of the sample among those that the tracer has just traced
  void check(Spot const& spot, std::size_t place, Vec3 const& rgb);
  Sampled corner(std::int64_t x, std::int64_t y);
  Sampled cell(std::int64_t x, std::int64_t y, std::int64_t size, Sampled const (&corners)[4]);

  Stage const& stage_;
  RenderOptions const& options_;
  Tracer& tracer_;
  RandomKey frame_key_;
  std::int64_t grid_; ///< steps per pixel of method 2
  bool negative_is_wrong_ = false;
  std::optional<Wrong> wrong_;
  Pixel subdivided_{0, 0};     ///< the pixel of method 2 that is in work
  std::vector<Spot> spots_;    ///< in work
  std::vector<Sampled> taken_; ///< of refined()
};

} // namespace abbe::render
