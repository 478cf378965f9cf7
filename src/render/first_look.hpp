// SPDX-License-Identifier: MIT
#pragma once

#include "render/pixel_sampler.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace abbe::render {

/// What the first samples of method 3 tell of some rows of pixels, beside their means: which pixels
/// are not known well enough. It is a function of the first samples of a pixel and those around it.
class FirstLook {
public:
  FirstLook() = default;
  explicit FirstLook(std::size_t pixels) : squares(3 * pixels), rays(pixels) {}

  void put(std::size_t pixel, FirstSamples const& samples);
  /// @param rgb means of the first samples, rows of `width` pixels
  /// @param above the row before them @param below the row behind them; both may be empty
  /// @return a mark a pixel
  std::vector<std::uint8_t> unknown(std::span<float const> rgb, std::size_t width,
                                    std::span<float const> above, std::span<float const> below,
                                    Samples const& samples, plan::WorkingSpace const& space);
  /// A pixel to begin further samples with. @param rgb its mean
  KnownPixel pixel(std::size_t pixel, float const* rgb, Samples const& samples) const;

  // For the checkpoint, which keeps what cannot be made of the means.
  std::vector<float> squares; ///< FirstSamples::squares
  std::vector<float> rays;    ///< of all first samples of a pixel

private:
  std::vector<float> contrast_; ///< KnownPixel::contrast
};

} // namespace abbe::render
