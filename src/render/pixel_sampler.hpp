// SPDX-License-Identifier: MIT
#pragma once

#include "render/render.hpp"

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

  /// One ray through the middle of the pixel.
  Sampled centre(int x, int y);
  /// The same for `count` pixels of a row, traced together where that can be.
  void centres(int x, int y, std::size_t count, Sampled* out);
  /// Method 1: the grid of a pixel whose centre sample differs from a neighbour's, averaged with
  /// it.
  Sampled refined(int x, int y, Sampled const& centre);
  /// Method 2: the pixel from its corners, subdivided where they differ.
  Sampled subdivided(int x, int y);

  /// Do two samples differ by more than the threshold, as the eye sees them (gamma 2.5)?
  bool differ(Vec3 const& a, Vec3 const& b) const;

  /// With RenderOptions::check_finite: the first sample whose light is wrong, without its path.
  struct Wrong {
    BadSample::Kind kind;
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
  };
  RandomKey key_of(int x, int y) const;
  Spot spot(double x, double y, RandomKey pixel, std::uint64_t number);
  Sampled at(Spot const& spot);
  /// at() for each, with the same bits. @param count any
  void at_all(Spot const* spots, std::size_t count, Sampled* out);
  void at_together(Spot const* spots, std::size_t count, Sampled* out);
  Sampled corner(std::int64_t x, std::int64_t y);
  Sampled cell(std::int64_t x, std::int64_t y, std::int64_t size, Sampled const (&corners)[4]);

  Stage const& stage_;
  RenderOptions const& options_;
  Tracer& tracer_;
  RandomKey frame_key_;
  std::int64_t grid_; ///< steps per pixel of method 2
  bool negative_is_wrong_ = false;
  std::optional<Wrong> wrong_;
  std::vector<Spot> spots_;    ///< of refined()
  std::vector<Sampled> taken_; ///< of refined()
};

} // namespace abbe::render
