// SPDX-License-Identifier: MIT
#include "image/atomic_file.hpp"
#include "image/colour.hpp"
#include "image/io.hpp"
#include "image/spectral_layout.hpp"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <fmt/format.h>
#include <half.h>
#include <stdexcept>

namespace abbe::image {
namespace {

/// OpenEXR writes through this; a short write stops it.
class Stream : public Imf::OStream {
public:
  Stream(AtomicFile const& file, std::string const& name)
      : Imf::OStream(name.c_str()), stream_(file.stream()) {}
  void write(char const bytes[], int count) override {
    auto const size = static_cast<std::size_t>(count);
    errno = 0;
    if (std::fwrite(bytes, 1, size, stream_) != size) fail();
  }
  std::uint64_t tellp() override {
    off_t const position = ::ftello(stream_);
    if (position < 0) fail();
    return static_cast<std::uint64_t>(position);
  }
  void seekp(std::uint64_t position) override {
    if (::fseeko(stream_, static_cast<off_t>(position), SEEK_SET) != 0) fail();
  }
  int os_error() const { return os_error_; }

private:
  [[noreturn]] void fail() {
    os_error_ = errno ? errno : EIO;
    throw std::runtime_error("write failed");
  }
  std::FILE* stream_;
  int os_error_ = 0;
};

/// One channel of the file and where its values come from.
struct Source {
  std::string name;
  float const* first;
  std::size_t step; ///< values from pixel to pixel
};

std::vector<Source> sources_of(Image const& image, bool spectral) {
  std::vector<Source> sources{
      {"R", image.rgb.data(), 3}, {"G", image.rgb.data() + 1, 3}, {"B", image.rgb.data() + 2, 3}};
  if (!image.alpha.empty()) sources.push_back({"A", image.alpha.data(), 1});
  if (!spectral) return sources;
  std::size_t const n_bands = image.band_centres_nm.size();
  for (std::size_t b = 0; b < n_bands; ++b)
    sources.push_back(
        {spectral_channel_name(image.band_centres_nm[b]), image.bands.data() + b, n_bands});
  return sources;
}

Imf::Header header_of(Image const& image, std::vector<Source> const& sources,
                      ExrOptions const& options) {
  Imf::Header header(image.width, image.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  auto const xy = [](Vec2 v) {
    return Imath::V2f(static_cast<float>(v.x), static_cast<float>(v.y));
  };
  Imf::addChromaticities(header, {xy(srgb_primaries.red), xy(srgb_primaries.green),
                                  xy(srgb_primaries.blue), xy(srgb_primaries.white)});
  for (auto const& [key, value] : image.metadata) header.insert(key, Imf::StringAttribute(value));
  if (options.spectral) {
    header.insert(layout_version_attribute, Imf::StringAttribute("1.0"));
    header.insert(emissive_units_attribute, Imf::StringAttribute("W.m^-2.sr^-1"));
    if (!image.band_edges_nm.empty())
      header.insert(band_edges_attribute, Imf::StringAttribute(join_numbers(image.band_edges_nm)));
  }
  auto const type = options.depth == ExrOptions::Depth::Half ? Imf::HALF : Imf::FLOAT;
  for (Source const& source : sources) header.channels().insert(source.name, Imf::Channel(type));
  return header;
}

void write_float(Imf::OutputFile& file, Image const& image, std::vector<Source> const& sources) {
  Imf::FrameBuffer frame;
  for (Source const& source : sources) {
    // OpenEXR takes what it reads as char*.
    char* base = const_cast<char*>(reinterpret_cast<char const*>(source.first));
    std::size_t const step = source.step * sizeof(float);
    frame.insert(source.name,
                 Imf::Slice(Imf::FLOAT, base, step, step * static_cast<std::size_t>(image.width)));
  }
  file.setFrameBuffer(frame);
  file.writePixels(image.height);
}

/// Rows are converted one at a time, so that no second image is held.
void write_half(Imf::OutputFile& file, Image const& image, std::vector<Source> const& sources) {
  auto const width = static_cast<std::size_t>(image.width);
  std::vector<half> row(sources.size() * width);
  Imf::FrameBuffer frame;
  for (std::size_t s = 0; s < sources.size(); ++s)
    frame.insert(sources[s].name,
                 Imf::Slice(Imf::HALF, reinterpret_cast<char*>(&row[s * width]), sizeof(half), 0));
  file.setFrameBuffer(frame);
  for (int y = 0; y < image.height; ++y) {
    for (std::size_t s = 0; s < sources.size(); ++s) {
      float const* from = sources[s].first + static_cast<std::size_t>(y) * width * sources[s].step;
      for (std::size_t x = 0; x < width; ++x) row[s * width + x] = half(from[x * sources[s].step]);
    }
    file.writePixels(1);
  }
}

/// The first finite value that half would turn into an infinity.
float const* beyond_half(std::vector<float> const& values) {
  auto const found = std::find_if(values.begin(), values.end(), [](float value) {
    return std::isfinite(value) && half(value).isInfinity();
  });
  return found == values.end() ? nullptr : &*found;
}

Status check_contents(Image const& image, std::filesystem::path const& path,
                      ExrOptions const& options) {
  if (Status const valid = validate(image); !valid) return valid;
  auto const refuse = [&](std::string const& why) {
    return Error{"E0516", fmt::format("cannot write '{}': {}", path.string(), why)};
  };
  if (options.spectral && image.bands.empty()) return refuse("the image has no spectral bands");
  if (options.spectral && !(image.band_centres_nm.front() > 0))
    return refuse("a band is centred at a wavelength <= 0");
  if (options.depth == ExrOptions::Depth::Half) {
    float const* value = beyond_half(image.rgb);
    if (!value && options.spectral) value = beyond_half(image.bands);
    if (value)
      return refuse(
          fmt::format("the value {} does not fit into half floats (65504); write floats", *value));
  }
  return std::monostate{};
}

} // namespace

Status write_exr(Image const& image, std::filesystem::path const& path, ExrOptions const& options) {
  if (Status const valid = check_contents(image, path, options); !valid) return valid;
  Result<AtomicFile> file = AtomicFile::create(path);
  if (!file) return file.error();
  Stream stream(*file, path.string());
  try {
    std::vector<Source> const sources = sources_of(image, options.spectral);
    Imf::OutputFile output(stream, header_of(image, sources, options));
    if (options.depth == ExrOptions::Depth::Half)
      write_half(output, image, sources);
    else
      write_float(output, image, sources);
  } catch (std::exception const& failure) {
    if (stream.os_error()) return file->error(stream.os_error());
    return Error{"E0516", fmt::format("cannot write '{}': {}", path.string(), failure.what())};
  }
  return file->commit();
}

} // namespace abbe::image
