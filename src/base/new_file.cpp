// SPDX-License-Identifier: MIT
#include "base/new_file.hpp"

#include <cerrno>
#include <cstdint>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

namespace abbe {

NewFile make_file_beside(std::filesystem::path const& target) {
  for (;;) {
    std::uint64_t number = 0;
    if (getrandom(&number, sizeof number, 0) < 0) return {};
    // A name has at most 255 bytes.
    NewFile file{-1, target.parent_path()
                         / fmt::format(".{}.{:016x}.tmp", target.filename().string().substr(0, 200),
                                       number)};
    file.descriptor =
        open(file.path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (file.descriptor >= 0 || (errno != EEXIST && errno != EINTR)) return file;
  }
}

void take_over_rights(int descriptor, std::filesystem::path const& replaced) {
  struct stat status {};
  if (stat(replaced.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return;
  // The owner first: a change of it takes bits of the mode away.
  if (fchown(descriptor, status.st_uid, status.st_gid) != 0) [[maybe_unused]]
    int const of_group = fchown(descriptor, static_cast<uid_t>(-1), status.st_gid);
  [[maybe_unused]] int const changed = fchmod(descriptor, status.st_mode & 07777);
}

} // namespace abbe
