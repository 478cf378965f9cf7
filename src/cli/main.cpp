// SPDX-License-Identifier: MIT
#include "base/diagnostic.hpp"
#include "base/heap.hpp"
#include "cli/commands.hpp"
#include "cli/hints.hpp"

#include <array>
#include <csignal>
#include <cstdio>
#include <exception>
#include <fmt/format.h>
#include <new>
#include <string_view>
#include <sys/resource.h>
#include <sys/sysinfo.h>

#if defined(__SANITIZE_ADDRESS__) // gcc
#define ABBE_WITH_ADDRESS_SANITIZER 1
#elif defined(__has_feature) // clang
#define ABBE_WITH_ADDRESS_SANITIZER __has_feature(address_sanitizer)
#else
#define ABBE_WITH_ADDRESS_SANITIZER 0
#endif

namespace {

struct Command {
  std::string_view name;
  int (*run)(int, char**);
  std::string_view summary;
};

constexpr std::array commands{
    Command{"render", abbe::cli::run_render, "render a scene to .exr, .png or .tif"},
    Command{"study", abbe::cli::run_study, "measure what accuracy costs in time"},
    Command{"check", abbe::cli::run_check, "parse and evaluate a scene; report all errors"},
    Command{"dump", abbe::cli::run_dump, "print the tokens, tree, object graph or plan of a scene"},
    Command{"explain", abbe::cli::run_explain, "which effects a scene calls for, and where"},
    Command{"glass", abbe::cli::run_glass, "list or show catalogue glasses"},
    Command{"compare", abbe::cli::run_compare, "measure how two images differ"},
    Command{"tonemap", abbe::cli::run_tonemap, "map a linear image to a PNG"},
};

void print_usage(std::FILE* out) {
  fmt::print(out,
             "abbe {}: ray tracing of scenes in a POV-Ray-style language, exact about glass\n\n"
             "usage: abbe COMMAND ...    (abbe COMMAND --help tells more)\n\n",
             ABBE_VERSION);
  for (auto const& command : commands)
    fmt::print(out, "  {:9} {}\n", command.name, command.summary);
  fmt::print(out, "  {:9} {}\n", "test",
             "build everything and run the tests (by the script ./abbe only)");
}

int run(int argc, char** argv) {
  if (argc < 2) {
    print_usage(stderr);
    return 2;
  }
  std::string_view const name = argv[1];
  if (name == "--help" || name == "-h" || name == "help") {
    print_usage(stdout);
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
  fmt::print(stderr, "abbe: unknown command '{}'{}\n\n", name,
             hint.empty() ? abbe::did_you_mean(name, names) : hint);
  print_usage(stderr);
  return 2;
}

/// Results that did not reach standard output, say because the disk is full.
int output_failed() {
  std::fputs("abbe: error[E0510]: cannot write to standard output\n", stderr);
  return 3;
}

/// What does not fit in memory would page without end, or be killed without a word: a failed
/// allocation can be reported with its place. An eighth is left for the rest of the machine.
void limit_memory() {
#if !ABBE_WITH_ADDRESS_SANITIZER // which reserves far more than it uses
  struct sysinfo machine {};
  if (sysinfo(&machine) != 0) return;
  rlim_t const bytes = rlim_t{machine.totalram} / 8 * 7 * machine.mem_unit;
  rlimit limit{};
  if (getrlimit(RLIMIT_DATA, &limit) != 0 || limit.rlim_cur <= bytes) return;
  limit.rlim_cur = bytes;
  setrlimit(RLIMIT_DATA, &limit);
#endif
}

} // namespace

int main(int argc, char** argv) {
  abbe::use_one_heap();
  limit_memory();
  // A file that would grow beyond `ulimit -f` is an error of the write, not the end of the program.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    int const status = run(argc, argv);
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return status;
    return output_failed();
  } catch (std::bad_alloc const&) {
    fmt::print(stderr, "abbe: error[E0706]: out of memory\n");
    return 1;
  } catch (std::exception const& failure) {
    if (std::ferror(stdout) != 0) return output_failed(); // fmt::print throws
    fmt::print(stderr, "abbe: internal error: {}\n", failure.what());
    return 1;
  }
}
