// SPDX-License-Identifier: MIT
#include "study/banding.hpp"

#include "image/colour.hpp"
#include "image/tone_map.hpp"

#include <algorithm>
#include <cmath>

namespace abbe::study {
namespace {

constexpr int radius = 2; ///< of the sums of the tensor

/// Pixels with a neighbour on each side can be differentiated.
template <class Work>
void for_inner(int width, int height, Work const& work) {
  for (int y = 1; y + 1 < height; ++y)
    for (int x = 1; x + 1 < width; ++x)
      work(x, y,
           static_cast<std::size_t>(y) * static_cast<std::size_t>(width)
               + static_cast<std::size_t>(x));
}

std::vector<Vec3> lab_of(image::Image const& picture) {
  image::Image const shown = image::tone_map(picture);
  std::vector<Vec3> lab(shown.pixels());
  for (std::size_t i = 0; i < lab.size(); ++i)
    lab[i] = image::xyz_to_lab(image::linear_srgb_to_xyz(image::pixel(shown, i)));
  return lab;
}

struct Tensor {
  double xx = 0, xy = 0, yy = 0;
};

/// Sums over a square around each pixel, one axis after the other.
std::vector<Tensor> smooth(std::vector<Tensor> const& tensors, int width, int height) {
  auto pass = [&](std::vector<Tensor> const& from, bool across) {
    std::vector<Tensor> to(from.size());
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        Tensor sum;
        for (int d = -radius; d <= radius; ++d) {
          int const u = std::clamp(x + (across ? d : 0), 0, width - 1);
          int const v = std::clamp(y + (across ? 0 : d), 0, height - 1);
          auto const& t = from[static_cast<std::size_t>(v) * static_cast<std::size_t>(width)
                               + static_cast<std::size_t>(u)];
          sum.xx += t.xx;
          sum.xy += t.xy;
          sum.yy += t.yy;
        }
        to[static_cast<std::size_t>(y) * static_cast<std::size_t>(width)
           + static_cast<std::size_t>(x)] = sum;
      }
    return to;
  };
  return pass(pass(tensors, true), false);
}

} // namespace

DispersionField dispersion_field(image::Image const& reference) {
  DispersionField field{reference.width, reference.height, {}, {}, {}};
  auto const lab = lab_of(reference);
  auto const across = static_cast<std::size_t>(reference.width);
  std::vector<Tensor> tensors(lab.size());
  for_inner(field.width, field.height, [&](int, int, std::size_t i) {
    Vec3 const gx = 0.5 * (lab[i + 1] - lab[i - 1]), gy = 0.5 * (lab[i + across] - lab[i - across]);
    for (int c = 1; c < 3; ++c) {
      tensors[i].xx += gx[c] * gx[c];
      tensors[i].xy += gx[c] * gy[c];
      tensors[i].yy += gy[c] * gy[c];
    }
  });
  for (auto const& t : smooth(tensors, field.width, field.height)) {
    double const angle = 0.5 * std::atan2(2 * t.xy, t.xx - t.yy);
    field.dx.push_back(static_cast<float>(std::cos(angle)));
    field.dy.push_back(static_cast<float>(std::sin(angle)));
    double const apart = std::hypot(2 * t.xy, t.xx - t.yy), sum = t.xx + t.yy;
    field.weight.push_back(static_cast<float>(std::sqrt(0.5 * (sum + apart))
                                              - std::sqrt(std::max(0.0, 0.5 * (sum - apart)))));
  }
  return field;
}

double banding(image::Image const& reference, image::Image const& test,
               DispersionField const& field) {
  auto error = lab_of(test);
  auto const truth = lab_of(reference);
  for (std::size_t i = 0; i < error.size(); ++i) error[i] -= truth[i];
  auto const across = static_cast<std::size_t>(field.width);
  double energy = 0, weights = 0;
  for_inner(field.width, field.height, [&](int, int, std::size_t i) {
    Vec3 const gx = 0.5 * (error[i + 1] - error[i - 1]);
    Vec3 const gy = 0.5 * (error[i + across] - error[i - across]);
    double const dx = field.dx[i], dy = field.dy[i], w = field.weight[i];
    Vec3 const along = dx * gx + dy * gy, over = dx * gy - dy * gx;
    energy += w * (glm::dot(along, along) - glm::dot(over, over));
    weights += w;
  });
  return weights > 0 ? std::sqrt(std::max(0.0, energy / weights)) : 0;
}

} // namespace abbe::study
