// SPDX-License-Identifier: MIT
#include "base/diagnostic.hpp"
#include "base/heap.hpp"
#include "cli/commands.hpp"
#include "cli/hints.hpp"
#include "cli/limits.hpp"
#include "cli/say.hpp"
#include "cli/scene_arguments.hpp"
#include "image/atomic_file.hpp"

#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fmt/format.h>
#include <new>
#include <string>
#include <string_view>
#include <unistd.h>

namespace {

/// Memory that runs out where nothing can catch it (before main(), in what must not throw) ends the
/// program with the error that main() gives, and no core file.
[[noreturn]] void end_uncaught() {
  try {
    if (std::exception_ptr const thrown = std::current_exception()) std::rethrow_exception(thrown);
  } catch (std::bad_alloc const&) {
    constexpr std::string_view text = "abbe: error[E0706]: out of memory\n";
    [[maybe_unused]] ssize_t const put = ::write(STDERR_FILENO, text.data(), text.size());
    abbe::image::remove_unfinished();
    ::_exit(1);
  } catch (...) { // a bug
  }
  std::abort();
}
/// Before all other objects.
struct SetEnd {
  SetEnd() { std::set_terminate(end_uncaught); }
};
[[gnu::init_priority(101)]] SetEnd const set_end;

struct Command {
  std::string_view name;
  int (*run)(int, char**);
  std::string_view summary;
};

constexpr std::array commands{
    Command{"render", abbe::cli::run_render, "render a scene to .exr, .png or .tif"},
    Command{"povray", abbe::cli::run_povray, "render as POV-Ray's command line says"},
    Command{"study", abbe::cli::run_study, "measure what accuracy costs in time"},
    Command{"check", abbe::cli::run_check, "parse and evaluate a scene; report all errors"},
    Command{"dump", abbe::cli::run_dump, "print the tokens, tree, object graph or plan of a scene"},
    Command{"explain", abbe::cli::run_explain, "which effects a scene calls for, and where"},
    Command{"glass", abbe::cli::run_glass, "list or show catalogue glasses"},
    Command{"compare", abbe::cli::run_compare, "measure how two images differ"},
    Command{"tonemap", abbe::cli::run_tonemap, "map a linear image to a PNG"},
};

std::string usage() {
  std::string out = fmt::format(
      "abbe {}: ray tracing of scenes in a POV-Ray-style language, exact about glass\n\n"
      "usage: abbe COMMAND ...    (abbe COMMAND --help tells more)\n\n",
      ABBE_VERSION);
  for (auto const& command : commands)
    out += fmt::format("  {:9} {}\n", command.name, command.summary);
  return out
         + fmt::format("  {:9} {}\n", "test",
                       "build everything and run the tests (by the script ./abbe only)");
}

/// Was the program called by the name of POV-Ray's?
bool is_called_povray(std::string_view program) {
  auto const slash = program.rfind('/');
  return program.substr(slash == program.npos ? 0 : slash + 1) == "povray";
}

int run(int argc, char** argv) {
  if (argc > 0 && is_called_povray(argv[0])) return abbe::cli::run_povray(argc, argv);
  if (argc < 2) {
    abbe::cli::say_text(usage());
    return 2;
  }
  std::string_view const name = argv[1];
  if (name == "--help" || name == "-h" || name == "help") {
    fmt::print("{}", usage());
    return 0;
  }
  if (name == "--version") {
    fmt::print("abbe {}\n", ABBE_VERSION);
    return 0;
  }
  std::array<std::string_view, commands.size()> names;
  for (std::size_t i = 0; i < commands.size(); ++i) {
    names[i] = commands[i].name;
    if (names[i] == name) return commands[i].run(argc - 1, argv + 1);
  }
  std::string const hint = abbe::cli::hint_of_command(name);
  abbe::cli::say("abbe: unknown command '{}'{}\n\n", name,
                 hint.empty() ? abbe::did_you_mean(name, names) : hint);
  abbe::cli::say_text(usage());
  return 2;
}

/// Results that did not reach standard output, say because the disk is full.
int output_failed() {
  abbe::cli::say("abbe: error[E0510]: cannot write to standard output\n");
  return 3;
}

} // namespace

int main(int argc, char** argv) {
  abbe::use_one_heap();
  abbe::cli::occupy_standard_files();
  abbe::cli::limit_memory_to_machine();
  abbe::cli::catch_signals();
  // A file that would grow beyond `ulimit -f` is an error of the write, not the end of the program.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    int const status = run(argc, argv);
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return status;
    return output_failed();
  } catch (std::bad_alloc const&) {
    abbe::cli::say("abbe: error[E0706]: out of memory\n");
    return 1;
  } catch (std::exception const& failure) {
    if (std::ferror(stdout) != 0) return output_failed(); // fmt::print throws
    abbe::cli::say("abbe: internal error: {}\n", failure.what());
    return 1;
  }
}
