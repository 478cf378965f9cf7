// SPDX-License-Identifier: MIT
#pragma once

#include "base/result.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace abbe::image {

/// A picture as its file has it, before its codes are made light: for textures.
struct Texels {
  int width = 0, height = 0;
  std::vector<float> rgba; ///< 0..1 as coded, four a pixel, rows from the top
  bool has_alpha = false;
  bool premultiplied = false;       ///< colours are those of light, which alpha has weakened
  std::vector<std::uint16_t> index; ///< numbers of palette entries; empty: no palette
  /// How codes stand for light: 0 the file does not say, else the power that decodes them; below
  /// 0 the sRGB curve.
  double gamma = 0;
  /// The same where the file does not say: what its kind is taken for; 0: codes are light.
  double default_gamma = 0;
};

/// A picture in memory, by what it begins with. @param name for messages
/// @error E0512 unknown format, E0513 damaged, E0514 too large, E0516 a kind that is not read
Result<Texels> read_texels(std::string_view bytes, std::string const& name);

/// One function a format, for read_texels().
Result<Texels> read_png_texels(std::string_view bytes, std::string const& name);
Result<Texels> read_netpbm_texels(std::string_view bytes, std::string const& name);
Result<Texels> read_bmp_texels(std::string_view bytes, std::string const& name);
Result<Texels> read_tga_texels(std::string_view bytes, std::string const& name);
Result<Texels> read_gif_texels(std::string_view bytes, std::string const& name);
Result<Texels> read_hdr_texels(std::string_view bytes, std::string const& name);
Result<Texels> read_jpeg_texels(std::string_view bytes, std::string const& name);
Result<Texels> read_tiff_texels(std::string_view bytes, std::string const& name);
Result<Texels> read_exr_texels(std::string_view bytes, std::string const& name);

/// Makes texels of this size, black. @error E0513, E0514
Result<Texels> make_texels(std::int64_t width, std::int64_t height, std::string const& name);
/// E0513
Error damaged_texels(std::string const& name, std::string const& why);

} // namespace abbe::image
