// SPDX-License-Identifier: MIT
// Driver of the goldens of evaluation: eval_golden [--update-goldens] <scene.scn> <expected>
// What is compared depends on the expected file's name:
//   .stderr.expected  all diagnostics    .out.expected  #debug text    .graph.expected  dump_scene
#include "lang/evaluate.hpp"

#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>

namespace {

namespace fs = std::filesystem;

std::string read(fs::path const& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::string result_of(std::string const& scene, std::string const& expected, bool& wrong) {
  std::string said;
  abbe::lang::EvaluateOptions options;
  options.stdlib_dir = ABBE_STDLIB_DIR;
  options.on_message = [&](std::string_view text) { said += text; };
  auto const evaluated = abbe::lang::evaluate_file(scene, options);
  std::string messages;
  for (auto const& diagnostic : evaluated.diagnostics) messages += format(diagnostic) + "\n";
  if (expected.ends_with(".stderr.expected")) return messages;
  wrong = !evaluated.ok();
  if (wrong) return messages;
  return expected.ends_with(".graph.expected") ? dump_scene(evaluated.scene) : said;
}

} // namespace

int main(int argc, char** argv) {
  bool const update = argc == 4 && std::string(argv[1]) == "--update-goldens";
  if (argc != 3 && !update) {
    std::cerr << "usage: eval_golden [--update-goldens] scene.scn expected\n";
    return 2;
  }
  fs::path const scene = fs::absolute(argv[argc - 2]);
  fs::path const expected = fs::absolute(argv[argc - 1]);
  fs::current_path(scene.parent_path()); // messages name the scene without its folder
  bool wrong = false;
  std::string const got = result_of(scene.filename().string(), expected.string(), wrong);
  if (wrong) {
    std::cerr << got;
    return 1;
  }
  if (update) {
    std::ofstream(expected, std::ios::binary) << got;
    return 0;
  }
  if (got == read(expected)) return 0;
  std::cerr << "--- expected\n" << read(expected) << "--- got\n" << got;
  return 1;
}
