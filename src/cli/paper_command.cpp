// SPDX-License-Identifier: MIT
#include "cli/paper_command.hpp"

#include "cli/glass_of_name.hpp"
#include "cli/say.hpp"
#include "cli/scene_arguments.hpp"
#include "job/interrupt.hpp"
#include "lang/folders.hpp"
#include "study/paper.hpp"

#include <fmt/format.h>

namespace abbe::cli {
namespace {

int fail(Error const& error) {
  say("abbe study: error[{}]: {}\n", error.code, error.message);
  return error.code == "E0510" ? 3 : 1;
}

} // namespace

int run_paper(int argc, char** argv) {
  CommandLine app("Makes the figures and the timing table of the paper, and a page of them.",
                  "abbe study --paper");
  std::string folder = "docs";
  bool paper = false, quiet = false;
  study::PaperOptions options;
  app.add_flag("--paper", paper, "this");
  app.add_option("-o,--output", folder, "where paper.md and the folder paper go").show_default();
  app.add_option("--rounds", options.rounds, "runs of each row of the timing table")
      .range(1, 99)
      .show_default();
  app.add_flag("--quiet", quiet, "no progress");
  if (int const status = app.parse(argc, argv); status >= 0) return status;
  options.program = "/proc/self/exe";
  options.version = ABBE_VERSION;
  options.examples = lang::stdlib_dir().parent_path() / "examples";
  options.folder = folder;
  options.stop = &job::interrupted();
  for (char const* name : {"diamond", "SCHOTT/SF6", "SCHOTT/N-BK7", "SCHOTT/N-FK51A", "SCHOTT/F2",
                           "SCHOTT/N-SF11", "SCHOTT/N-LASF9", "fused_silica"}) {
    auto glass = glass_of_name(name);
    if (!glass) return fail(glass.error());
    if (std::string_view(name) == "SCHOTT/N-SF11") options.prism = *glass;
    options.glasses.push_back(std::move(*glass));
  }
  if (!quiet) options.on_progress = [](std::string const& now) { say("abbe study: {}\n", now); };
  auto const written = study::write_paper(options);
  if (!written) return job::interrupted() ? job::interrupted_status() : fail(written.error());
  if (!quiet) say("abbe: {}\n", (options.folder / "paper.md").string());
  return 0;
}

} // namespace abbe::cli
