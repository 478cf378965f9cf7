// SPDX-License-Identifier: MIT
#include "image/atomic_file.hpp"
#include "image/colour.hpp"
#include "image/io.hpp"
#include "image/spectral_layout.hpp"
#include "image/writer.hpp"

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

Imf::Header header_of(ImageHead const& head, ExrOptions const& options) {
  Imf::Header header(head.width, head.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  auto const xy = [](Vec2 v) {
    return Imath::V2f(static_cast<float>(v.x), static_cast<float>(v.y));
  };
  Imf::addChromaticities(header, {xy(srgb_primaries.red), xy(srgb_primaries.green),
                                  xy(srgb_primaries.blue), xy(srgb_primaries.white)});
  for (auto const& [key, value] : head.metadata) header.insert(key, Imf::StringAttribute(value));
  for (auto const& key : head.late_keys)
    header.insert(key, Imf::StringAttribute(std::string(late_value_size, ' ')));
  if (options.spectral) {
    header.insert(layout_version_attribute, Imf::StringAttribute("1.0"));
    header.insert(emissive_units_attribute, Imf::StringAttribute("W.m^-2.sr^-1"));
    if (!head.band_edges_nm.empty())
      header.insert(band_edges_attribute, Imf::StringAttribute(join_numbers(head.band_edges_nm)));
  }
  auto const type = options.depth == ExrOptions::Depth::Half ? Imf::HALF : Imf::FLOAT;
  Image nothing;
  nothing.band_centres_nm = head.band_centres_nm;
  if (head.alpha) nothing.alpha.resize(1);
  for (Source const& source : sources_of(nothing, options.spectral))
    header.channels().insert(source.name, Imf::Channel(type));
  return header;
}

/// The first finite value that half would turn into an infinity.
float const* beyond_half(std::vector<float> const& values) {
  auto const found = std::find_if(values.begin(), values.end(), [](float value) {
    return std::isfinite(value) && half(value).isInfinity();
  });
  return found == values.end() ? nullptr : &*found;
}

class ExrWriter final : public ImageWriter {
public:
  ExrWriter(ImageHead head, ExrOptions const& options, std::filesystem::path path, AtomicFile file)
      : head_(std::move(head)),
        options_(options),
        path_(std::move(path)),
        file_(std::move(file)),
        stream_(file_, path_.string()) {}

  Status begin() {
    return guarded(
        [&] { output_ = std::make_unique<Imf::OutputFile>(stream_, header_of(head_, options_)); });
  }

  Status write(Image const& rows) override {
    bool const halves = options_.depth == ExrOptions::Depth::Half;
    if (halves)
      if (Status const fits = check_half(rows); !fits) return fits;
    return guarded([&] {
      auto const sources = sources_of(rows, options_.spectral);
      if (halves)
        write_half(rows, sources);
      else
        write_float(rows, sources);
    });
  }

  Status finish(std::vector<std::string> const& late) override {
    ABBE_ASSERT(late.size() == head_.late_keys.size());
    Status const closed = guarded([&] { output_.reset(); });
    if (!closed) return closed;
    for (std::size_t i = 0; i < late.size(); ++i)
      if (Status const filled = fill_in(head_.late_keys[i], late[i]); !filled) return filled;
    return file_.commit();
  }

private:
  template <class Work>
  Status guarded(Work const& work) {
    try {
      work();
    } catch (std::exception const& failure) {
      if (stream_.os_error()) return file_.error(stream_.os_error());
      return refuse(failure.what());
    }
    return std::monostate{};
  }

  Error refuse(std::string const& why) const {
    return Error{"E0516", fmt::format("cannot write '{}': {}", path_.string(), why)};
  }

  Status check_half(Image const& rows) const {
    float const* value = beyond_half(rows.rgb);
    if (!value && options_.spectral) value = beyond_half(rows.bands);
    if (!value) return std::monostate{};
    return refuse(
        fmt::format("the value {} does not fit into half floats (65504); write floats", *value));
  }

  void write_float(Image const& rows, std::vector<Source> const& sources) {
    Imf::FrameBuffer frame;
    for (Source const& source : sources) {
      // OpenEXR takes what it reads as char*, and counts from the first row of the picture.
      std::size_t const step = source.step * sizeof(float);
      std::size_t const row = step * static_cast<std::size_t>(rows.width);
      auto const first =
          reinterpret_cast<std::uintptr_t>(source.first) - static_cast<std::uintptr_t>(next_) * row;
      frame.insert(source.name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(first), step, row));
    }
    output_->setFrameBuffer(frame);
    output_->writePixels(rows.height);
    next_ += rows.height;
  }

  /// Rows are converted one at a time, so that no second image is held.
  void write_half(Image const& rows, std::vector<Source> const& sources) {
    auto const width = static_cast<std::size_t>(rows.width);
    std::vector<half> row(sources.size() * width);
    Imf::FrameBuffer frame;
    for (std::size_t s = 0; s < sources.size(); ++s)
      frame.insert(sources[s].name, Imf::Slice(Imf::HALF, reinterpret_cast<char*>(&row[s * width]),
                                               sizeof(half), 0));
    output_->setFrameBuffer(frame);
    for (int y = 0; y < rows.height; ++y) {
      for (std::size_t s = 0; s < sources.size(); ++s) {
        float const* from =
            sources[s].first + static_cast<std::size_t>(y) * width * sources[s].step;
        for (std::size_t x = 0; x < width; ++x)
          row[s * width + x] = half(from[x * sources[s].step]);
      }
      output_->writePixels(1);
    }
  }

  /// Writes the value over the blanks in the header.
  Status fill_in(std::string const& key, std::string const& value) {
    ABBE_ASSERT(value.size() <= late_value_size);
    std::FILE* const file = file_.stream();
    errno = 0;
    std::string header(1 << 20, '\0');
    if (::fseeko(file, 0, SEEK_SET) != 0) return file_.error(errno);
    header.resize(std::fread(header.data(), 1, header.size(), file));
    std::size_t const at = header.find(key + std::string("\0string\0", 8));
    if (at == std::string::npos) return file_.error(errno ? errno : EIO);
    auto const place = static_cast<off_t>(at + key.size() + 8 + 4);
    if (::fseeko(file, place, SEEK_SET) != 0
        || std::fwrite(value.data(), 1, value.size(), file) != value.size())
      return file_.error(errno ? errno : EIO);
    return std::monostate{};
  }

  ImageHead head_;
  ExrOptions options_;
  std::filesystem::path path_;
  AtomicFile file_;
  Stream stream_;
  std::unique_ptr<Imf::OutputFile> output_;
  int next_ = 0; ///< row
};

} // namespace

Result<std::unique_ptr<ImageWriter>> open_exr(ImageHead head, std::filesystem::path const& path,
                                              ExrOptions const& options) {
  auto const refuse = [&](std::string const& why) {
    return Error{"E0516", fmt::format("cannot write '{}': {}", path.string(), why)};
  };
  if (options.spectral && head.band_centres_nm.empty())
    return refuse("the image has no spectral bands");
  if (options.spectral && !(head.band_centres_nm.front() > 0))
    return refuse("a band is centred at a wavelength <= 0");
  Result<AtomicFile> file = AtomicFile::create(path);
  if (!file) return file.error();
  auto writer = std::make_unique<ExrWriter>(std::move(head), options, path, std::move(*file));
  if (Status const begun = writer->begin(); !begun) return begun.error();
  return std::unique_ptr<ImageWriter>(std::move(writer));
}

} // namespace abbe::image
