// SPDX-License-Identifier: MIT
#pragma once

#include "image/image.hpp"

#include <cstdio>
#include <filesystem>

namespace abbe::image {

/// A file that appears under its name only when it is complete: written under a temporary name in
/// the same directory, with the mode and owner of what it replaces, renamed by commit(), removed
/// when destroyed before that. What a killed
/// process left there is removed when the same file is written again; what a living one writes is
/// not.
class AtomicFile {
public:
  /// @error E0510 with the reason of the operating system; something other than a file in the way
  static Result<AtomicFile> create(std::filesystem::path const& path);

  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&&) = delete;
  ~AtomicFile();

  /// Open for reading and writing, at position 0.
  std::FILE* stream() const { return stream_; }
  /// To the disk and to its final name. @error E0510 also for writes that failed before
  Status commit();

  /// "cannot write 'a/b.exr': No space left on device"
  Error error(int os_error) const;

private:
  AtomicFile(std::filesystem::path target, std::filesystem::path temporary, std::FILE* stream);
  std::filesystem::path target_;
  std::filesystem::path temporary_;
  std::FILE* stream_;
  int unfinished_ = -1; ///< its place among those of remove_unfinished()
};

/// Removes what this process has not committed, for a signal handler that ends it at once: nothing
/// is allocated and no lock is taken.
void remove_unfinished();

/// The file that a write to `path` replaces: links are followed.
/// @error E0510 no such directory, not writable, or not a regular file
Result<std::filesystem::path> writable_target(std::filesystem::path const& path);

/// A whole text file at once. @error E0510
Status write_text(std::filesystem::path const& path, std::string const& text);

} // namespace abbe::image
