// SPDX-License-Identifier: MIT
#include "image/flip.hpp"

#include "image/colour.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace abbe::image {
namespace {

constexpr double pi = std::numbers::pi;

/// One scalar per pixel.
struct Plane {
  int width;
  int height;
  std::vector<float> values;

  Plane(int w, int h)
      : width(w), height(h), values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  float* row(int y) {
    return values.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
  }
  float const* row(int y) const { return const_cast<Plane*>(this)->row(y); }
};

/// Weights at -radius .. radius.
using Kernel = std::vector<double>;

template <class Weight>
Kernel make_kernel(int radius, Weight const& weight) {
  Kernel kernel;
  for (int i = -radius; i <= radius; ++i) kernel.push_back(weight(i));
  return kernel;
}

double sum(Kernel const& kernel) {
  double total = 0;
  for (double const w : kernel) total += w;
  return total;
}

// Both passes run along the row in the inner loop, which vectorises; a pixel's terms are added in
// the order of the kernel all the same. Outside the image is what its border shows.

Plane filter_rows(Plane const& in, Kernel const& kernel) {
  Plane out(in.width, in.height);
  auto const width = static_cast<std::size_t>(in.width);
  std::size_t const radius = kernel.size() / 2;
  std::vector<float> line(width + 2 * radius);
  std::vector<double> total(width);
  for (int y = 0; y < in.height; ++y) {
    float const* from = in.row(y);
    std::fill_n(line.begin(), radius, from[0]);
    std::copy_n(from, width, line.begin() + static_cast<std::ptrdiff_t>(radius));
    std::fill_n(line.end() - static_cast<std::ptrdiff_t>(radius), radius, from[width - 1]);
    std::fill(total.begin(), total.end(), 0.0);
    for (std::size_t k = 0; k < kernel.size(); ++k)
      for (std::size_t x = 0; x < width; ++x) total[x] += kernel[k] * line[x + k];
    std::transform(total.begin(), total.end(), out.row(y),
                   [](double value) { return static_cast<float>(value); });
  }
  return out;
}

Plane filter_columns(Plane const& in, Kernel const& kernel) {
  Plane out(in.width, in.height);
  auto const width = static_cast<std::size_t>(in.width);
  int const radius = static_cast<int>(kernel.size() / 2);
  std::vector<double> total(width);
  for (int y = 0; y < in.height; ++y) {
    std::fill(total.begin(), total.end(), 0.0);
    for (std::size_t k = 0; k < kernel.size(); ++k) {
      float const* from = in.row(std::clamp(y + static_cast<int>(k) - radius, 0, in.height - 1));
      for (std::size_t x = 0; x < width; ++x) total[x] += kernel[k] * from[x];
    }
    std::transform(total.begin(), total.end(), out.row(y),
                   [](double value) { return static_cast<float>(value); });
  }
  return out;
}

/// The sum over a window of `along_x(dx) along_y(dy)`.
Plane filter(Plane const& in, Kernel const& along_x, Kernel const& along_y) {
  return filter_columns(filter_rows(in, along_x), along_y);
}

/// Contrast sensitivity: a_1 sqrt(pi / b_1) exp(-pi^2 r^2 / b_1) and the same with a_2, b_2; r in
/// degrees (section 4.1, table 1).
struct Sensitivity {
  double a_1, b_1, a_2, b_2;
};
constexpr Sensitivity achromatic{1, 0.0047, 0, 1};
constexpr Sensitivity red_green{1, 0.0053, 0, 1};
constexpr Sensitivity blue_yellow{34.1, 0.04, 13.5, 0.025};

Plane spatial_filter(Plane const& in, Sensitivity const& csf, double ppd) {
  // Three standard deviations of the widest.
  int const radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * ppd));
  auto const gaussian = [&](double b) {
    return make_kernel(radius, [&](int i) { return std::exp(-pi * pi * i * i / (ppd * ppd * b)); });
  };
  Kernel const first = gaussian(csf.b_1);
  double weight_1 = csf.a_1 * std::sqrt(pi / csf.b_1);
  double total = weight_1 * sum(first) * sum(first);
  Kernel second;
  double weight_2 = 0;
  if (csf.a_2 > 0) {
    second = gaussian(csf.b_2);
    weight_2 = csf.a_2 * std::sqrt(pi / csf.b_2);
    total += weight_2 * sum(second) * sum(second);
  }
  Plane out = filter(in, first, first);
  for (float& value : out.values) value = static_cast<float>(value * (weight_1 / total));
  if (csf.a_2 > 0) {
    Plane const wide = filter(in, second, second);
    for (std::size_t i = 0; i < out.values.size(); ++i)
      out.values[i] += static_cast<float>(wide.values[i] * (weight_2 / total));
  }
  return out;
}

/// The image in YCxCz, the linear sibling of L*a*b*, relative to its white.
struct Opponent {
  Plane y, cx, cz;
};

Vec3 const& white() {
  static Vec3 const xyz = linear_srgb_to_xyz(Vec3(1));
  return xyz;
}

Opponent opponent(Image const& image) {
  Opponent out{
      {image.width, image.height}, {image.width, image.height}, {image.width, image.height}};
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    Vec3 rgb = pixel(image, i);
    for (int c = 0; c < 3; ++c) rgb[c] = rgb[c] > 0 ? std::min(rgb[c], 1.0) : 0;
    Vec3 const xyz = linear_srgb_to_xyz(rgb) / white();
    out.y.values[i] = static_cast<float>(116 * xyz.y - 16);
    out.cx.values[i] = static_cast<float>(500 * (xyz.x - xyz.y));
    out.cz.values[i] = static_cast<float>(200 * (xyz.y - xyz.z));
  }
  return out;
}

/// L*a*b* with chroma that fades in the dark (Hunt).
Vec3 hunt_lab(Vec3 rgb) {
  Vec3 const lab = xyz_to_lab(linear_srgb_to_xyz(rgb));
  return {lab.x, 0.01 * lab.x * lab.y, 0.01 * lab.x * lab.z};
}

double hyab(Vec3 one, Vec3 two) {
  return std::abs(one.x - two.x) + std::hypot(one.y - two.y, one.z - two.z);
}

/// What the eye sees of the colours at this distance, as Hunt-adjusted L*a*b*.
std::vector<Vec3> seen_colours(Opponent const& image, double ppd) {
  Plane const y = spatial_filter(image.y, achromatic, ppd);
  Plane const cx = spatial_filter(image.cx, red_green, ppd);
  Plane const cz = spatial_filter(image.cz, blue_yellow, ppd);
  std::vector<Vec3> colours(y.values.size());
  for (std::size_t i = 0; i < colours.size(); ++i) {
    double const level = (y.values[i] + 16.0) / 116;
    Vec3 const xyz(level + cx.values[i] / 500.0, level, level - cz.values[i] / 200.0);
    Vec3 rgb = xyz_to_linear_srgb(xyz * white());
    for (int c = 0; c < 3; ++c) rgb[c] = std::clamp(rgb[c], 0.0, 1.0);
    colours[i] = hunt_lab(rgb);
  }
  return colours;
}

/// Strength of edges and of points (section 4.2).
struct Features {
  std::vector<float> edges, points;
};

std::vector<float> magnitude(Plane const& x, Plane const& y) {
  std::vector<float> out(x.values.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = std::hypot(x.values[i], y.values[i]);
  return out;
}

Features features_of(Opponent const& image, double ppd) {
  Plane level(image.y.width, image.y.height);
  for (std::size_t i = 0; i < level.values.size(); ++i)
    level.values[i] = (image.y.values[i] + 16) / 116;
  double const sd = 0.5 * 0.082 * ppd; // half the width of a feature, 0.082 degrees
  int const radius = static_cast<int>(std::ceil(3 * sd));
  auto const gauss = [&](int i) { return std::exp(-i * i / (2 * sd * sd)); };
  Kernel const smooth = make_kernel(radius, gauss);
  Kernel first = make_kernel(radius, [&](int i) { return -i * gauss(i); });
  Kernel second = make_kernel(radius, [&](int i) { return (i * i / (sd * sd) - 1) * gauss(i); });

  // Positive weights of the two-dimensional kernel sum to 1 and negative ones to -1.
  double const across = sum(smooth);
  for (Kernel* kernel : {&first, &second}) {
    double positive = 0;
    double negative = 0;
    for (double const w : *kernel) (w > 0 ? positive : negative) += w;
    for (double& w : *kernel) w /= (w > 0 ? positive : -negative) * across;
  }
  return {magnitude(filter(level, first, smooth), filter(level, smooth, first)),
          magnitude(filter(level, second, smooth), filter(level, smooth, second))};
}

/// Colour difference to [0, 1]: most of the range for differences up to 0.4 of the largest.
double redistribute(double error, double largest) {
  double const limit = 0.4 * largest;
  if (error < limit) return 0.95 / limit * error;
  return 0.95 + (error - limit) / (largest - limit) * 0.05;
}

} // namespace

std::vector<float> flip(Image const& reference, Image const& test, double pixels_per_degree) {
  ABBE_ASSERT(reference.width == test.width && reference.height == test.height);
  Opponent const ours[2] = {opponent(reference), opponent(test)};
  std::vector<Vec3> const colour[2] = {seen_colours(ours[0], pixels_per_degree),
                                       seen_colours(ours[1], pixels_per_degree)};
  Features const feature[2] = {features_of(ours[0], pixels_per_degree),
                               features_of(ours[1], pixels_per_degree)};
  constexpr double colour_exponent = 0.7;
  double const largest = std::pow(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), colour_exponent);
  std::vector<float> result(reference.pixels());
  for (std::size_t i = 0; i < result.size(); ++i) {
    double const apart = std::pow(hyab(colour[0][i], colour[1][i]), colour_exponent);
    double const colour_error = std::min(redistribute(apart, largest), 1.0);
    double const edge = std::abs(double{feature[0].edges[i]} - feature[1].edges[i]);
    double const point = std::abs(double{feature[0].points[i]} - feature[1].points[i]);
    double const feature_error =
        std::min(std::sqrt(std::max(edge, point) / std::numbers::sqrt2), 1.0);
    result[i] = static_cast<float>(std::pow(colour_error, 1 - feature_error));
  }
  return result;
}

} // namespace abbe::image
