// SPDX-License-Identifier: MIT
#include "study/heat.hpp"

#include "image/colour.hpp"
#include "image/io.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <sstream>

namespace abbe::study {
namespace {

using Scale = std::array<std::uint32_t, 10>;
constexpr Scale magma{0x000004, 0x180f3d, 0x440f76, 0x721f81, 0x9e2f7f,
                      0xcd4071, 0xf1605d, 0xfd9668, 0xfeca8d, 0xfcfdbf};
constexpr Scale viridis{0x440154, 0x482878, 0x3e4989, 0x31688e, 0x26828e,
                        0x1f9e89, 0x35b779, 0x6ece58, 0xb5de2b, 0xfde725};

Scale const& table_of(ColourScale scale) {
  return scale == ColourScale::Magma ? magma : viridis;
}

Vec3 code(std::uint32_t rgb) {
  return Vec3(rgb >> 16, rgb >> 8 & 255, rgb & 255) / 255.0;
}

/// Linear sRGB, as an image has it. @param t 0..1
Vec3 colour(ColourScale scale, double t) {
  auto const& table = table_of(scale);
  double const at = std::clamp(t, 0.0, 1.0) * static_cast<double>(table.size() - 1);
  auto const first = std::min<std::size_t>(static_cast<std::size_t>(at), table.size() - 2);
  Vec3 const mixed =
      glm::mix(code(table[first]), code(table[first + 1]), at - static_cast<double>(first));
  return {image::srgb_decode(mixed.x), image::srgb_decode(mixed.y), image::srgb_decode(mixed.z)};
}

} // namespace

std::vector<std::string> colours_of(ColourScale scale) {
  std::vector<std::string> out;
  for (auto const rgb : table_of(scale)) out.push_back(fmt::format("#{:06x}", rgb));
  return out;
}

image::Image error_map(std::vector<float> const& delta_e, int width, int height) {
  image::Image map = image::make_image(width, height);
  for (std::size_t i = 0; i < delta_e.size(); ++i)
    image::set_pixel(map, i,
                     colour(ColourScale::Magma, std::log1p(delta_e[i]) / std::log1p(most_delta_e)));
  return map;
}

image::Image cost_map(image::Image const& rays, double most) {
  image::Image map = image::make_image(rays.width, rays.height);
  for (std::size_t i = 0; i < rays.pixels(); ++i)
    image::set_pixel(map, i,
                     colour(ColourScale::Viridis, std::log(std::max(1.f, rays.rgb[3 * i]))
                                                      / std::log(std::max(2.0, most))));
  return map;
}

Result<std::string> png_of(image::Image const& picture, std::string const& keep_as) {
  auto const written = image::write_png(picture, keep_as);
  if (!written) return written.error();
  std::ifstream file(keep_as, std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  return std::move(bytes).str();
}

std::string base64(std::string const& bytes) {
  constexpr std::string_view letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    std::size_t const count = std::min<std::size_t>(3, bytes.size() - at);
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < 3; ++i)
      bits = bits << 8 | (i < count ? static_cast<unsigned char>(bytes[at + i]) : 0u);
    for (std::size_t i = 0; i < 4; ++i)
      out += i <= count ? letters[bits >> (18 - 6 * i) & 63] : '=';
  }
  return out;
}

} // namespace abbe::study
