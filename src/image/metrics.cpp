// SPDX-License-Identifier: MIT
#include "image/metrics.hpp"

#include "image/colour.hpp"
#include "image/flip.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace abbe::image {
namespace {

Status same_size(Image const& reference, Image const& test) {
  if (reference.width == test.width && reference.height == test.height) return std::monostate{};
  return Error{"E0517", fmt::format("the images differ in size: {} x {} and {} x {} pixels",
                                    reference.width, reference.height, test.width, test.height)};
}

/// Both images on the same display.
struct Displayed {
  Image reference, test;
};

Displayed display(Image const& reference, Image const& test, ToneOptions tone) {
  if (tone.auto_exposure) tone.exposure_ev += automatic_exposure_ev(reference);
  tone.auto_exposure = false;
  return {tone_map(reference, tone), tone_map(test, tone)};
}

double psnr_db(double rmse) {
  return rmse > 0 ? -20 * std::log10(rmse) : std::numeric_limits<double>::infinity();
}

/// Sum over pixels and X, Y, Z of (test - reference)^2 / (reference^2 + floor).
double relative_squares_xyz(Image const& reference, Image const& test, double floor) {
  double sum = 0;
  for (std::size_t i = 0; i < reference.pixels(); ++i) {
    Vec3 known = pixel(reference, i), seen = pixel(test, i);
    if (known == seen) continue; // also infinities
    for (int c = 0; c < 3; ++c) {
      if (std::isnan(known[c])) known[c] = 0;
      if (std::isnan(seen[c])) seen[c] = 0;
      if (known[c] == seen[c]) known[c] = seen[c] = std::isinf(known[c]) ? 0 : known[c];
    }
    Vec3 const xyz = linear_srgb_to_xyz(known), off = linear_srgb_to_xyz(seen - known);
    for (int c = 0; c < 3; ++c)
      if (off[c] != 0) sum += off[c] * off[c] / (xyz[c] * xyz[c] + floor);
  }
  return sum;
}

void compare_linear(Image const& reference, Image const& test, Metrics& out) {
  auto const number = [&](float value) {
    if (!std::isnan(value)) return double{value};
    ++out.not_a_number;
    return 0.0;
  };
  double mean_y = 0;
  for (std::size_t i = 0; i < reference.pixels(); ++i) {
    double const y = luminance(pixel(reference, i));
    if (std::isfinite(y)) mean_y += y;
  }
  mean_y /= static_cast<double>(reference.pixels());
  double const floor = 0.01 * mean_y * mean_y;
  double squares = 0;
  double relative = 0;
  for (std::size_t i = 0; i < reference.rgb.size(); ++i) {
    double const r = number(reference.rgb[i]);
    double const t = number(test.rgb[i]);
    if (r == t) continue; // also two infinities
    double const difference = std::abs(t - r);
    squares += difference * difference;
    relative += difference * difference / (r * r + floor);
    out.max_linear = std::max(out.max_linear, difference);
  }
  auto const count = static_cast<double>(reference.rgb.size());
  out.rmse_linear = std::sqrt(squares / count);
  out.psnr_linear_db = psnr_db(out.rmse_linear);
  auto const mean_of = [&](double sum) {
    return std::isinf(sum) ? std::numeric_limits<double>::quiet_NaN() : sum / count;
  };
  out.relative_mse = mean_of(relative);
  out.relative_mse_xyz = mean_of(relative_squares_xyz(reference, test, floor));
}

void compare_codes(Displayed const& shown, double threshold, Metrics& out) {
  double squares = 0;
  for (std::size_t i = 0; i < shown.reference.rgb.size(); ++i) {
    double const difference = srgb_encode(shown.reference.rgb[i]) - srgb_encode(shown.test.rgb[i]);
    squares += difference * difference;
  }
  auto const count = static_cast<double>(shown.reference.rgb.size());
  out.rmse_srgb = std::sqrt(squares / count);

  std::vector<std::uint8_t> const reference = encode_srgb8(shown.reference);
  std::vector<std::uint8_t> const test = encode_srgb8(shown.test);
  double code_squares = 0;
  std::size_t differing = 0;
  for (std::size_t i = 0; i < reference.size(); i += 3) {
    int largest = 0;
    for (std::size_t c = i; c < i + 3; ++c) {
      int const difference = std::abs(int{reference[c]} - int{test[c]});
      code_squares += difference * difference;
      largest = std::max(largest, difference);
    }
    differing += largest > threshold;
    out.max_codes = std::max<double>(out.max_codes, largest);
  }
  out.psnr_srgb_db = psnr_db(std::sqrt(code_squares / count) / 255);
  out.differing_share =
      static_cast<double>(differing) / static_cast<double>(shown.reference.pixels());
}

void compare_delta_e(Displayed const& shown, Metrics& out) {
  std::size_t const n = shown.reference.pixels();
  std::vector<float> values(n);
  double total = 0;
  std::size_t above_1 = 0;
  std::size_t above_2_3 = 0;
  auto const lab = [](Image const& image, std::size_t i) {
    return xyz_to_lab(linear_srgb_to_xyz(pixel(image, i)));
  };
  for (std::size_t i = 0; i < n; ++i) {
    double const delta_e = ciede2000(lab(shown.reference, i), lab(shown.test, i));
    values[i] = static_cast<float>(delta_e);
    total += delta_e;
    above_1 += delta_e > 1;
    above_2_3 += delta_e > 2.3;
  }
  auto const count = static_cast<double>(n);
  out.delta_e_mean = total / count;
  out.delta_e_share_above_1 = static_cast<double>(above_1) / count;
  out.delta_e_share_above_2_3 = static_cast<double>(above_2_3) / count;
  auto const percentile = [&](std::size_t percent) { // nearest rank, in integers
    std::size_t const rank = (n * percent + 99) / 100;
    auto const place = values.begin() + static_cast<std::ptrdiff_t>(rank - 1);
    std::nth_element(values.begin(), place, values.end());
    return double{*place};
  };
  out.delta_e_p95 = percentile(95);
  out.delta_e_p99 = percentile(99);
  out.delta_e_max = percentile(100);
}

void compare_flip(Displayed const& shown, Metrics& out) {
  std::vector<float> const errors = flip(shown.reference, shown.test);
  double total = 0;
  for (float const error : errors) {
    total += error;
    out.flip_max = std::max<double>(out.flip_max, error);
  }
  out.flip_mean = total / static_cast<double>(errors.size());
}

} // namespace

Result<Metrics> compare(Image const& reference, Image const& test, CompareOptions const& options) {
  if (Status const same = same_size(reference, test); !same) return same.error();
  Metrics out;
  compare_linear(reference, test, out);
  Displayed const shown = display(reference, test, options.tone);
  compare_codes(shown, options.threshold_codes, out);
  compare_delta_e(shown, out);
  compare_flip(shown, out);
  return out;
}

Result<Image> difference_image(Image const& reference, Image const& test, double gain,
                               ToneOptions const& tone) {
  if (Status const same = same_size(reference, test); !same) return same.error();
  Displayed const shown = display(reference, test, tone);
  Image out = make_image(reference.width, reference.height);
  for (std::size_t i = 0; i < out.rgb.size(); ++i) {
    double const difference =
        std::abs(srgb_encode(shown.reference.rgb[i]) - srgb_encode(shown.test.rgb[i]));
    out.rgb[i] = static_cast<float>(srgb_decode(std::min(gain * difference, 1.0)));
  }
  return out;
}

} // namespace abbe::image
