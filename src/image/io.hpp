// SPDX-License-Identifier: MIT
#pragma once

#include "image/image.hpp"
#include "image/tone_map.hpp"

#include <filesystem>

/// Images in and out of files.
///
/// Every file is written to a temporary name in the directory of its destination and renamed when
/// it is complete and on the disk: readers see the old file or the new one, never half of one.
/// After a failure the temporary is gone and the destination untouched. A symbolic link is
/// followed.
///
/// Errors: E0510 a file cannot be written (with the reason of the operating system), E0511 cannot
/// be read (the same), E0512 unknown extension or format, E0513 damaged, E0514 too large, E0515 the
/// image does not fit together, E0516 the format cannot hold what the image has.
namespace abbe::image {

/// How an OpenEXR file stores its channels (ZIP compression, lossless).
struct ExrOptions {
  /// Write Image::bands as well, in the layout of Fichet, Pacanowski, Wilkie, "An OpenEXR Layout
  /// for Spectral Images", JCGT 10(3), 2021: channels `S0.550,5nm`, attributes
  /// spectralLayoutVersion "1.0" and emissiveUnits. R, G, B remain, as the preview.
  /// The edges of the bands go to the attribute `abbeBandEdges` (nm, decimal, separated by blanks).
  bool spectral = false;
  enum class Depth { Float, Half } depth = Depth::Float;
};

/// How linear light becomes the codes of a display: PNG, PPM, TGA, BMP and JPEG.
struct DisplayOptions {
  int bits = 8;          ///< 8 or 16 per channel; 16 of PNG and PPM only
  ToneOptions tone{};    ///< from linear light to [0, 1]
  double gamma = 0;      ///< codes are light to the power 1 / gamma; 0: the sRGB transfer function
  bool compress = false; ///< TGA: run lengths
  int quality = 95;      ///< JPEG: 1 to 100
};

struct WriteOptions {
  ExrOptions exr{};
  DisplayOptions display{};
};

/// Linear light, unclamped, with alpha and (on request) bands. Metadata become string attributes.
/// @error E0516 spectral asked for without bands; a finite value beyond the range of half
Status write_exr(Image const& image, std::filesystem::path const& path,
                 ExrOptions const& options = {});

/// Display-referred: tone_map(options.tone), transfer function, rounded to nearest; no dither. RGBA
/// (not premultiplied, as PNG wants it) only when the image has alpha. Chunks sRGB and gAMA,
/// metadata as tEXt (iTXt where not ASCII).
/// @error E0516 a metadata key that PNG does not admit (1 to 79 printable ASCII characters)
Status write_png(Image const& image, std::filesystem::path const& path,
                 DisplayOptions const& options = {});

/// 32-bit LogLuv (Ward Larson 1998; libtiff's SGILOG): CIE XYZ with luminance in steps of 0.27 %
/// over 38 decades and u'v' in steps of 1/410. Colours outside sRGB are kept. Metadata as lines
/// `key: value` of ImageDescription. A pixel of negative luminance has no meaning here: black.
/// @error E0516 the image has alpha, which LogLuv cannot hold
Status write_tiff_logluv(Image const& image, std::filesystem::path const& path);

/// By the extension, in any case: .exr, .png, .tif or .tiff (LogLuv); .ppm, .tga, .bmp, .jpg or
/// .jpeg (display-referred, as PNG); .hdr (Radiance: linear, shared exponent).
/// Metadata are written by PNG, EXR, TIFF and PPM (as comments). Alpha is kept by PNG, EXR, TGA and
/// BMP; the others are shown on black. @error E0512 any other extension; E0516 16 bits where the
/// format has 8
Status write(Image const& image, std::filesystem::path const& path,
             WriteOptions const& options = {});

/// Could `path` be written, as far as can be told before the work is done: known extension,
/// existing writable directory, no directory or device in its place? Creates nothing.
Status check_destination(std::filesystem::path const& path);

/// R, G, B (A), or Y (A) as grey; half, float or integer; scan lines or tiles; the first part of
/// several. Bands when the file follows the layout above (emissive, unpolarised part S0). Other
/// primaries (`chromaticities`) are converted, without adaptation of the white point. The image is
/// the data window.
Result<Image> read_exr(std::filesystem::path const& path);

/// Grey, palette or RGB, with or without alpha, 1 to 16 bits, interlaced or not. Linearised by the
/// sRGB curve, or by the power of a gAMA chunk when that alone is given.
Result<Image> read_png(std::filesystem::path const& path);

/// LogLuv, 32 or 24 bits. @error E0516 any other kind of TIFF
Result<Image> read_tiff(std::filesystem::path const& path);

/// By what the file begins with, whatever its name. Damaged, truncated or absurdly large files are
/// errors: a size that the length of the file cannot account for is refused before any allocation.
Result<Image> read(std::filesystem::path const& path);

} // namespace abbe::image
