// SPDX-License-Identifier: MIT
#include "lang/libraries.hpp"

#include "optics/spectra_data.hpp"

namespace abbe::lang {

namespace {

optics::DataLibrary const* opened(Reader& in, std::optional<optics::DataLibrary>& library,
                                  std::string_view folder, Span at) {
  if (library) return &*library;
  auto result = optics::DataLibrary::open(stdlib_dir(in.interpreter()) / folder);
  if (!result) {
    in.report(Severity::Error, result.error().code, result.error().message, at);
    return nullptr;
  }
  library = std::move(*result);
  return &*library;
}

} // namespace

optics::DataLibrary const* glass_library(Reader& in, Span at) {
  return opened(in, scene_state(in.interpreter()).glass_library, "glass", at);
}

optics::DataLibrary const* spectra_library(Reader& in, Span at) {
  return opened(in, scene_state(in.interpreter()).spectra_library, "spectra", at);
}

std::shared_ptr<optics::Conductor const> read_metal(Reader& in) {
  Span const at = in.next_span();
  std::string const name = in.string("name of a metal");
  if (name.empty()) return nullptr;
  auto const* library = spectra_library(in, at);
  if (!library) return nullptr;
  auto metal = optics::load_metal(*library, name);
  if (metal) return std::make_shared<optics::Conductor const>(std::move(*metal));
  in.report(Severity::Error, metal.error().code, metal.error().message, at);
  return nullptr;
}

} // namespace abbe::lang
