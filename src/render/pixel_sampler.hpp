// SPDX-License-Identifier: MIT
#pragma once

#include "plan/working_space.hpp"
#include "render/compile.hpp"
#include "render/number_table.hpp"
#include "render/pixel_order.hpp"
#include "render/render.hpp"
#include "transport/tracer.hpp"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace abbe::render {

using transport::CutLight, transport::SampleKey, transport::Tracer;

/// Colour of a pixel or sample, with its spectrum when that is wanted.
struct Sampled {
  Vec3 rgb{0};
  double lost = 0; ///< what was cut of it (CutLight)
  double rays = 0; ///< that it took, where the tracer counts them
  std::vector<double> bands;

  void add(Sampled const& other);
  void scale(double factor);
};

/// The first samples of a pixel of method 3.
struct FirstSamples {
  Sampled mean;
  Vec3 squares{0}; ///< sum of the squares of the samples' distances from it
  double rays = 0; ///< that they took
};

/// A pixel of method 3 that is looked at again.
struct KnownPixel {
  int count = 0;             ///< samples so far
  Vec3 sum{0};               ///< of their light
  double rays = 0;           ///< that they took
  Vec3 contrast{0};          ///< how far from the pixel's light that is which is near it
  std::vector<double> bands; ///< sum of those samples that were not first
  /// Sums of each quarter of the samples, in order; of the first samples, they are all the first.
  std::array<Vec3, 4> quarters{};

  Vec3 mean() const { return sum / static_cast<double>(count); }
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
  /// Method 3: the first samples of each pixel.
  void first_samples(std::span<Pixel const> pixels, FirstSamples* out);
  /// Method 3: further samples, until each pixel is known well enough (shown_error.hpp) or has the
  /// most samples. @param space of the numbers @param known begun with the first samples
  void further_samples(std::span<Pixel const> pixels, plan::WorkingSpace const& space,
                       KnownPixel* known);
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
  /// Samples [first, end) of a pixel.
  void add_samples(Pixel const& pixel, int first, int end);
  /// In the region.
  std::size_t place_of(Pixel const& pixel) const;
  /// All spots.
  void take(Sampled* out);
  /// Through a lens: further rays of each spot until they are enough.
  void take_through_lens(Sampled* out);
  /// Traces spots, batch by batch. @param done called with the number of a spot and its light
  template <class Done>
  void trace(Spots const& spots, Done const& done);
  /// @param spot among `spots` @param place of the sample among those that the tracer has just
  /// traced
  void check(Spots const& spots, std::size_t spot, std::size_t place, Vec3 const& rgb);
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
  Spots rays_;                 ///< of these through a lens
  std::vector<Sampled> taken_; ///< of spots_
  std::uint64_t lost_ = 0;
  std::vector<Corner> corners_;
  NumberTable corner_numbers_; ///< by place
  std::vector<Cell> cells_;    ///< in work
};

} // namespace abbe::render
