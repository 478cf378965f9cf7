// SPDX-License-Identifier: MIT
#pragma once

#include "image/io.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

/// Images that are written from the top, some rows at a time, so that no more of them need be in
/// memory. The files are those of image/io.hpp, to the byte, however the rows are cut.
namespace abbe::image {

/// What must be known before the first row.
struct ImageHead {
  int width = 0;
  int height = 0;
  bool alpha = false;
  std::vector<double> band_centres_nm; ///< empty: no bands
  std::vector<double> band_edges_nm;
  std::vector<std::pair<std::string, std::string>> metadata;
  /// Keys of metadata whose values are known at the end only (ImageWriter::finish). PNG has them
  /// behind the pixels. OpenEXR's header comes first: they are filled in there, padded with blanks.
  std::vector<std::string> late_keys;
};
ImageHead head_of(Image const& image);

/// Most bytes of a late value.
inline constexpr std::size_t late_value_size = 80;

/// The file appears under its name at finish(), complete; a writer that is destroyed before leaves
/// nothing behind. After an error a writer can only be destroyed.
class ImageWriter {
public:
  virtual ~ImageWriter() = default;
  /// The next rows, of the head's width, bands and alpha.
  /// @error as the writers of image/io.hpp: E0510 with the reason of the operating system, E0516
  virtual Status write(Image const& rows) = 0;
  /// After the last row. @param late values of the head's late keys, in their order
  virtual Status finish(std::vector<std::string> const& late) = 0;
};

/// By the extension, as image::write. @error E0512, E0510, E0516
Result<std::unique_ptr<ImageWriter>> open_writer(ImageHead head, std::filesystem::path const& path,
                                                 WriteOptions const& options = {});

/// The kinds, for image/io.cpp.
Result<std::unique_ptr<ImageWriter>> open_png(ImageHead head, std::filesystem::path const& path,
                                              DisplayOptions const& options);
Result<std::unique_ptr<ImageWriter>> open_exr(ImageHead head, std::filesystem::path const& path,
                                              ExrOptions const& options);
Result<std::unique_ptr<ImageWriter>> open_ppm(ImageHead head, std::filesystem::path const& path,
                                              DisplayOptions const& options);
Result<std::unique_ptr<ImageWriter>> open_tga(ImageHead head, std::filesystem::path const& path,
                                              DisplayOptions const& options);
Result<std::unique_ptr<ImageWriter>> open_bmp(ImageHead head, std::filesystem::path const& path,
                                              DisplayOptions const& options);
Result<std::unique_ptr<ImageWriter>> open_jpeg(ImageHead head, std::filesystem::path const& path,
                                               DisplayOptions const& options);
Result<std::unique_ptr<ImageWriter>> open_hdr(ImageHead head, std::filesystem::path const& path);
Result<std::unique_ptr<ImageWriter>> open_tiff_logluv(ImageHead head,
                                                      std::filesystem::path const& path);

} // namespace abbe::image
