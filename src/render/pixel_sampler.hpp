// SPDX-License-Identifier: MIT
#pragma once

#include "render/compile.hpp"
#include "render/number_table.hpp"
#include "render/pixel_order.hpp"
#include "render/render.hpp"
#include "transport/tracer.hpp"

#include <optional>
#include <span>
#include <vector>

namespace abbe::render {

using transport::CutLight, transport::SampleKey, transport::Tracer;

/// Colour of a pixel or sample, with its spectrum when that is wanted.
struct Sampled {
  Vec3 rgb{0};
  double lost = 0; ///< what was cut of it (CutLight)
  std::vector<double> bands;

  void add(Sampled const& other);
  void scale(double factor);
};

/// Samples the picture plane. The random numbers of a sample depend only on where it lies, so that
/// any thread, tile or order gives the same picture.
class PixelSampler {
public:
  PixelSampler(Stage const& stage, RenderOptions const& options, Tracer& tracer);
  /// Forgets what it sampled, not the room that this took.
  void start();

  /// One ray through the middle of each pixel. @param out one a pixel
  void centres(std::span<Pixel const> pixels, Sampled* out);
  /// Method 1: the mean of the grid of each pixel, and of its middle. @param middle false: of the
  /// grid alone
  void refined(std::span<Pixel const> pixels, bool middle, Sampled* out);
  /// Method 2: each pixel from its corners, subdivided where they differ. Samples are kept: pixels
  /// that share a corner, and cells within them, share what was sampled there.
  void subdivided(std::span<Pixel const> pixels, Sampled* out);
  /// What was cut of the light of subdivided pixels, in CutLight::unit. It is counted by pixel: how
  /// many samples are shared depends on tiles.
  std::uint64_t lost() const { return lost_; }

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
  /// Samples: where on the picture plane, what their random numbers hang on, and the pixel that
  /// each is for.
  struct Spots {
    std::vector<double> x, y;
    std::vector<SampleKey> key;
    std::vector<Pixel> pixel;

    std::size_t count() const { return x.size(); }
    void clear();
    void add(double at_x, double at_y, SampleKey const& of, Pixel const& for_pixel);
  };
  RandomKey key_of(Pixel const& pixel) const;
  void add_spot(double x, double y, RandomKey key, std::uint64_t number, Pixel const& pixel);
  void add_centre(Pixel const& pixel);
  void add_grid(Pixel const& pixel);
  /// In the region.
  std::size_t place_of(Pixel const& pixel) const;
  /// All spots.
  void take(Sampled* out);
  /// @param place of the sample among those that the tracer has just traced
  void check(std::size_t spot, std::size_t place, Vec3 const& rgb);
  // Method 2 (pixel_corners.cpp). Places are counted in steps of its grid.
  struct Corner {
    std::int64_t x, y;
    Sampled sampled;
    Vec3 seen; ///< as_seen() of its components
  };
  /// A pixel or a part of it.
  struct Cell {
    std::int64_t x, y, size;
    Pixel pixel;
    std::uint32_t corners[4]; ///< top left, top right, bottom left, bottom right
    std::uint32_t parts = 0;  ///< the first of its four, in the same order; 0: it has none
  };
  /// The number of a corner. If nothing is there yet, it waits for take_corners().
  std::uint32_t corner(std::int64_t x, std::int64_t y, Pixel const& pixel);
  void take_corners();
  /// Do two of its corners differ by the threshold or more, as the eye sees them?
  bool uneven(Cell const& cell) const;
  /// Appends its four parts.
  void divide(std::size_t cell);
  Sampled mean(Cell const& cell) const;

  Stage const& stage_;
  RenderOptions const& options_;
  Tracer& tracer_;
  RandomKey frame_key_;
  bool draws_;        ///< something asks for random numbers of pixels
  std::int64_t grid_; ///< steps per pixel of method 2
  bool negative_is_wrong_ = false;
  std::optional<Wrong> wrong_;
  Spots spots_;                ///< in work
  std::vector<Sampled> taken_; ///< of spots_
  std::uint64_t lost_ = 0;
  std::vector<Corner> corners_;
  NumberTable corner_numbers_; ///< by place
  std::vector<Cell> cells_;    ///< in work
};

} // namespace abbe::render
