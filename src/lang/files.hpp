// SPDX-License-Identifier: MIT
#pragma once

#include "base/file_text.hpp"
#include "base/result.hpp"
#include "base/source.hpp"
#include "lang/value.hpp"

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace abbe::lang {

class Interpreter;

/// An open file of `#fopen`.
struct FileValue {
  bool writing = false;
  std::filesystem::path path; ///< as opened
  std::string text;           ///< the whole text to be read
  std::size_t position = 0;
};

/// The next literal of a data file: a signed float, `<...>` of two to five, or a string; empty at
/// the end. Commas and blanks separate. @error E0506 anything else
Result<Value> read_literal(FileValue&);
/// Are only blanks and commas left?
bool at_end_of_literals(FileValue&);

/// How `#write` puts numbers: as text (`%g`; vectors `<1,2,3> `), or rounded and clamped into
/// bytes.
enum class BinaryForm : std::uint8_t {
  None,
  Uint8,
  Sint8,
  Uint16le,
  Uint16be,
  Sint16le,
  Sint16be,
  Sint32le,
  Sint32be
};
std::optional<BinaryForm> binary_form(std::string_view word);
std::string write_text(Numeric const&);
std::string write_binary(double, BinaryForm);

/// The files that a run touches.
///
/// Looked for: in the folder of the file that names them, the scene's folder, the working
/// directory, the -I folders, the standard library, POV-Ray's includes, in this order. Whatever a
/// scene names is read only below these folders and those of --allow-read, links resolved: nothing
/// else of the machine can get into a picture or a message.
///
/// Written files stay in memory until the end of the run, where later `#include`s and `#fopen`s
/// find them. Then they go to the disk if `allow_write` is set. Else a file that was only written
/// to be read again (as strings.inc does) vanishes, and any other is an error.
class Files {
public:
  explicit Files(Interpreter& interpreter) : in_(interpreter) {}

  /// A found file: where, its name for messages, and its text.
  struct Found {
    std::filesystem::path path;
    FileText text;
  };
  /// @error E0501 not found or not readable, E0502 outside the folders that may be read
  Result<Found> load(std::string_view name, SourceFile const* from);
  bool exists(std::string_view name, SourceFile const* from);

  /// The sources to read for an #include, in this order; none after an error, which is reported. Of
  /// a name that the standard library and POV-Ray's includes both have these are POV-Ray's and the
  /// library's: a scene finds the declarations of both, and where they differ the library's. A
  /// source is read and registered once as long as it does not change.
  std::vector<SourceFile const*> include(std::string_view name, Span);
  /// `; colors.inc declares it: #include "colors.inc"` when a file of the standard library or of
  /// POV-Ray's includes that was not included declares the name, else "".
  std::string include_hint(std::string_view name) const;

  Result<std::shared_ptr<FileValue>> open_read(std::string_view name, SourceFile const* from);
  Result<std::shared_ptr<FileValue>> open_write(std::string_view name, bool append, Span);
  void write(FileValue&, std::string_view text);
  /// At the end of the run: writes or reports what was written.
  void finish();

  void set_scene_folder(std::filesystem::path folder) { scene_folder_ = std::move(folder); }
  /// Remembers where a source came from, so that what it names is looked for beside it.
  void set_origin(SourceFile const& source, std::filesystem::path const& path) {
    origins_[&source] = path.parent_path();
  }

private:
  struct Written {
    std::string text;
    Span opened_at;
    bool read_back = false;
  };
  std::vector<std::filesystem::path> folders(SourceFile const* from) const;
  bool installed(std::filesystem::path const& folder, std::filesystem::path const& path) const;
  std::optional<Error> forbidden(std::string_view name, std::filesystem::path const& place) const;
  SourceFile const* source_of(Found&&);
  Written* find_written(std::string_view name);

  Interpreter& in_;
  std::filesystem::path scene_folder_ = ".";
  std::map<SourceFile const*, std::filesystem::path> origins_;
  std::map<std::filesystem::path, SourceFile const*> included_;
  std::map<std::filesystem::path, Written> written_;
  mutable std::optional<std::vector<std::filesystem::path>> roots_; ///< that may be read, resolved
};

} // namespace abbe::lang
