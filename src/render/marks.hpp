// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace abbe::render {

/// A component of linear light as the eye sees it (gamma 2.5), for comparing samples.
double as_seen(double light);

/// Anti-aliasing method 1: a pixel that differs from its left or upper neighbour by `threshold` or
/// more (as_seen, all components together) is sampled again, and so is the neighbour. Marks are
/// made from the first samples alone, so the order does not matter.
/// @param rgb of some rows, linear, three a pixel, `width` pixels a row
/// @param above the row before them @param below the row behind them; both may be empty
/// @return a mark a pixel
std::vector<std::uint8_t> mark_differences(std::span<float const> rgb, std::size_t width,
                                           std::span<float const> above,
                                           std::span<float const> below, double threshold);

/// How much the pixels around each one differ from it, at most: per component of the light. Pixels
/// outside of the rows, `above` and `below` do not count. @return three a pixel
std::vector<float> contrasts(std::span<float const> rgb, std::size_t width,
                             std::span<float const> above, std::span<float const> below);

} // namespace abbe::render
