// SPDX-License-Identifier: MIT
#include "cli/scene_arguments.hpp"

#include "cli/hints.hpp"
#include "cli/limits.hpp"
#include "cli/say.hpp"
#include "grammar/keywords.hpp"
#include "image/atomic_file.hpp"
#include "job/interrupt.hpp"
#include "lang/folders.hpp"
#include "plan/quality.hpp"

#include <algorithm>
#include <charconv>
#include <csignal>
#include <fmt/format.h>
#include <unistd.h>

namespace abbe::cli {
namespace {

/// Files are looked at where they lie; one of them was cut short.
extern "C" void on_lost_text(int) {
  constexpr std::string_view message = "abbe: a file was cut short while it was read: try again\n";
  [[maybe_unused]] auto const written = write(2, message.data(), message.size());
  image::remove_unfinished();
  _exit(3);
}

std::string check_declaration(std::string const& text) {
  auto const equals = text.find('=');
  if (equals == std::string::npos || equals == 0) return "expected NAME=VALUE, got '" + text + "'";
  std::string const name = text.substr(0, equals);
  auto const letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || (c >= '0' && c <= '9');
  };
  if (!std::all_of(name.begin(), name.end(), letter) || (name[0] >= '0' && name[0] <= '9'))
    return "'" + name + "' is not a name that a scene could use";
  if (grammar::word_kind(name) != grammar::WordKind::Name)
    return "'" + name + "' is a reserved word";
  return "";
}

std::string dispersion_phrase(std::string const& words) {
  return "dispersion { " + words + " }";
}

/// What is wrong with a phrase of the `spectral` block, or nothing.
std::string check_spectral(std::string const& phrase) {
  auto const read = lang::read_spectral(phrase);
  return read ? "" : read.error().message;
}

/// @pre the phrase was checked
scene::SpectralSettings spectral_settings(std::string const& phrase) {
  return *lang::read_spectral(phrase);
}

} // namespace

void catch_signals() {
  job::catch_interrupts();
  std::signal(SIGBUS, on_lost_text);
}

void SceneArguments::add_to(CommandLine& app, bool with_plan) {
  app.keep_letters_free(); // -H is the height
  app.add_option("SCENE", scene, "the scene file (.scn, .pov); -: standard input").required();
  app.add_option("-W,--width", width, "pixels across").range(1, 100000).show_default();
  app.add_option("-H,--height", height, "pixels down").range(1, 100000).show_default();
  app.add_option("-D,--declare", declarations, "declare a float or string before the scene")
      .type_name("NAME=VALUE")
      .check(check_declaration)
      .one_at_a_time();
  app.add_option("-I,--include", include_dirs, "search here for includes too")
      .type_name("DIR")
      .one_at_a_time();
  app.add_option("--allow-read", read_dirs, "let the scene read files below this folder too")
      .type_name("DIR")
      .one_at_a_time();
  app.add_flag("--allow-write", allow_write, "let the scene write files (#fopen ... write)");
  app.add_flag(
      "--strict", strict,
      "as 'effects strict' in the scene: what is not rendered yet is an error, and so is an "
      "effect that is put off");
  app.add_flag("--quiet", quiet, "no progress and no #debug output");
  app.add_option("--max-time", max_time,
                 "end after this time as by Ctrl-C, with status 124: seconds, or as 30s, 5m")
      .type_name("TIME")
      .check([](std::string const& text) {
        double seconds = 0;
        auto wrong = parse_duration(text, seconds);
        if (wrong.empty()) job::limit_time(seconds);
        return wrong;
      });
  app.add_option("--max-memory", max_memory,
                 "refuse to take more memory (E0706): bytes, or as 512M, 2G")
      .type_name("SIZE")
      .check(limit_memory);
  app.add_option("--clock", clock, "what `clock` is in the scene").type_name("NUMBER");
  if (!with_plan) return;
  app.add_option("--bands", bands, "number of spectral bands").range(1, 1000);
  app.add_option(
         "--dispersion", dispersion,
         "for every material, as in a scene: \"none\", \"deterministic\", \"adaptive tolerance "
         "0.5\", \"stochastic rays 4\", \"clusters 4 degrade\", \"hero 4\" ...")
      .type_name("MODE")
      .check([](std::string const& text) { return check_spectral(dispersion_phrase(text)); });
  app.add_option("--representation", representation,
                 "of light: \"bands\", \"composite\", \"basis 6\", \"adaptive tolerance 0.5\"")
      .type_name("WORDS")
      .check([](std::string const& text) { return check_spectral("representation " + text); });
  app.add_option("--spacing", spacing, "of bands: uniform or hall").one_of({"uniform", "hall"});
  app.add_option("--caustics", caustics, "off: without the light that glass and mirrors throw")
      .one_of({"off"});
  app.add_flag("--spectral", spectral, "render in bands; EXR output carries them");
}

std::string parse_duration(std::string const& text, double& seconds) {
  auto const [end, failed] = std::from_chars(text.data(), text.data() + text.size(), seconds);
  std::string_view const unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
  double const factor = unit.empty() || unit == "s" ? 1 : unit == "m" ? 60 : unit == "h" ? 3600 : 0;
  seconds *= factor;
  if (failed != std::errc() || factor == 0 || !(seconds > 0) || seconds > 1e9)
    return "expected a time such as 90s, 10m or 1h, got '" + text + "'";
  return "";
}

namespace {

/// Scenes that are in use, so that they are not reported as lost. Never destroyed.
auto* const in_use = new std::vector<lang::Evaluated*>;

lang::Evaluated* kept(lang::Evaluated&& evaluated) {
  return in_use->emplace_back(new lang::Evaluated(std::move(evaluated)));
}

/// All that comes through standard input.
std::string standard_input() {
  std::string text;
  char piece[1 << 16];
  while (std::size_t const count = std::fread(piece, 1, sizeof piece, stdin))
    text.append(piece, count);
  return text;
}

} // namespace

void give_up(lang::Evaluated* evaluated) {
  std::erase(*in_use, evaluated);
  delete evaluated;
}

lang::Evaluated* load_scene(SceneArguments const& arguments, int& status) {
  lang::EvaluateOptions options;
  options.stdlib_dir = lang::stdlib_dir();
  if (options.stdlib_dir.empty()) {
    say("abbe: error[E0501]: abbe's own include files are not there: no folder above "
        "the program has share/abbe/stdlib, and ABBE_STDLIB is not set\n");
    status = 3;
    return nullptr;
  }
  options.povray_dir = lang::povray_dir();
  for (auto const& dir : arguments.read_dirs) options.read_dirs.emplace_back(dir);
  for (auto const& dir : arguments.include_dirs) options.include_dirs.emplace_back(dir);
  for (auto const& text : arguments.declarations) {
    auto const equals = text.find('=');
    options.declarations.emplace_back(text.substr(0, equals), text.substr(equals + 1));
  }
  options.before = arguments.before;
  options.image_width = arguments.width;
  options.image_height = arguments.height;
  options.frame = arguments.frame;
  if (arguments.clock) {
    options.frame.clock = *arguments.clock;
    options.frame.clock_on = true;
  }
  options.allow_write = arguments.allow_write;
  options.strict = arguments.strict;
  options.stop = &job::interrupted();
  if (!arguments.quiet) options.on_message = [](std::string_view text) { say_text(text); };
  std::size_t printed = 0;
  int errors = 0;
  options.on_diagnostic = [&](Diagnostic const& diagnostic) {
    say("{}\n", format(diagnostic));
    if (diagnostic.severity == Severity::Error) ++errors;
    ++printed;
  };
  lang::Evaluated evaluated = arguments.scene == "-"
                                  ? lang::evaluate_text("standard input", standard_input(), options)
                                  : lang::evaluate_file(arguments.scene, options);
  // Those about files are made in the end.
  while (printed < evaluated.diagnostics.size())
    options.on_diagnostic(evaluated.diagnostics[printed]);
  if (evaluated.unreadable)
    if (auto const hint = hint_of_scene(arguments.scene); !hint.empty()) say("abbe: {}\n", hint);
  if (evaluated.ok())
    if (auto const warning = nothing_to_see(evaluated.scene); !warning.empty())
      say("{}: warning[E0256]: {}\n", arguments.scene, warning);
  if (evaluated.interrupted) {
    status = job::interrupted_status();
    return nullptr;
  }
  if (errors > 0) {
    say("abbe: {} error{}\n", errors, errors == 1 ? "" : "s");
    status = evaluated.unreadable ? 3 : 1;
    return nullptr;
  }
  status = 0;
  plan::lower_quality(evaluated.scene, arguments.quality);
  return kept(std::move(evaluated));
}

plan::Overrides overrides_of(SceneArguments const& arguments) {
  plan::Overrides overrides;
  overrides.bands = arguments.bands;
  overrides.spectral = arguments.spectral;
  if (arguments.caustics == "off")
    overrides.effects.push_back({scene::Switch::Caustics, false, {}});
  if (!arguments.dispersion.empty())
    overrides.dispersion = spectral_settings(dispersion_phrase(arguments.dispersion)).dispersion;
  if (!arguments.representation.empty())
    overrides.representation =
        spectral_settings("representation " + arguments.representation).representation;
  if (!arguments.spacing.empty())
    overrides.spacing = spectral_settings("spacing " + arguments.spacing).spacing;
  return overrides;
}

std::optional<plan::Plan> plan_scene(lang::Evaluated const& evaluated,
                                     SceneArguments const& arguments, int& status) {
  auto plan = plan::make_plan(evaluated.scene, overrides_of(arguments));
  if (!plan) {
    Diagnostic diagnostic;
    diagnostic.code = plan.error().code;
    auto const& effects = evaluated.scene.settings.effects;
    diagnostic.span = diagnostic.code == "E0431" ? effects.strict_span
                      : diagnostic.code == "E0430" && !effects.overrides.empty()
                          ? effects.overrides.front().span
                          : evaluated.scene.settings.spectral.span;
    diagnostic.message = plan.error().message;
    say("{}\n", format(diagnostic));
    status = 1;
    return std::nullopt;
  }
  status = 0;
  return std::move(*plan);
}
} // namespace abbe::cli
