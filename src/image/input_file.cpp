// SPDX-License-Identifier: MIT
#include "image/input_file.hpp"

#include <cerrno>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace abbe::image {
namespace {

Error cannot_read(std::filesystem::path const& path, std::string const& why) {
  return Error{"E0511", fmt::format("cannot read '{}': {}", path.string(), why)};
}

} // namespace

Result<InputFile> open_input(std::filesystem::path const& path) {
  // O_NONBLOCK: opening a pipe without a writer would otherwise wait for ever.
  int const descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return cannot_read(path, std::generic_category().message(errno));
  InputFile file;
  file.stream.reset(::fdopen(descriptor, "rb"));
  if (!file.stream) {
    ::close(descriptor);
    return cannot_read(path, std::generic_category().message(ENOMEM));
  }
  struct stat status {};
  if (::fstat(descriptor, &status) != 0)
    return cannot_read(path, std::generic_category().message(errno));
  if (!S_ISREG(status.st_mode))
    return cannot_read(path,
                       S_ISDIR(status.st_mode) ? "it is a directory" : "it is not a regular file");
  file.size = static_cast<std::uint64_t>(status.st_size);
  return file;
}

Error damaged(std::filesystem::path const& path, std::string const& why) {
  return Error{"E0513", fmt::format("'{}' is damaged: {}", path.string(), why)};
}

Error unsupported(std::filesystem::path const& path, std::string const& why) {
  return Error{"E0516", fmt::format("'{}' is not supported: {}", path.string(), why)};
}

Status check_size(std::filesystem::path const& path, std::int64_t width, std::int64_t height,
                  double most_pixels) {
  if (width <= 0 || height <= 0 || width > INT32_MAX || height > INT32_MAX)
    return damaged(path, fmt::format("its size is {} x {}", width, height));
  if (width * height > max_pixels)
    return Error{"E0514", fmt::format("'{}' is too large: {} x {} pixels, at most 2^31 are read",
                                      path.string(), width, height)};
  if (static_cast<double>(width) * static_cast<double>(height) > most_pixels)
    return damaged(path, fmt::format("it claims {} x {} pixels, for which it is far too short",
                                     width, height));
  return std::monostate{};
}

} // namespace abbe::image
