// SPDX-License-Identifier: MIT
#include "base/read_file.hpp"

#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace abbe {
namespace {

Error refused(int reason) {
  return {"E0501", std::generic_category().message(reason)};
}

struct Descriptor {
  int file;
  explicit Descriptor(int opened) : file(opened) {}
  Descriptor(Descriptor const&) = delete;
  Descriptor& operator=(Descriptor const&) = delete;
  ~Descriptor() {
    if (file >= 0) close(file);
  }
};

} // namespace

Result<ReadFile> read_file(std::string const& path) {
  // Without O_NONBLOCK a pipe would be waited for.
  Descriptor const opened(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat status {};
  if (opened.file < 0 || fstat(opened.file, &status) != 0) return refused(errno);
  if (S_ISDIR(status.st_mode)) return refused(EISDIR);
  if (!S_ISREG(status.st_mode)) return Error{"E0501", "Not a regular file"};
  // The kernel's own name of what was opened: whatever becomes of the path, this is the file.
  std::string const name = "/proc/self/fd/" + std::to_string(opened.file);
  std::error_code failed;
  auto const place = std::filesystem::read_symlink(name, failed);
  if (failed) return refused(failed.value());
  auto text = FileText::read(name);
  if (!text) return refused(EIO);
  return ReadFile{std::move(*text), place.string()};
}

} // namespace abbe
