// SPDX-License-Identifier: MIT
#include "lang/blocks.hpp"
#include "optics/agf.hpp"

#include <filesystem>

namespace abbe::lang {

/// `glass_catalog "file.agf"`: the file's name without its extension is the maker.
void read_glass_catalog(Reader& in) {
  Span const at = in.next_span();
  std::string const path = in.path("name of an AGF file");
  if (path.empty()) return;
  auto text = load_file(in.interpreter(), path);
  if (!text) {
    in.report(Severity::Error, text.error().code, text.error().message, at);
    return;
  }
  auto read = optics::read_agf(*text, std::filesystem::path(path).stem().string());
  if (!read) {
    in.report(Severity::Error, read.error().code, path + ": " + read.error().message, at);
    return;
  }
  if (read->empty()) {
    in.report(Severity::Error, "E0414", path + ": no glass in it; is it an AGF file?", at);
    return;
  }
  auto& glasses = scene_state(in.interpreter()).file_glasses;
  glasses.insert(glasses.end(), read->begin(), read->end());
}

} // namespace abbe::lang
