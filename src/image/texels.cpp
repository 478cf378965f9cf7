// SPDX-License-Identifier: MIT
#include "image/texels.hpp"

#include "image/image.hpp"

#include <array>

namespace abbe::image {

namespace {

struct Format {
  std::string_view start;
  Result<Texels> (*read)(std::string_view, std::string const&);
};
constexpr Format formats[] = {
    {"\x89PNG", read_png_texels},       {"P2", read_netpbm_texels},
    {"P3", read_netpbm_texels},         {"P5", read_netpbm_texels},
    {"P6", read_netpbm_texels},         {"BM", read_bmp_texels},
    {"GIF8", read_gif_texels},          {"#?R", read_hdr_texels},
    {"\xff\xd8\xff", read_jpeg_texels}, {{"II*\0", 4}, read_tiff_texels},
    {{"MM\0*", 4}, read_tiff_texels},   {{"II+\0", 4}, read_tiff_texels},
    {{"MM\0+", 4}, read_tiff_texels},   {"v/1\x01", read_exr_texels},
};

} // namespace

Error damaged_texels(std::string const& name, std::string const& why) {
  return {"E0513", "'" + name + "' is damaged: " + why};
}

Result<Texels> make_texels(std::int64_t width, std::int64_t height, std::string const& name) {
  if (width <= 0 || height <= 0) return damaged_texels(name, "it has no size");
  if (width > max_pixels / height || width * height > (std::int64_t{1} << 28))
    return Error{"E0514", "'" + name + "' is too large for a texture"};
  Texels out;
  out.width = static_cast<int>(width);
  out.height = static_cast<int>(height);
  out.rgba.assign(4 * static_cast<std::size_t>(width * height), 0.0F);
  for (std::size_t k = 3; k < out.rgba.size(); k += 4) out.rgba[k] = 1;
  return out;
}

Result<Texels> read_texels(std::string_view bytes, std::string const& name) {
  for (Format const& format : formats)
    if (bytes.starts_with(format.start)) return format.read(bytes, name);
  // A TGA file has no mark at its start: its header must make sense.
  bool const ends_tga = bytes.size() > 18
                        && (bytes[2] == 1 || bytes[2] == 2 || bytes[2] == 3 || bytes[2] == 9
                            || bytes[2] == 10 || bytes[2] == 11);
  if (ends_tga) return read_tga_texels(bytes, name);
  return Error{
      "E0512",
      "'" + name
          + "' is no picture: PNG, JPEG, TIFF, GIF, BMP, TGA, PPM, PGM, HDR and OpenEXR are known"};
}

} // namespace abbe::image
