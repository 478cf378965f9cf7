// SPDX-License-Identifier: MIT
#include "lang/folders.hpp"

#include <cstdlib>
#include <dlfcn.h>
#include <glob.h>
#include <link.h>

namespace abbe::lang {
namespace {

namespace fs = std::filesystem;

/// The file that this code was loaded from.
fs::path own_file() {
  Dl_info info{};
  link_map* loaded = nullptr;
  auto const here = reinterpret_cast<void*>(&own_file);
  bool const known = dladdr1(here, &info, reinterpret_cast<void**>(&loaded), RTLD_DL_LINKMAP) != 0;
  bool const library = known && loaded != nullptr && *loaded->l_name != '\0';
  std::error_code failed;
  return fs::canonical(library ? loaded->l_name : "/proc/self/exe", failed);
}

} // namespace

fs::path stdlib_dir() {
  if (char const* named = std::getenv("ABBE_STDLIB")) return named;
  std::error_code failed;
  for (fs::path folder = own_file(); folder.has_relative_path();) {
    folder = folder.parent_path();
    // Canonical: a build has links to the sources.
    if (auto found = fs::canonical(folder / "share/abbe/stdlib", failed); !failed) return found;
  }
  return {};
}

fs::path povray_dir() {
  if (char const* named = std::getenv("ABBE_POVRAY_INCLUDE")) return named;
  // glob sorts: the last one is the newest.
  for (char const* pattern :
       {"/usr/local/share/povray*/include/colors.inc", "/usr/share/povray*/include/colors.inc"}) {
    glob_t found{};
    fs::path folder;
    if (glob(pattern, 0, nullptr, &found) == 0)
      folder = fs::path(found.gl_pathv[found.gl_pathc - 1]).parent_path();
    globfree(&found);
    if (!folder.empty()) return folder;
  }
  return {};
}

} // namespace abbe::lang
