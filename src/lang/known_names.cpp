// SPDX-License-Identifier: MIT
#include "lang/known_names.hpp"

#include "base/file_text.hpp"

#include <set>

namespace abbe::lang {
namespace {

namespace fs = std::filesystem;

bool in_a_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// Does a line end in `#declare` or `#macro`, outside of a comment?
bool ends_in_declaration(std::string_view line) {
  std::size_t const end = line.find_last_not_of(" \t");
  if (end == line.npos || end + 1 == line.size() || line.find("//") != line.npos) return false;
  line = line.substr(0, end + 1);
  std::size_t const hash = line.rfind('#');
  if (hash == line.npos) return false;
  std::size_t const word = line.find_first_not_of(" \t", hash + 1);
  return word != line.npos && (line.substr(word) == "declare" || line.substr(word) == "macro");
}

bool declares(std::string_view text, std::string_view name) {
  for (std::size_t at = text.find(name); at != text.npos; at = text.find(name, at + 1)) {
    if (at + name.size() < text.size() && in_a_name(text[at + name.size()])) continue;
    std::size_t const newline = at == 0 ? text.npos : text.rfind('\n', at - 1);
    std::size_t const begin = newline == text.npos ? 0 : newline + 1;
    if (ends_in_declaration(text.substr(begin, at - begin))) return true;
  }
  return false;
}

} // namespace

std::vector<std::string> declaring_files(std::string_view name,
                                         std::vector<fs::path> const& folders) {
  std::set<std::string> files;
  if (name.empty()) return {};
  for (fs::path const& folder : folders) {
    std::error_code failed;
    for (auto const& entry : fs::directory_iterator(folder, failed)) {
      if (entry.path().extension() != ".inc") continue;
      auto const text = FileText::read(entry.path());
      if (text && declares(text->view(), name)) files.insert(entry.path().filename().string());
    }
  }
  return {files.begin(), files.end()};
}

} // namespace abbe::lang
