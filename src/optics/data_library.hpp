// SPDX-License-Identifier: MIT
#pragma once

#include "base/result.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace abbe::optics {

/// One entry of a data library: a line of scene language such as `glass_entry "SCHOTT/N-BK7" { ..
/// }`.
struct DataEntry {
  std::string name; ///< full name, "SCHOTT/N-BK7", "sapphire/o", "D65"
  std::string kind; ///< its first word: glass_entry, illuminant_entry, lamp_entry, metal_entry, ..
  std::string text; ///< the whole line
  std::filesystem::path file;
  std::uint64_t offset = 0; ///< of the text in the file
};

/// A folder of *.inc files with one entry a line, and index.txt: `name TAB file TAB offset TAB
/// length`, sorted by name in byte order, written by the folder's generate.py. Opening reads the
/// index only (some 0.1 ms for 2000 names); finding an entry reads its slice only. An alias
/// ("sodium") is a second index row for the same slice. Used for stdlib/glass and stdlib/spectra.
/// Const use is thread-safe.
class DataLibrary {
public:
  /// @error E0501 the index cannot be read; E0417 it is damaged
  static Result<DataLibrary> open(std::filesystem::path const& folder);

  /// By full name, or by the part before or after the '/' where that is unique: "N-BK7", "Au".
  /// @error E0413 unknown (with the nearest names) or ambiguous (listing the full names);
  ///        E0501 the file cannot be read; E0417 the index does not fit the file
  Result<DataEntry> find(std::string_view name) const;

  /// The name that differs from this one in case and signs only, or in the "N-" of newer glasses:
  /// "N-BK7" for "n-bk7", "NBK7" and "BK7"; "" when there is none.
  std::string_view meant(std::string_view name) const;

  /// All full names (aliases too), sorted.
  std::vector<std::string_view> names() const;
  /// The full names of one maker: what stands before the '/'. Exact, sorted.
  std::vector<std::string_view> list(std::string_view maker) const;
  /// What stands before a '/', each once, sorted.
  std::vector<std::string_view> makers() const;

private:
  struct Row {
    std::uint32_t name, name_length, file, file_length;
    std::uint64_t offset, length;
  };
  std::string_view name(Row const& row) const { return view(row.name, row.name_length); }
  std::string_view view(std::uint32_t at, std::uint32_t length) const {
    return std::string_view(index_).substr(at, length);
  }
  Result<DataEntry> read(Row const& row) const;
  Error unknown(std::string_view name) const;

  std::filesystem::path folder_;
  std::string index_;
  std::vector<Row> rows_;
};

} // namespace abbe::optics
