// SPDX-License-Identifier: MIT
#pragma once

#include "base/result.hpp"
#include "cli/povray/settings.hpp"
#include "lang/evaluate.hpp"

#include <filesystem>

namespace abbe::cli {

/// The pictures that are asked for, in their order: one, or a series of them as POV-Ray's
/// Initial_Frame, Final_Frame, Subset_* and Cyclic_Animation tell. The clock of a series of one is
/// its first.
/// @error a subset outside the series
Result<std::vector<lang::AnimationFrame>> frames_of(PovraySettings const& settings);
/// Are the pictures numbered?
bool is_series(PovraySettings const& settings);

/// The path of a picture: the output's name or folder, or the input's name in the working
/// directory; with the number of the frame in as many digits as the last one has, and the extension
/// of the kind of file, which is added where the name does not end in it.
std::filesystem::path picture_path(PovraySettings const& settings,
                                   lang::AnimationFrame const& frame);

/// The part of the picture that is rendered, as pixels from 0. @error there is none
struct PixelRange {
  int begin = 0, end = 0; ///< the end not included
};
Result<PixelRange> pixel_range(double first, double last, int size);

} // namespace abbe::cli
