// SPDX-License-Identifier: MIT
#include "lang/files.hpp"

#include "base/new_file.hpp"
#include "base/read_file.hpp"
#include "lang/interpreter.hpp"
#include "lang/known_names.hpp"

#include <algorithm>
#include <cerrno>
#include <fmt/format.h>
#include <system_error>
#include <tuple>
#include <unistd.h>

namespace abbe::lang {
namespace {

namespace fs = std::filesystem;

/// Writes beside the file and renames: whole or not at all, and a link is replaced, not followed.
/// @return why it could not be written
std::error_code write_whole(fs::path const& path, std::string const& text) {
  std::error_code failed;
  if (fs::is_directory(path, failed)) return std::make_error_code(std::errc::is_a_directory);
  NewFile const unfinished = make_file_beside(path);
  if (unfinished.descriptor < 0) return {errno, std::generic_category()};
  take_over_rights(unfinished.descriptor, path);
  int reason = 0;
  for (std::string_view left = text; !left.empty() && reason == 0;) {
    ssize_t const put = ::write(unfinished.descriptor, left.data(), left.size());
    if (put > 0) left.remove_prefix(static_cast<std::size_t>(put));
    if (put < 0 && errno != EINTR) reason = errno;
  }
  int const held = ::dup(unfinished.descriptor); // its lock, until it has its name
  if (::close(unfinished.descriptor) != 0 && reason == 0) reason = errno;
  if (reason == 0) fs::rename(unfinished.path, path, failed);
  if (held >= 0) ::close(held);
  if (reason == 0 && !failed) return {};
  if (reason != 0) failed.assign(reason, std::generic_category());
  std::error_code ignored;
  fs::remove(unfinished.path, ignored);
  return failed;
}

fs::path resolved(fs::path const& path) {
  std::error_code failed;
  fs::path const whole = fs::weakly_canonical(fs::absolute(path.empty() ? "." : path), failed);
  return failed ? fs::path() : whole;
}

/// Is `path` in `folder` or below? Both are resolved.
bool below(fs::path const& path, fs::path const& folder) {
  if (folder.empty() || path.empty()) return false;
  auto const parts = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return parts.first == folder.end()
         || (parts.first->empty() && std::next(parts.first) == folder.end());
}

std::string shown(fs::path const& folder) {
  return folder.empty() ? "." : folder.generic_string();
}

} // namespace

std::vector<fs::path> Files::folders(SourceFile const* from) const {
  std::vector<fs::path> all;
  auto const add = [&](fs::path const& folder) {
    if (std::none_of(all.begin(), all.end(),
                     [&](fs::path const& known) { return shown(known) == shown(folder); }))
      all.push_back(folder);
  };
  if (auto const origin = origins_.find(from); origin != origins_.end()) add(origin->second);
  add(scene_folder_);
  add("");
  auto const& options = in_.options();
  for (fs::path const& folder : options.include_dirs) add(folder);
  if (!options.stdlib_dir.empty()) add(options.stdlib_dir);
  if (!options.povray_dir.empty()) add(options.povray_dir);
  return all;
}

/// Is it a file of POV-Ray's includes by its name? Where a link among these leads was decided by
/// who installed them (fonts are elsewhere as a rule).
bool Files::installed(fs::path const& folder, fs::path const& path) const {
  fs::path const& povray = in_.options().povray_dir;
  return !povray.empty() && folder == povray
         && below(fs::absolute(path).lexically_normal(), fs::absolute(povray).lexically_normal());
}

std::optional<Error> Files::forbidden(std::string_view name, fs::path const& place) const {
  if (!roots_) {
    roots_.emplace();
    for (fs::path const& folder : folders(nullptr)) roots_->push_back(resolved(folder));
    for (fs::path const& folder : in_.options().read_dirs) roots_->push_back(resolved(folder));
  }
  if (std::any_of(roots_->begin(), roots_->end(),
                  [&](fs::path const& root) { return below(place, root); }))
    return std::nullopt;
  return Error{"E0502",
               fmt::format("'{}' lies outside the folders that a scene may read: its own, the "
                           "working directory, those of -I and the libraries; allow it with "
                           "--allow-read {}",
                           name, place.parent_path().generic_string())};
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
  if (name.empty()) return Error{"E0501", "the name of the file is empty"};
  std::string searched;
  for (fs::path const& folder : folders(from)) {
    fs::path const path = folder / fs::path(name);
    auto file = read_file(path);
    if (file) {
      if (auto error = forbidden(name, file->place); error && !installed(folder, path))
        return *error;
      return Found{path, std::move(file->text)};
    }
    std::error_code failed;
    if (fs::path(name).is_absolute() || fs::exists(path, failed) || failed) {
      // Nobody is to learn what lies outside.
      if (auto error = forbidden(name, resolved(path))) return *error;
      return Error{"E0501", fmt::format("cannot read the file '{}': {}", path.generic_string(),
                                        file.error().message)};
    }
    searched += fmt::format("{}'{}'", searched.empty() ? "" : ", ", shown(folder));
  }
  return Error{"E0501", fmt::format("cannot find the file '{}' in {}", name, searched)};
}

bool Files::exists(std::string_view name, SourceFile const* from) {
  if (find_written(name)) return true;
  std::error_code failed;
  for (fs::path const& folder : folders(from)) {
    fs::path const path = folder / fs::path(name);
    if (fs::is_regular_file(path, failed)) return !forbidden(name, resolved(path));
  }
  return false;
}

SourceFile const* Files::source_of(Found&& found) {
  SourceFile const*& known = included_[found.path];
  if (!known || known->bytes().view() != found.text.view()) {
    known = &in_.add_source(found.path.generic_string(), std::move(found.text));
    origins_[known] = found.path.parent_path();
  }
  return known;
}

std::vector<SourceFile const*> Files::include(std::string_view name, Span span) {
  auto found = load(name, span.source);
  std::string const extended = std::string(name) + ".inc";
  if (!found && found.error().message.starts_with("cannot find"))
    if (auto other = load(extended, span.source)) {
      found = std::move(other);
      name = extended;
    }
  if (!found) {
    in_.error(found.error().code, found.error().message, span);
    return {};
  }
  std::vector<SourceFile const*> sources;
  auto const& [stdlib, povray] = std::tie(in_.options().stdlib_dir, in_.options().povray_dir);
  if (!stdlib.empty() && !povray.empty() && found->path == stdlib / fs::path(name)) {
    fs::path const path = povray / fs::path(name);
    if (auto text = FileText::read(path)) sources.push_back(source_of({path, std::move(*text)}));
  }
  sources.push_back(source_of(std::move(*found)));
  return sources;
}

std::string Files::include_hint(std::string_view name) const {
  std::vector<std::string> files;
  for (auto const& file :
       declaring_files(name, {in_.options().stdlib_dir, in_.options().povray_dir}))
    if (std::none_of(included_.begin(), included_.end(),
                     [&](auto const& known) { return known.first.filename() == file; }))
      files.push_back(file);
  if (files.empty()) return {};
  if (files.size() == 1)
    return fmt::format("; {} declares it: #include \"{}\"", files[0], files[0]);
  return fmt::format("; {} declare it: #include one of them", fmt::join(files, ", "));
}

Result<std::shared_ptr<FileValue>> Files::open_read(std::string_view name, SourceFile const* from) {
  auto found = load(name, from);
  if (!found) return found.error();
  auto file = std::make_shared<FileValue>();
  file->path = found->path;
  file->text = std::move(found->text).take();
  return file;
}

Result<std::shared_ptr<FileValue>> Files::open_write(std::string_view name, bool append,
                                                     Span span) {
  fs::path const path = (scene_folder_ / fs::path(name)).lexically_normal();
  if (name.empty()) return Error{"E0504", "the name of the file is empty"};
  if (fs::path(name).is_absolute() || !below(resolved(path), resolved(scene_folder_)))
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
      if (std::error_code const why = write_whole(path, written.text))
        in_.error(
            "E0504",
            fmt::format("cannot write the file '{}': {}", path.generic_string(), why.message()),
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
