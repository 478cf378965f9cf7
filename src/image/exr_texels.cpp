// SPDX-License-Identifier: MIT
#include "image/exr_header.hpp"
#include "image/exr_stream.hpp"
#include "image/texels.hpp"

#include <ImfIO.h>
#include <algorithm>
#include <cstring>

namespace abbe::image {
namespace {

/// Bytes in memory, as OpenEXR reads a file.
class MemoryStream final : public Imf::IStream {
public:
  MemoryStream(std::string_view bytes, std::string const& name)
      : IStream(name.c_str()), bytes_(bytes) {}
  bool read(char* to, int count) override {
    auto const wanted = static_cast<std::uint64_t>(std::max(count, 0));
    if (at_ > bytes_.size() || wanted > bytes_.size() - at_)
      throw std::runtime_error("it breaks off");
    std::memcpy(to, bytes_.data() + at_, wanted);
    at_ += wanted;
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t place) override { at_ = place; }

private:
  std::string_view bytes_;
  std::uint64_t at_ = 0;
};

} // namespace

Result<Texels> read_exr_texels(std::string_view bytes, std::string const& name) {
  InputFile file;
  file.stream.reset(::fmemopen(const_cast<char*>(bytes.data()), bytes.size(), "rb"));
  file.size = bytes.size();
  if (!file.stream) return damaged_texels(name, "no memory to read it");
  if (Status const sane = check_exr_header(name, file); !sane) return sane.error();
  MemoryStream stream(bytes, name);
  Result<Image> const image = read_exr_stream(stream, name);
  if (!image) return image.error();
  auto out = make_texels(image->width, image->height, name);
  if (!out) return out;
  out->gamma = 1;
  out->has_alpha = !image->alpha.empty();
  out->premultiplied = out->has_alpha;
  for (std::size_t i = 0; i < image->pixels(); ++i) {
    std::copy_n(&image->rgb[3 * i], 3, &out->rgba[4 * i]);
    if (out->has_alpha) out->rgba[4 * i + 3] = image->alpha[i];
  }
  return out;
}

} // namespace abbe::image
