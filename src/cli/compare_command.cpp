// SPDX-License-Identifier: MIT
#include "cli/command_line.hpp"
#include "cli/commands.hpp"
#include "cli/say.hpp"
#include "image/io.hpp"
#include "image/metrics.hpp"

#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace abbe::cli {
namespace {

struct Arguments {
  std::string reference, test, difference;
  double threshold = 0;
  double gain = 1;
  bool json = false;
};

/// The error's status: a file that cannot be read or written is 3, images that do not go
/// together 1.
int fail(Error const& error) {
  say("abbe compare: error[{}]: {}\n", error.code, error.message);
  return error.code == "E0517" ? 1 : 3;
}

/// JSON has no infinity and no NaN: null.
nlohmann::ordered_json number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

std::string to_json(Arguments const& arguments, image::Image const& reference,
                    image::Metrics const& m) {
  nlohmann::ordered_json const out{
      {"reference", arguments.reference},
      {"test", arguments.test},
      {"width", reference.width},
      {"height", reference.height},
      {"linear",
       {{"rmse", number(m.rmse_linear)},
        {"psnr_db", number(m.psnr_linear_db)},
        {"relative_mse", number(m.relative_mse)},
        {"relative_mse_xyz", number(m.relative_mse_xyz)},
        {"max", number(m.max_linear)}}},
      {"srgb",
       {{"rmse", number(m.rmse_srgb)},
        {"psnr_db", number(m.psnr_srgb_db)},
        {"max_codes", m.max_codes},
        {"threshold_codes", arguments.threshold},
        {"differing_share", m.differing_share}}},
      {"ciede2000",
       {{"mean", m.delta_e_mean},
        {"p95", m.delta_e_p95},
        {"p99", m.delta_e_p99},
        {"max", m.delta_e_max},
        {"share_above_1", m.delta_e_share_above_1},
        {"share_above_2_3", m.delta_e_share_above_2_3}}},
      {"flip", {{"mean", m.flip_mean}, {"max", m.flip_max}}},
      {"nan_values", m.not_a_number},
  };
  return out.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string decibel(double value) {
  return std::isinf(value) ? "infinite" : fmt::format("{:.2f} dB", value);
}

std::string to_text(Arguments const& arguments, image::Image const& reference,
                    image::Metrics const& m) {
  std::string out = fmt::format("{} x {} pixels: {} (reference) and {}\n", reference.width,
                                reference.height, arguments.reference, arguments.test);
  auto const line = [&](std::string_view name, std::string_view text) {
    out += fmt::format("  {:<22}{}\n", name, text);
  };
  line("RMSE, linear", fmt::format("{:.6g}   largest {:.6g}", m.rmse_linear, m.max_linear));
  line("PSNR, linear", decibel(m.psnr_linear_db));
  line("relative MSE", fmt::format("{:.6g}   in XYZ {:.6g}", m.relative_mse, m.relative_mse_xyz));
  line("RMSE, sRGB", fmt::format("{:.6g}   largest {:g} of 255", m.rmse_srgb, m.max_codes));
  line("PSNR, 8-bit sRGB", decibel(m.psnr_srgb_db));
  line("CIEDE2000", fmt::format("mean {:.4f}   95 % {:.4f}   99 % {:.4f}   largest {:.4f}",
                                m.delta_e_mean, m.delta_e_p95, m.delta_e_p99, m.delta_e_max));
  line("  pixels above 1",
       fmt::format("{:.3f} %   above 2.3: {:.3f} %", 100 * m.delta_e_share_above_1,
                   100 * m.delta_e_share_above_2_3));
  line("FLIP", fmt::format("mean {:.6f}   largest {:.4f}", m.flip_mean, m.flip_max));
  line(fmt::format("differ by > {:g}/255", arguments.threshold),
       fmt::format("{:.3f} % of the pixels", 100 * m.differing_share));
  if (m.not_a_number) line("NaN values", fmt::format("{}, counted as 0", m.not_a_number));
  return out;
}

int compare_files(Arguments const& arguments) {
  if (!arguments.difference.empty()) { // before the work
    image::Status const writable = image::check_destination(arguments.difference);
    if (!writable) {
      int const status = fail(writable.error());
      return writable.error().code == "E0512" ? 2 : status; // an extension that nothing writes
    }
  }
  Result<image::Image> const reference = image::read(arguments.reference);
  if (!reference) return fail(reference.error());
  Result<image::Image> const test = image::read(arguments.test);
  if (!test) return fail(test.error());
  Result<image::Metrics> const metrics =
      image::compare(*reference, *test, {.threshold_codes = arguments.threshold});
  if (!metrics) return fail(metrics.error());
  if (!arguments.difference.empty()) {
    Result<image::Image> const difference =
        image::difference_image(*reference, *test, arguments.gain);
    if (!difference) return fail(difference.error());
    if (image::Status const written = image::write(*difference, arguments.difference); !written)
      return fail(written.error());
  }
  if (arguments.json)
    fmt::print("{}\n", to_json(arguments, *reference, *metrics));
  else
    fmt::print("{}", to_text(arguments, *reference, *metrics));
  return 0;
}

} // namespace

int run_compare(int argc, char** argv) {
  Arguments arguments;
  CommandLine app(
      "How far image B is from image A (the reference). Reads .exr, .png and LogLuv .tif.\n"
      "CIEDE2000, FLIP and 8-bit values are those of the images as a display shows them.",
      "abbe compare");
  app.add_option("A", arguments.reference, "the reference").required();
  app.add_option("B", arguments.test, "the image under test").required();
  app.add_flag("--json", arguments.json, "print JSON (null: infinite or undefined)");
  app.add_option("--threshold", arguments.threshold,
                 "count pixels with a channel that differs by more than T/255")
      .type_name("T")
      .range(0.0, 255.0)
      .show_default();
  auto const difference =
      app.add_option("--diff", arguments.difference, "write |A - B| of the sRGB values")
          .type_name("OUT.png");
  app.add_option("--gain", arguments.gain, "multiply the difference image")
      .type_name("G")
      .positive()
      .needs(difference)
      .show_default();
  if (int const status = app.parse(argc, argv); status >= 0) return status;
  return compare_files(arguments);
}

} // namespace abbe::cli
