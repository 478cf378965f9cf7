// SPDX-License-Identifier: MIT
// Goldens of evaluation. What is compared depends on the expected file's name:
//   .stderr.expected  all diagnostics    .out.expected  #debug text    .graph.expected  dump_scene
#include "golden.hpp"

#include "lang/evaluate.hpp"

int main(int argc, char** argv) {
  namespace fs = std::filesystem;
  if (argc < 3) return abbe::golden::run(argc, argv, {});
  // Messages name files as the scene does: from its folder.
  std::string input = fs::absolute(argv[argc - 2]).string();
  std::string expected = fs::absolute(argv[argc - 1]).string();
  argv[argc - 2] = input.data();
  argv[argc - 1] = expected.data();
  fs::current_path(fs::path(input).parent_path());
  return abbe::golden::run(argc, argv, [&](std::string const& name, std::string text) {
    std::string said;
    abbe::lang::EvaluateOptions options;
    options.stdlib_dir = fs::relative(ABBE_STDLIB_DIR);
    options.on_message = [&](std::string_view message) { said += message; };
    auto const evaluated = abbe::lang::evaluate_text(name, std::move(text), options);
    std::string messages;
    for (auto const& diagnostic : evaluated.diagnostics) messages += format(diagnostic) + "\n";
    if (expected.ends_with(".stderr.expected")) return messages;
    if (!evaluated.ok()) return messages;
    return expected.ends_with(".graph.expected") ? abbe::lang::dump_scene(evaluated.scene) : said;
  });
}
