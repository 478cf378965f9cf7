// SPDX-License-Identifier: MIT
#include "image/colour.hpp"
#include "image/exr_header.hpp"
#include "image/exr_stream.hpp"
#include "image/input_file.hpp"
#include "image/io.hpp"
#include "image/spectral_layout.hpp"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfStdIO.h>
#include <ImfStringAttribute.h>
#include <algorithm>
#include <fmt/format.h>
#include <glm/matrix.hpp>

namespace abbe::image {
namespace {

/// What the file offers of what we look for.
struct Contents {
  bool grey = false;
  bool alpha = false;
  std::vector<std::pair<double, std::string>> bands; ///< by wavelength
};

Result<Contents> contents_of(std::filesystem::path const& path, Imf::ChannelList const& channels) {
  Contents found;
  auto const has = [&](char const* name) { return channels.findChannel(name) != nullptr; };
  found.alpha = has("A");
  if (!(has("R") && has("G") && has("B"))) {
    if (!has("Y")) return unsupported(path, "it has neither the channels R, G, B nor Y");
    if (has("RY") || has("BY")) return unsupported(path, "its colours are luminance and chroma");
    found.grey = true;
  }
  for (auto it = channels.begin(); it != channels.end(); ++it) {
    auto const wavelength_nm = parse_spectral_channel(it.name());
    if (wavelength_nm) found.bands.emplace_back(*wavelength_nm, it.name());
    bool const used =
        wavelength_nm || std::string_view("RGBAY").find(it.name()) != std::string::npos;
    if (used && (it.channel().xSampling != 1 || it.channel().ySampling != 1))
      return unsupported(path, fmt::format("its channel {} is subsampled", it.name()));
  }
  std::sort(found.bands.begin(), found.bands.end());
  for (std::size_t b = 1; b < found.bands.size(); ++b)
    if (found.bands[b].first == found.bands[b - 1].first)
      return damaged(path, fmt::format("{} and {} are the same wavelength",
                                       found.bands[b - 1].second, found.bands[b].second));
  return found;
}

/// Reads the channels to their places in the image; OpenEXR converts half and integers.
void read_pixels(Imf::InputFile& file, Contents const& contents, Image& image) {
  Imath::Box2i const window = file.header().dataWindow();
  Imf::FrameBuffer frame;
  auto const add = [&](std::string const& name, float* first, std::size_t step) {
    frame.insert(name,
                 Imf::Slice::Make(Imf::FLOAT, first, window, step * sizeof(float),
                                  step * sizeof(float) * static_cast<std::size_t>(image.width)));
  };
  if (contents.grey) {
    add("Y", image.rgb.data(), 3);
  } else {
    add("R", image.rgb.data(), 3);
    add("G", image.rgb.data() + 1, 3);
    add("B", image.rgb.data() + 2, 3);
  }
  if (contents.alpha) add("A", image.alpha.data(), 1);
  for (std::size_t b = 0; b < contents.bands.size(); ++b)
    add(contents.bands[b].second, image.bands.data() + b, contents.bands.size());
  file.setFrameBuffer(frame);
  file.readPixels(window.min.y, window.max.y);
}

void convert_primaries(Imf::Header const& header, Image& image) {
  if (!Imf::hasChromaticities(header)) return;
  Imf::Chromaticities const& c = Imf::chromaticities(header);
  if (c == Imf::Chromaticities()) return; // the defaults are those of Rec. 709
  auto const xy = [](Imath::V2f v) { return Vec2(v.x, v.y); };
  Mat3 const to_xyz = rgb_to_xyz_matrix({xy(c.red), xy(c.green), xy(c.blue), xy(c.white)});
  for (std::size_t i = 0; i < image.pixels(); ++i)
    set_pixel(image, i, xyz_to_linear_srgb(to_xyz * pixel(image, i)));
}

Status read_attributes(std::filesystem::path const& path, Imf::Header const& header, Image& image) {
  for (auto it = header.begin(); it != header.end(); ++it) {
    auto const* text = dynamic_cast<Imf::StringAttribute const*>(&it.attribute());
    if (!text) continue;
    std::string_view const name = it.name();
    if (name == "type" || name == "name" || name == "view" || name == layout_version_attribute
        || name == emissive_units_attribute)
      continue;
    if (name == band_edges_attribute) {
      auto edges = split_numbers(text->value());
      if (!edges || edges->size() != image.band_centres_nm.size() + 1)
        return damaged(path, "its attribute abbeBandEdges does not fit its channels");
      image.band_edges_nm = *std::move(edges);
    } else {
      image.metadata.emplace_back(name, text->value());
    }
  }
  return std::monostate{};
}

} // namespace

Result<Image> read_exr_stream(Imf::IStream& stream, std::filesystem::path const& path) {
  try {
    Imf::InputFile file(stream);
    Imf::Header const& header = file.header();
    if (!file.isComplete()) return damaged(path, "it breaks off before its last pixel");
    Result<Contents> contents = contents_of(path, header.channels());
    if (!contents) return contents.error();
    Imath::Box2i const window = header.dataWindow();
    Image image = make_image(window.max.x - window.min.x + 1, window.max.y - window.min.y + 1);
    if (contents->alpha) image.alpha.resize(image.pixels());
    image.bands.resize(image.pixels() * contents->bands.size());
    for (auto const& band : contents->bands) image.band_centres_nm.push_back(band.first);
    read_pixels(file, *contents, image);
    if (contents->grey)
      for (std::size_t i = 0; i < image.pixels(); ++i) set_pixel(image, i, Vec3(image.rgb[3 * i]));
    else
      convert_primaries(header, image);
    if (Status const read = read_attributes(path, header, image); !read) return read.error();
    if (Status const valid = validate(image); !valid) return damaged(path, valid.error().message);
    return image;
  } catch (std::exception const& failure) { // Iex exceptions and bad_alloc
    return damaged(path, failure.what());
  }
}

Result<Image> read_exr(std::filesystem::path const& path) {
  Result<InputFile> opened = open_input(path);
  if (!opened) return opened.error();
  if (Status const sane = check_exr_header(path, *opened); !sane) return sane.error();
  try {
    Imf::StdIFStream stream(path.c_str());
    return read_exr_stream(stream, path);
  } catch (std::exception const& failure) {
    return damaged(path, failure.what());
  }
}

} // namespace abbe::image
