// SPDX-License-Identifier: MIT
#include "base/new_file.hpp"

#include <cerrno>
#include <cstdint>
#include <fcntl.h>
#include <fmt/format.h>
#include <string>
#include <string_view>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace abbe {

namespace {

/// The temporary names of a target begin with this. A name has at most 255 bytes.
std::string stem_of(std::filesystem::path const& target) {
  return fmt::format(".{}.", target.filename().string().substr(0, 200));
}

bool is_ours(std::string_view name, std::string_view stem) {
  constexpr std::string_view end = ".tmp";
  if (name.size() != stem.size() + 16 + end.size() || !name.starts_with(stem)
      || !name.ends_with(end))
    return false;
  return name.substr(stem.size(), 16).find_first_not_of("0123456789abcdef") == name.npos;
}

/// Removes what killed processes left of the same target. Whoever writes holds a lock, which the
/// system takes from the dead; where there are no locks nothing is removed.
void remove_left_over(std::filesystem::path const& target) {
  std::string const stem = stem_of(target);
  auto const folder = target.has_parent_path() ? target.parent_path() : std::filesystem::path(".");
  std::error_code failed;
  for (std::filesystem::directory_iterator it(folder, failed), end; !failed && it != end;
       it.increment(failed)) {
    if (!is_ours(it->path().filename().string(), stem)) continue;
    int const descriptor = open(it->path().c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (descriptor < 0) continue;
    if (flock(descriptor, LOCK_EX | LOCK_NB) == 0) unlink(it->path().c_str());
    close(descriptor);
  }
}

/// Held until the file is closed. @return false: somebody took it for left over in between
bool hold(int descriptor) {
  if (flock(descriptor, LOCK_EX) != 0) return true; // no locks here: nobody removes it either
  struct stat status {};
  return fstat(descriptor, &status) != 0 || status.st_nlink > 0;
}

} // namespace

NewFile make_file_beside(std::filesystem::path const& target) {
  remove_left_over(target);
  for (;;) {
    std::uint64_t number = 0;
    if (getrandom(&number, sizeof number, 0) < 0) return {};
    NewFile file{-1, target.parent_path() / fmt::format("{}{:016x}.tmp", stem_of(target), number)};
    file.descriptor =
        open(file.path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (file.descriptor < 0 && errno != EEXIST && errno != EINTR) return file;
    if (file.descriptor < 0) continue;
    if (hold(file.descriptor)) return file;
    close(file.descriptor);
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
