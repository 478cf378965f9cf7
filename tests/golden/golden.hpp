// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>

/// The main() of golden programs: `[--update-goldens] INPUT EXPECTED`.
namespace abbe::golden {

inline std::string read(std::filesystem::path const& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Compares what `make` yields for (input's file name, its text) with the expected file, or
/// rewrites it.
inline int run(int argc, char** argv,
               std::function<std::string(std::string const& name, std::string text)> const& make) {
  bool update = std::getenv("ABBE_UPDATE_GOLDENS") != nullptr;
  if (argc > 1 && std::strcmp(argv[1], "--update-goldens") == 0) {
    update = true;
    --argc;
    ++argv;
  }
  if (argc != 3) {
    std::fprintf(stderr, "usage: [--update-goldens] INPUT EXPECTED\n");
    return 2;
  }
  std::filesystem::path const input = argv[1];
  std::string const actual = make(input.filename().string(), read(input));
  if (update) {
    std::ofstream(argv[2], std::ios::binary) << actual;
    return 0;
  }
  if (std::filesystem::exists(argv[2]) && read(argv[2]) == actual) return 0;
  std::fprintf(stderr, "%s differs; actual:\n%s", argv[2], actual.c_str());
  return 1;
}

} // namespace abbe::golden
