// SPDX-License-Identifier: MIT
#include "cli/command_line.hpp"
#include "cli/commands.hpp"
#include "cli/say.hpp"
#include "image/io.hpp"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <strings.h>

namespace abbe::cli {
namespace {

struct Arguments {
  std::string input, output;
  std::string exposure = "0";
  std::string gamut = "standard";
  image::DisplayOptions png{};
};

int fail(Error const& error) {
  say("abbe tonemap: error[{}]: {}\n", error.code, error.message);
  return 3;
}

/// "auto" or a finite number of stops; CLI11 wants "" or the complaint.
std::string set_exposure(std::string const& text, image::ToneOptions& tone) {
  tone.auto_exposure = text == "auto";
  if (tone.auto_exposure) return "";
  char const* end = text.data() + text.size();
  char const* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  auto const [stop, failed] = std::from_chars(begin, end, tone.exposure_ev);
  if (failed != std::errc() || stop != end || !std::isfinite(tone.exposure_ev))
    return "expected a number of stops or 'auto', got '" + text + "'";
  return "";
}

int map_file(Arguments const& arguments) {
  Result<image::Image> const input = image::read(arguments.input);
  if (!input) return fail(input.error());
  image::ToneReport report;
  image::Image const display = image::tone_map(*input, arguments.png.tone, &report);
  // The mapped image is in gamut, where a second mapping without exposure is the identity.
  image::DisplayOptions options = arguments.png;
  options.tone = {};
  image::Status const written = image::write_png(display, arguments.output, options);
  if (!written) return fail(written.error());
  double const pixels = static_cast<double>(display.pixels());
  fmt::print(
      "{}: {} x {} pixels, exposure {:+.3f} EV; out of gamut {:.3f} %, above range {:.3f} %\n",
      arguments.output, display.width, display.height, report.exposure_ev,
      100 * static_cast<double>(report.negative) / pixels,
      100 * static_cast<double>(report.over_range) / pixels);
  if (report.not_a_number)
    say("abbe tonemap: warning: {} pixels are NaN, shown black\n", report.not_a_number);
  return 0;
}

} // namespace

int run_tonemap(int argc, char** argv) {
  Arguments arguments;
  image::ToneOptions& tone = arguments.png.tone;
  CommandLine app("Maps a linear image (.exr, LogLuv .tif) to an sRGB .png.", "abbe tonemap");
  app.add_option("IN", arguments.input, "the linear image").required();
  app.add_option("OUT", arguments.output, "the PNG to write")
      .required()
      .check([](std::string const& name) {
        return strcasecmp(std::filesystem::path(name).extension().c_str(), ".png") == 0
                   ? std::string()
                   : "'" + name + "' does not end in .png";
      });
  app.add_option("--exposure", arguments.exposure,
                 "stops, or auto: geometric mean of the luminances to 0.18")
      .type_name("EV|auto")
      .check([&tone](std::string const& text) { return set_exposure(text, tone); })
      .show_default();
  app.add_option("--gamut", arguments.gamut,
                 "clip: each channel on its own; standard: negative channels are mixed "
                 "with grey, which keeps hue and luminance, large ones clipped; hue: large ones "
                 "too keep their hue")
      .one_of({"clip", "standard", "hue"})
      .show_default();
  app.add_option("--bits", arguments.png.bits, "bits per channel")
      .one_of({"8", "16"})
      .show_default();
  if (int const status = app.parse(argc, argv); status >= 0) return status;
  if (arguments.gamut == "clip") tone.gamut = image::Gamut::Clip;
  if (arguments.gamut == "hue") tone.gamut = image::Gamut::Hue;
  return map_file(arguments);
}

} // namespace abbe::cli
