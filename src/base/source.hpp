// SPDX-License-Identifier: MIT
#pragma once

#include "base/file_text.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace abbe {

/// One text that was read: a file, a string given on the command line, a slice of the catalogue.
/// Immutable once made; spans refer to it by pointer, so keep it alive (SourceSet does).
class SourceFile {
public:
  SourceFile(std::string name, FileText text);

  /// The path as the user would type it, for messages.
  std::string const& name() const { return name_; }
  /// Without a byte order mark.
  std::string_view text() const { return text_.view().substr(mark_); }
  FileText const& bytes() const { return text_; }

  struct Place {
    int line;   ///< from 1
    int column; ///< from 1, in bytes
  };
  Place place(std::uint32_t offset) const;
  /// The text of a line (from 1) without its line break: LF, CR LF or CR.
  std::string_view line(int number) const;

private:
  void index_lines() const;
  std::string name_;
  FileText text_;
  std::size_t mark_;                               ///< bytes of a byte order mark
  mutable std::vector<std::uint32_t> line_starts_; ///< filled on the first message
};

/// A range of bytes in one source. Offsets are 32 bits: a source is at most 4 GiB.
struct Span {
  SourceFile const* source = nullptr;
  std::uint32_t begin = 0;
  std::uint32_t end = 0;

  bool valid() const { return source != nullptr; }
  std::string_view text() const {
    return source ? source->text().substr(begin, end - begin) : std::string_view{};
  }
};

/// Owns the sources of one run.
class SourceSet {
public:
  SourceFile const& add(std::string name, FileText text);

private:
  std::vector<std::unique_ptr<SourceFile>> sources_;
};

} // namespace abbe
