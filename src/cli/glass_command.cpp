// SPDX-License-Identifier: MIT
#include "cli/commands.hpp"
#include "cli/glass_of_name.hpp"
#include "cli/say.hpp"
#include "cli/scene_arguments.hpp"
#include "lang/evaluate.hpp"
#include "lang/folders.hpp"
#include "optics/bands.hpp"
#include "optics/data_library.hpp"
#include "optics/glass.hpp"

#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace abbe::cli {
namespace {

using nlohmann::json;

struct Arguments {
  std::string maker;
  std::string name;
  std::vector<double> at_nm;
  bool as_json = false;
};

int fail(Error const& error, int status) {
  say("abbe glass: error[{}]: {}\n", error.code, error.message);
  return status;
}

int list(Arguments const& arguments) {
  auto const library = optics::DataLibrary::open(lang::stdlib_dir() / "glass");
  if (!library) return fail(library.error(), 3);
  if (arguments.maker.empty()) {
    for (auto const name : library->names()) fmt::print("{}\n", name);
    return 0;
  }
  auto const names = library->list(arguments.maker);
  if (names.empty()) {
    auto const makers = library->makers();
    return fail(
        {"E0413", fmt::format("no maker '{}'{}; there are: {}", arguments.maker,
                              did_you_mean(arguments.maker, makers), fmt::join(makers, ", "))},
        1);
  }
  for (auto const name : names) fmt::print("{}\n", name);
  return 0;
}

json to_json(optics::Glass const& glass, std::vector<double> const& at_nm) {
  auto const optional = [](std::optional<double> const& value) {
    return value ? json(*value) : json(nullptr);
  };
  json out;
  out["name"] = glass.full_name();
  out["status"] = glass.status();
  out["nd"] = optional(glass.nd());
  out["Vd"] = optional(glass.vd());
  auto const range = glass.range_nm();
  for (auto const& [key, lambda_nm] :
       {std::pair("nF", optics::f_line_nm), std::pair("nC", optics::c_line_nm)})
    out[key] = range.contains(lambda_nm) ? json(glass.index_unchecked(lambda_nm)) : json(nullptr);
  out["range_nm"] = {std::isfinite(range.lo_nm) ? json(range.lo_nm) : json(nullptr),
                     std::isfinite(range.hi_nm) ? json(range.hi_nm) : json(nullptr)};
  out["absorbs"] = glass.absorbs();
  for (double const lambda_nm : at_nm) {
    json row;
    row["lambda_nm"] = lambda_nm;
    row["n"] = range.contains(lambda_nm) ? json(glass.index_unchecked(lambda_nm)) : json(nullptr);
    row["transmittance_10mm"] = std::exp(-10 * glass.absorption_per_mm(lambda_nm));
    out["at"].push_back(row);
  }
  return out;
}

void print_text(optics::Glass const& glass, json const& data) {
  auto const number = [](json const& value, int digits) {
    return value.is_null() ? std::string("-") : fmt::format("{:.{}f}", value.get<double>(), digits);
  };
  fmt::print("{}{}\n", glass.full_name(),
             glass.status().empty() ? "" : " (" + glass.status() + ")");
  fmt::print("  nd {}   Vd {}   nF {}   nC {}\n", number(data["nd"], 6), number(data["Vd"], 3),
             number(data["nF"], 6), number(data["nC"], 6));
  fmt::print("  range {} .. {} nm{}\n", number(data["range_nm"][0], 0),
             number(data["range_nm"][1], 0), glass.absorbs() ? "" : "; no absorption data");
  fmt::print("  {:>8} {:>10} {:>22}\n", "nm", "n", "transmittance, 10 mm");
  for (auto const& row : data["at"])
    fmt::print("  {:8.2f} {:>10} {:>22}\n", row["lambda_nm"].get<double>(), number(row["n"], 6),
               number(row["transmittance_10mm"], 4));
}

int show(Arguments& arguments) {
  auto const glass = glass_of_name(arguments.name);
  if (!glass) return fail(glass.error(), 1);
  if (arguments.at_nm.empty())
    arguments.at_nm = {404.6561,          435.8343, optics::f_line_nm, 546.074,
                       optics::d_line_nm, 632.8,    optics::c_line_nm, 706.5188};
  auto const data = to_json(**glass, arguments.at_nm);
  if (arguments.as_json)
    fmt::print("{}\n", data.dump(2));
  else
    print_text(**glass, data);
  return 0;
}

} // namespace

int run_glass(int argc, char** argv) {
  Arguments arguments;
  CommandLine app("The glass catalogue.", "abbe glass");
  auto& lister = app.add_subcommand("list", "names, one a line");
  lister.add_option("--maker", arguments.maker, "of this maker only");
  auto& shower = app.add_subcommand("show", "index, Abbe number, transmittance");
  shower.add_option("NAME", arguments.name, "\"N-BK7\" or \"SCHOTT/N-BK7\"").required();
  shower.add_option("--at", arguments.at_nm, "wavelengths")
      .type_name("NM,...")
      .separated_by(',')
      .range(1.0, 1e6);
  shower.add_flag("--json", arguments.as_json, "print JSON");
  if (int const status = app.parse(argc, argv); status >= 0) return status;
  return lister.is_chosen() ? list(arguments) : show(arguments);
}

} // namespace abbe::cli
