// SPDX-License-Identifier: MIT
#include "optics/data_library.hpp"

#include "base/diagnostic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>

namespace abbe::optics {
namespace {

constexpr std::size_t most_names_listed = 12;
constexpr std::uint64_t longest_entry = 1u << 24;
constexpr std::uint64_t longest_index = 1u << 28;

std::string_view maker_of(std::string_view full) {
  auto const slash = full.find('/');
  return slash == std::string_view::npos ? std::string_view{} : full.substr(0, slash);
}
std::string_view after_maker(std::string_view full) {
  auto const slash = full.find('/');
  return slash == std::string_view::npos ? full : full.substr(slash + 1);
}

std::string join(std::vector<std::string_view> const& names) {
  std::string text;
  std::size_t const shown = std::min(names.size(), most_names_listed);
  for (std::size_t i = 0; i < shown; ++i) text += fmt::format("{}'{}'", i ? ", " : "", names[i]);
  if (shown < names.size()) text += fmt::format(" and {} more", names.size() - shown);
  return text;
}

/// The letters and digits of a name, in lower case.
std::string squeezed(std::string_view name) {
  std::string result;
  for (char const c : name) {
    if (c >= 'A' && c <= 'Z')
      result += static_cast<char>(c - 'A' + 'a');
    else if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'))
      result += c;
  }
  return result;
}

} // namespace

Result<DataLibrary> DataLibrary::open(std::filesystem::path const& folder) {
  DataLibrary library;
  library.folder_ = folder;
  auto const path = folder / "index.txt";
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return Error{"E0501", fmt::format("cannot read '{}'", path.string())};
  std::error_code no_size;
  auto const size = std::filesystem::file_size(path, no_size);
  if (no_size || size > longest_index)
    return Error{"E0501", fmt::format("cannot read '{}'", path.string())};
  library.index_.resize(size);
  stream.read(library.index_.data(), static_cast<std::streamsize>(size));
  std::string const& text = library.index_;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t const end = std::min(text.find('\n', at), text.size());
    std::string_view const line(text.data() + at, end - at);
    auto const damaged = [&] {
      return Error{"E0417",
                   fmt::format("'{}' is damaged at '{}'", path.string(), line.substr(0, 60))};
    };
    std::size_t const tab1 = line.find('\t');
    std::size_t const tab2 = tab1 == line.npos ? line.npos : line.find('\t', tab1 + 1);
    if (tab2 == line.npos) return damaged();
    Row row{};
    row.name = static_cast<std::uint32_t>(at);
    row.name_length = static_cast<std::uint32_t>(tab1);
    row.file = static_cast<std::uint32_t>(at + tab1 + 1);
    row.file_length = static_cast<std::uint32_t>(tab2 - tab1 - 1);
    char const* const last = text.data() + end;
    auto const offset = std::from_chars(line.data() + tab2 + 1, last, row.offset);
    if (offset.ec != std::errc() || offset.ptr == last || *offset.ptr != '\t') return damaged();
    auto const length = std::from_chars(offset.ptr + 1, last, row.length);
    if (length.ec != std::errc() || length.ptr != last || row.length > longest_entry)
      return damaged();
    if (!library.rows_.empty() && !(library.name(library.rows_.back()) < library.name(row)))
      return damaged();
    library.rows_.push_back(row);
    at = end + 1;
  }
  return library;
}

Result<DataEntry> DataLibrary::find(std::string_view wanted) const {
  auto const exact =
      std::lower_bound(rows_.begin(), rows_.end(), wanted,
                       [&](Row const& row, std::string_view n) { return name(row) < n; });
  if (exact != rows_.end() && name(*exact) == wanted) return read(*exact);
  std::vector<std::string_view> matches;
  Row const* match = nullptr;
  for (Row const& row : rows_)
    if (after_maker(name(row)) == wanted || maker_of(name(row)) == wanted) {
      matches.push_back(name(row));
      match = &row;
    }
  if (matches.size() == 1) return read(*match);
  if (matches.empty()) return unknown(wanted);
  return Error{"E0413", fmt::format("'{}' is ambiguous: say one of {}", wanted, join(matches))};
}

std::string_view DataLibrary::meant(std::string_view wanted) const {
  std::string const plain = squeezed(wanted);
  if (plain.empty()) return {};
  for (auto const& form : {plain, "n" + plain})
    for (Row const& row : rows_)
      for (auto const candidate : {after_maker(name(row)), name(row)})
        if (squeezed(candidate) == form) return candidate;
  return {};
}

Error DataLibrary::unknown(std::string_view wanted) const {
  std::string_view const same = meant(wanted);
  // Short names and full names are both offered; the nearest short name is what a slip most likely
  // meant.
  std::vector<std::string_view> candidates;
  for (Row const& row : rows_) {
    candidates.push_back(name(row));
    if (after_maker(name(row)) != name(row)) candidates.push_back(after_maker(name(row)));
  }
  return Error{"E0413", fmt::format("there is no '{}' among the {} entries of '{}'{}", wanted,
                                    rows_.size(), folder_.filename().string(),
                                    same.empty() ? did_you_mean(wanted, candidates)
                                                 : fmt::format("; did you mean '{}'?", same))};
}

Result<DataEntry> DataLibrary::read(Row const& row) const {
  DataEntry entry;
  entry.name = name(row);
  entry.file = folder_ / view(row.file, row.file_length);
  entry.offset = row.offset;
  std::ifstream stream(entry.file, std::ios::binary);
  if (!stream) return Error{"E0501", fmt::format("cannot read '{}'", entry.file.string())};
  entry.text.resize(row.length);
  stream.seekg(static_cast<std::streamoff>(row.offset));
  stream.read(entry.text.data(), static_cast<std::streamsize>(row.length));
  entry.kind = entry.text.substr(0, entry.text.find(' '));
  // An index that is older than its file would silently give another glass.
  if (!stream || entry.kind.size() < 7 || !entry.kind.ends_with("_entry")
      || entry.text.back() != '}')
    return Error{"E0417",
                 fmt::format("the index of '{}' does not fit '{}' at '{}': run generate.py",
                             folder_.string(), entry.file.filename().string(), entry.name)};
  return entry;
}

std::vector<std::string_view> DataLibrary::names() const {
  std::vector<std::string_view> result;
  for (Row const& row : rows_) result.push_back(name(row));
  return result;
}

std::vector<std::string_view> DataLibrary::list(std::string_view maker) const {
  std::vector<std::string_view> result;
  for (Row const& row : rows_)
    if (maker_of(name(row)) == maker) result.push_back(name(row));
  return result;
}

std::vector<std::string_view> DataLibrary::makers() const {
  std::vector<std::string_view> result;
  for (Row const& row : rows_)
    if (auto const maker = maker_of(name(row)); !maker.empty()) result.push_back(maker);
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

} // namespace abbe::optics
