// SPDX-License-Identifier: MIT
#include "image/atomic_file.hpp"

#include "base/new_file.hpp"

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <string_view>
#include <sys/file.h>
#include <sys/stat.h>
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

/// The temporary names of a target begin with this.
std::string temporary_stem(fs::path const& target) {
  return fmt::format(".{}.", target.filename().string().substr(0, 200));
}

/// Distinct within the process; the process number makes it distinct on the machine, O_EXCL
/// decides.
fs::path temporary_name(fs::path const& target) {
  static std::atomic<unsigned> count{0};
  return target.parent_path()
         / fmt::format("{}{}-{}.tmp", temporary_stem(target), ::getpid(), count++);
}

/// "PROCESS-NUMBER.tmp"
bool is_temporary_end(std::string_view end) {
  std::size_t const dash = end.find('-');
  if (dash == end.npos || end.size() < 4 || end.substr(end.size() - 4) != ".tmp") return false;
  auto const digits = [](std::string_view word) {
    return !word.empty() && word.find_first_not_of("0123456789") == word.npos;
  };
  return digits(end.substr(0, dash)) && digits(end.substr(dash + 1, end.size() - dash - 5));
}

/// Removes what killed processes left of the same target. Whoever writes holds a lock, which the
/// system takes from the dead; where there are no locks nothing is removed.
void remove_left_over(fs::path const& target) {
  std::string const stem = temporary_stem(target);
  fs::path const directory = target.has_parent_path() ? target.parent_path() : fs::path(".");
  std::error_code failed;
  for (fs::directory_iterator it(directory, failed), end; !failed && it != end;
       it.increment(failed)) {
    std::string const name = it->path().filename().string();
    if (name.compare(0, stem.size(), stem) != 0
        || !is_temporary_end(std::string_view(name).substr(stem.size())))
      continue;
    int const descriptor = ::open(it->path().c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW);
    if (descriptor < 0) continue;
    if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) ::unlink(it->path().c_str());
    ::close(descriptor);
  }
}

/// Held until the file is closed. @return false: somebody took it for left over in between
bool hold(int descriptor) {
  if (::flock(descriptor, LOCK_EX) != 0) return true; // no locks here: nobody removes it either
  struct stat status = {};
  return ::fstat(descriptor, &status) != 0 || status.st_nlink > 0;
}

/// Temporary names of what this process has not finished. Who takes a name out owns it.
constexpr int most_unfinished = 16;
std::atomic<char*> unfinished[most_unfinished];

/// @return its place; -1: there is no room, so that remove_unfinished() leaves it
int note_unfinished(fs::path const& temporary) {
  char* const name = ::strdup(temporary.c_str());
  for (int i = 0; name != nullptr && i < most_unfinished; ++i) {
    char* nothing = nullptr;
    if (unfinished[i].compare_exchange_strong(nothing, name)) return i;
  }
  std::free(name);
  return -1;
}
void forget_unfinished(int place) {
  if (place >= 0) std::free(unfinished[place].exchange(nullptr));
}

} // namespace

void remove_unfinished() {
  for (auto& place : unfinished)
    if (char const* const name = place.exchange(nullptr)) ::unlink(name);
}

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
  remove_left_over(*target);
  for (;;) {
    fs::path const temporary = temporary_name(*target);
    int const descriptor = ::open(temporary.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0 && (errno == EEXIST || errno == EINTR)) continue;
    if (descriptor < 0) return cannot_write(path, reason(errno));
    if (!hold(descriptor)) {
      ::close(descriptor);
      continue;
    }
    std::FILE* stream = ::fdopen(descriptor, "w+b");
    if (!stream) {
      int const os_error = errno;
      ::close(descriptor);
      ::unlink(temporary.c_str());
      return cannot_write(path, reason(os_error));
    }
    take_over_rights(descriptor, *target);
    return AtomicFile(*target, temporary, stream);
  }
}

AtomicFile::AtomicFile(fs::path target, fs::path temporary, std::FILE* stream)
    : target_(std::move(target)),
      temporary_(std::move(temporary)),
      stream_(stream),
      unfinished_(note_unfinished(temporary_)) {}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : target_(std::move(other.target_)),
      temporary_(std::move(other.temporary_)),
      stream_(std::exchange(other.stream_, nullptr)),
      unfinished_(std::exchange(other.unfinished_, -1)) {}

AtomicFile::~AtomicFile() {
  if (stream_) {
    std::fclose(stream_);
    ::unlink(temporary_.c_str());
  }
  forget_unfinished(unfinished_);
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
