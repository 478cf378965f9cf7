// SPDX-License-Identifier: MIT
#include "cli/povray/frames.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace abbe::cli {
namespace fs = std::filesystem;
namespace {

/// A number of frame or pixel: below 1 a share of what there is.
int place(double given, int first, int count) {
  return given < 1 ? first + static_cast<int>(given * (count - 1)) : static_cast<int>(given);
}

std::string_view extension_of(char type) {
  switch (type) {
  case 'B':
    return ".bmp";
  case 'C':
  case 'T':
    return ".tga";
  case 'E':
    return ".exr";
  case 'H':
    return ".hdr";
  case 'J':
    return ".jpg";
  case 'P':
    return ".ppm";
  default:
    return ".png";
  }
}

} // namespace

bool is_series(PovraySettings const& settings) {
  auto const &first = settings.initial_frame, &last = settings.final_frame;
  // "From 1 to 1", both given, is what POV-Ray takes for its defaults: one picture.
  if (first && last) return *first != *last || *first > 1;
  return first || (last && *last > 0);
}

Result<std::vector<lang::AnimationFrame>> frames_of(PovraySettings const& settings) {
  lang::AnimationFrame frame;
  if (!is_series(settings)) {
    frame.clock = settings.clock.value_or(0);
    frame.clock_on = settings.clock.has_value();
    return std::vector{frame};
  }
  int const first = settings.initial_frame.value_or(1);
  int const last = std::max(first, settings.final_frame.value_or(first));
  int const count = last - first + 1;
  int const begin = settings.subset_start > 0 ? place(settings.subset_start, first, count) : first;
  int const end = settings.subset_end > 0 ? place(settings.subset_end, first, count) : last;
  if (begin < first || end > last || begin > end)
    return Error{"E0531", fmt::format("the frames {} to {} are no part of the series {} to {}",
                                      begin, end, first, last)};
  int const steps = settings.cyclic ? count : count - 1;
  frame.clock_on = true;
  frame.initial_clock = settings.initial_clock;
  frame.final_clock = settings.final_clock;
  frame.initial_frame = first;
  frame.final_frame = settings.cyclic ? last + 1 : last; // as POV-Ray tells its scenes
  frame.clock_delta = steps > 0 ? (settings.final_clock - settings.initial_clock) / steps : 0;
  std::vector<lang::AnimationFrame> frames;
  for (int number = begin; number <= end; ++number) {
    frame.number = number;
    frame.clock = settings.initial_clock + frame.clock_delta * (number - first);
    frames.push_back(frame);
  }
  return frames;
}

fs::path picture_path(PovraySettings const& settings, lang::AnimationFrame const& frame) {
  std::string const extension(extension_of(settings.type));
  std::string const name = fs::path(settings.input).stem().string();
  std::error_code none;
  fs::path path(settings.output);
  if (settings.output.empty() || settings.output == "-")
    path = name;
  else if (settings.output.back() == '/' || fs::is_directory(path, none))
    path /= name;
  else if (same_word(path.extension().string(), extension))
    path.replace_extension();
  std::string text = path.string();
  if (is_series(settings)) {
    int const last = std::max(frame.final_frame - (settings.cyclic ? 1 : 0), frame.initial_frame);
    text += fmt::format("{:0{}}", frame.number, std::to_string(last).size());
  }
  return text + extension;
}

Result<PixelRange> pixel_range(double first, double last, int size) {
  auto const pixel = [&](double given) {
    return given < 1 ? static_cast<int>(given * size) : static_cast<int>(given);
  };
  PixelRange const range{first <= 0  ? 0
                         : first < 1 ? pixel(first)
                                     : pixel(first) - 1,
                         last <= 0 ? size : pixel(last)};
  if (range.begin >= 0 && range.begin < range.end && range.end <= size) return range;
  return Error{"E0532",
               fmt::format("from {:g} to {:g} is no part of {} pixels", first, last, size)};
}

} // namespace abbe::cli
