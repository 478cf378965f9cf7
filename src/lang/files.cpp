// SPDX-License-Identifier: MIT
#include "lang/files.hpp"

#include "lang/interpreter.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>

namespace abbe::lang {
namespace {

namespace fs = std::filesystem;

/// Writes beside the file and renames: whole or not at all, and a link is replaced, not followed.
bool write_whole(fs::path const& path, std::string const& text) {
  std::error_code failed;
  if (fs::is_directory(path, failed)) return false;
  fs::path const unfinished = path.parent_path() / ("." + path.filename().string() + ".tmp");
  fs::remove(unfinished, failed);
  std::ofstream out(unfinished, std::ios::binary);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (out) fs::rename(unfinished, path, failed);
  if (out && !failed) return true;
  std::error_code ignored;
  fs::remove(unfinished, ignored);
  return false;
}

/// Is `path` in `folder` or below, once all links and dots are resolved?
bool below(fs::path const& path, fs::path const& folder) {
  std::error_code failed;
  fs::path const whole = fs::weakly_canonical(fs::absolute(path), failed);
  fs::path const root = fs::weakly_canonical(fs::absolute(folder), failed);
  if (failed) return false;
  auto const parts = std::mismatch(root.begin(), root.end(), whole.begin(), whole.end());
  return parts.first == root.end()
         || (parts.first->empty() && std::next(parts.first) == root.end());
}

} // namespace

std::vector<fs::path> Files::folders(SourceFile const* from) const {
  std::vector<fs::path> all;
  auto const origin = origins_.find(from);
  if (origin != origins_.end()) all.push_back(origin->second);
  if (all.empty() || all.front() != scene_folder_) all.push_back(scene_folder_);
  auto const& options = in_.options();
  all.insert(all.end(), options.include_dirs.begin(), options.include_dirs.end());
  if (!options.stdlib_dir.empty()) all.push_back(options.stdlib_dir);
  return all;
}

bool Files::allowed(fs::path const& path, SourceFile const* from) const {
  auto const roots = folders(from);
  return std::any_of(roots.begin(), roots.end(),
                     [&](fs::path const& root) { return below(path, root.empty() ? "." : root); });
}

Files::Written* Files::find_written(std::string_view name) {
  auto const found = written_.find((scene_folder_ / fs::path(name)).lexically_normal());
  return found == written_.end() ? nullptr : &found->second;
}

Result<Files::Found> Files::load(std::string_view name, SourceFile const* from) {
  if (Written* const written = find_written(name)) {
    written->read_back = true;
    return Found{fs::path(name), written->text};
  }
  std::string searched;
  for (fs::path const& folder : folders(from)) {
    fs::path const path = folder / fs::path(name);
    if (auto text = FileText::read(path)) return Found{path, std::move(*text)};
    if (fs::path(name).is_absolute()) break;
    searched += fmt::format("{}'{}'", searched.empty() ? "" : ", ",
                            folder.empty() ? "." : folder.generic_string());
  }
  if (searched.empty()) return Error{"E0501", fmt::format("cannot read the file '{}'", name)};
  return Error{"E0501", fmt::format("cannot find the file '{}' in {}", name, searched)};
}

bool Files::exists(std::string_view name, SourceFile const* from) {
  if (find_written(name)) return true;
  std::error_code failed;
  for (fs::path const& folder : folders(from))
    if (fs::is_regular_file(folder / fs::path(name), failed)) return true;
  return false;
}

SourceFile const* Files::include(std::string_view name, Span span) {
  auto found = load(name, span.source);
  if (!found) {
    in_.error(found.error().code, found.error().message, span);
    return nullptr;
  }
  SourceFile const*& known = included_[found->path];
  if (!known || known->text() != found->text.view()) {
    known = &in_.add_source(found->path.generic_string(), std::move(found->text));
    origins_[known] = found->path.parent_path();
  }
  return known;
}

Result<std::shared_ptr<FileValue>> Files::open_read(std::string_view name, SourceFile const* from) {
  auto found = load(name, from);
  if (!found) return found.error();
  if (!find_written(name) && !allowed(found->path, from))
    return Error{
        "E0502",
        fmt::format("'{}' lies outside the folders that a scene may read: its own, those of "
                    "-I and the standard library",
                    name)};
  auto file = std::make_shared<FileValue>();
  file->path = found->path;
  file->text = std::move(found->text).take();
  return file;
}

Result<std::shared_ptr<FileValue>> Files::open_write(std::string_view name, bool append,
                                                     Span span) {
  fs::path const path = (scene_folder_ / fs::path(name)).lexically_normal();
  if (fs::path(name).is_absolute() || !below(path, scene_folder_.empty() ? "." : scene_folder_))
    return Error{"E0503", fmt::format("'{}' lies outside the scene's folder: not written", name)};
  Written& written = written_[path];
  if (!written.opened_at.valid()) {
    written.opened_at = span;
    if (append)
      if (auto text = FileText::read(path)) written.text = std::move(*text).take();
  }
  if (!append) written.text.clear();
  written.read_back = false;
  auto file = std::make_shared<FileValue>();
  file->writing = true;
  file->path = path;
  return file;
}

void Files::write(FileValue& file, std::string_view text) {
  written_[file.path].text += text;
}

void Files::finish() {
  for (auto const& [path, written] : written_) {
    if (in_.options().allow_write) {
      if (in_.error_count() > 0) return;
      if (!write_whole(path, written.text))
        in_.error("E0504", fmt::format("cannot write the file '{}'", path.generic_string()),
                  written.opened_at);
    } else if (!written.read_back) {
      in_.error("E0503",
                fmt::format("the scene writes the file '{}': allow it with --allow-write",
                            path.generic_string()),
                written.opened_at);
    }
  }
}

} // namespace abbe::lang
