// SPDX-License-Identifier: MIT
#include "base/read_file.hpp"
#include "cli/commands.hpp"
#include "cli/say.hpp"
#include "cli/scene_arguments.hpp"
#include "grammar/parse.hpp"

#include <fmt/format.h>

/// check and dump: what abbe makes of a scene, without a picture.
namespace abbe::cli {
namespace {

int dump_syntax(std::string const& path, bool tokens) {
  auto file = read_file(path);
  if (!file) {
    say("abbe dump: error[E0501]: cannot read the file '{}': {}\n", path, file.error().message);
    return 3;
  }
  SourceSet sources;
  SourceFile const& source = sources.add(path, std::move(file->text));
  if (tokens) {
    fmt::print("{}", dump_tokens(source));
    return 0;
  }
  Parsed const parsed = parse(source);
  fmt::print("{}", dump_ast(parsed.document));
  for (auto const& error : parsed.errors) say("{}\n", format(error));
  return parsed.errors.empty() ? 0 : 1;
}

} // namespace

int run_check(int argc, char** argv) {
  SceneArguments arguments;
  CommandLine app("Parses and evaluates a scene: reports every error that can be found.",
                  "abbe check");
  arguments.add_to(app, false);
  if (int const status = app.parse(argc, argv); status >= 0) return status;
  int status = 0;
  lang::Evaluated const* const evaluated = load_scene(arguments, status);
  if (evaluated && plan_scene(*evaluated, arguments, status) && !arguments.quiet)
    fmt::print("{}: no errors\n", arguments.scene);
  return status;
}

int run_dump(int argc, char** argv) {
  SceneArguments arguments;
  CommandLine app("Prints a stage of the work on a scene.", "abbe dump");
  bool tokens = false, tree = false, graph = false, plan = false;
  auto& group = app.add_choice("stage");
  group.add_flag("--tokens", tokens, "the tokens, one a line");
  group.add_flag("--ast", tree, "the syntax tree");
  group.add_flag("--scene", graph, "the object graph, evaluated");
  group.add_flag("--plan", plan, "the effects it calls for");
  arguments.add_to(app, true);
  if (int const status = app.parse(argc, argv); status >= 0) return status;
  if (tokens || tree) return dump_syntax(arguments.scene, tokens);
  int status = 0;
  lang::Evaluated const* const evaluated = load_scene(arguments, status);
  if (!evaluated) return status;
  if (graph) {
    fmt::print("{}", lang::dump_scene(evaluated->scene));
    return 0;
  }
  auto const made = plan_scene(*evaluated, arguments, status);
  if (made) fmt::print("{}", plan::describe(*made));
  return status;
}

} // namespace abbe::cli
