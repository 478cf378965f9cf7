// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace abbe {

/// The bytes of a file, or of a string. Those of a large file are not copied: its pages are seen
/// as they stand (mmap), and take no memory of the process that was given up.
class FileText {
public:
  FileText(std::string text = {}) : own_(std::move(text)) {}
  FileText(char const* text) : own_(text) {}
  /// nullopt when there is no regular file or it cannot be read.
  static std::optional<FileText> read(std::string const& path);

  std::string_view view() const;
  std::size_t size() const { return view().size(); }
  /// The bytes as a string of their own.
  std::string take() &&;

  /// These bytes will hardly be looked at again: the system may have their memory. They stay what
  /// they are, and are read from the file anew.
  void give_up(std::size_t begin, std::size_t end) const;
  /// Was the file written to since it was read? Then view() may be neither the old nor the new.
  /// (Who cuts it short sends whoever looks at what is gone a SIGBUS.)
  bool changed() const;

private:
  struct Mapping;
  struct Unmap {
    void operator()(Mapping*) const;
  };
  static std::unique_ptr<Mapping, Unmap> map(std::string const& path);

  std::string own_;
  std::unique_ptr<Mapping, Unmap> mapping_; ///< of large files
};

} // namespace abbe
