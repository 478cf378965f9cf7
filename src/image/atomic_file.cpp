// SPDX-License-Identifier: MIT
#include "image/atomic_file.hpp"

#include <atomic>
#include <cerrno>
#include <fcntl.h>
#include <fmt/format.h>
#include <system_error>
#include <unistd.h>

namespace abbe::image {
namespace fs = std::filesystem;
namespace {

std::string reason(int os_error) {
  return std::generic_category().message(os_error);
}

Error cannot_write(fs::path const& path, std::string const& why) {
  return Error{"E0510", fmt::format("cannot write '{}': {}", path.string(), why)};
}

/// Distinct within the process; the process number makes it distinct on the machine, O_EXCL
/// decides.
fs::path temporary_name(fs::path const& target) {
  static std::atomic<unsigned> count{0};
  return target.parent_path()
         / fmt::format(".{}.{}-{}.tmp", target.filename().string().substr(0, 200), ::getpid(),
                       count++);
}

} // namespace

Result<fs::path> writable_target(fs::path const& path) {
  std::error_code failed;
  fs::path target = path;
  if (fs::is_symlink(fs::symlink_status(path, failed))) {
    target = fs::weakly_canonical(path, failed);
    if (failed) return cannot_write(path, failed.message());
  }
  fs::file_status const status = fs::status(target, failed);
  if (fs::is_directory(status)) return cannot_write(path, "it is a directory");
  if (fs::exists(status) && !fs::is_regular_file(status))
    return cannot_write(path, "it is not a regular file");
  fs::path const directory = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (::access(directory.c_str(), W_OK | X_OK) != 0) return cannot_write(path, reason(errno));
  if (!fs::is_directory(directory, failed)) return cannot_write(path, reason(ENOTDIR));
  return target;
}

Result<AtomicFile> AtomicFile::create(fs::path const& path) {
  Result<fs::path> target = writable_target(path);
  if (!target) return target.error();
  for (;;) {
    fs::path const temporary = temporary_name(*target);
    int const descriptor = ::open(temporary.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0 && (errno == EEXIST || errno == EINTR)) continue;
    if (descriptor < 0) return cannot_write(path, reason(errno));
    std::FILE* stream = ::fdopen(descriptor, "w+b");
    if (!stream) {
      int const os_error = errno;
      ::close(descriptor);
      ::unlink(temporary.c_str());
      return cannot_write(path, reason(os_error));
    }
    return AtomicFile(*target, temporary, stream);
  }
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : target_(std::move(other.target_)),
      temporary_(std::move(other.temporary_)),
      stream_(std::exchange(other.stream_, nullptr)) {}

AtomicFile::~AtomicFile() {
  if (!stream_) return;
  std::fclose(stream_);
  ::unlink(temporary_.c_str());
}

Error AtomicFile::error(int os_error) const {
  return cannot_write(target_, os_error ? reason(os_error) : "unknown reason");
}

Status AtomicFile::commit() {
  ABBE_ASSERT(stream_ != nullptr);
  // A write that failed earlier has set the error flag; its errno is lost, EIO says as much.
  bool const failed_before = std::ferror(stream_) != 0;
  if (std::fflush(stream_) != 0) return error(errno);
  if (failed_before) return error(EIO);
  if (::fsync(::fileno(stream_)) != 0 && errno != EINVAL && errno != ENOTSUP) return error(errno);
  bool const closed = std::fclose(std::exchange(stream_, nullptr)) == 0;
  if (!closed || ::rename(temporary_.c_str(), target_.c_str()) != 0) {
    int const os_error = errno;
    ::unlink(temporary_.c_str());
    return error(os_error);
  }
  return std::monostate{};
}

Status write_text(std::filesystem::path const& path, std::string const& text) {
  auto file = AtomicFile::create(path);
  if (!file) return file.error();
  if (std::fwrite(text.data(), 1, text.size(), file->stream()) != text.size())
    return file->error(errno);
  return file->commit();
}

} // namespace abbe::image
