// SPDX-License-Identifier: MIT
#include "study/report.hpp"

#include "image/atomic_file.hpp"
#include "image/io.hpp"
#include "study/heat.hpp"
#include "study/runner.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

namespace abbe::study {
namespace fs = std::filesystem;
using nlohmann::ordered_json;
namespace {

ordered_json optional(std::optional<double> const& value) {
  return value && std::isfinite(*value) ? ordered_json(*value) : ordered_json(nullptr);
}

ordered_json setting_json(StudyResult const& result, SettingResult const& s) {
  ordered_json out{{"name", s.setting.name},   {"family", s.setting.family->name},
                   {"value", s.setting.value}, {"aa", s.setting.aa},
                   {"words", s.setting.words}, {"skipped", s.skipped}};
  if (!s.measured()) return out;
  auto const& first = s.runs.front();
  out["cpu_s"] = s.cpu_s;
  out["wall_s"] = s.wall_s;
  out["ratio_to_none"] = optional(ratio_to_none(result, s));
  out["peak_mib"] = s.peak_mib;
  out["rays"] = to_json(first)["rays"];
  out["relative_mse"] = optional(s.errors.relative_mse);
  out["relative_mse_rgb"] = optional(s.errors.relative_mse_rgb);
  out["delta_e_mean"] = s.errors.delta_e_mean;
  out["delta_e_p99"] = s.errors.delta_e_p99;
  out["flip"] = s.errors.flip;
  out["banding"] = s.errors.banding;
  out["noise"] = s.spread ? ordered_json(s.spread->noise) : ordered_json(nullptr);
  out["bias"] = s.spread ? ordered_json(s.spread->bias) : ordered_json(nullptr);
  out["on_front"] = s.on_front;
  out["runs"] = ordered_json::array();
  for (auto const& run : s.runs) out["runs"].push_back(to_json(run));
  return out;
}

ordered_json study_json(StudyResult const& result, StudyOptions const& options,
                        ReportHead const& head) {
  ordered_json out{
      {"version", head.version},
      {"command", head.command},
      {"scene", options.scene},
      {"identity", options.identity},
      {"width", options.width},
      {"height", options.height},
      {"budget_s", options.budget_s},
      {"elapsed_s", result.elapsed_s},
      {"machine", to_json(result.machine)},
      {"reference", {{"text", result.reference}, {"run", to_json(result.reference_run)}}}};
  out["families"] = ordered_json::array();
  for (auto const& family : families())
    out["families"].push_back({{"name", family.name},
                               {"label", family.label},
                               {"parameter", family.parameter},
                               {"stochastic", family.stochastic}});
  out["settings"] = ordered_json::array();
  for (auto const& setting : result.settings)
    out["settings"].push_back(setting_json(result, setting));
  out["depth"] = ordered_json::array();
  for (auto const& point : result.depth)
    out["depth"].push_back(
        {{"family", point.family}, {"depth", point.depth}, {"delta_e", point.delta_e}});
  out["equal_error"] = ordered_json::array();
  for (auto const& row : result.equal_error)
    out["equal_error"].push_back({{"delta_e", row.delta_e}, {"cpu_s", row.cpu_s}});
  out["notes"] = result.notes;
  return out;
}

/// One line a run: every figure.
std::string study_csv(StudyResult const& result, StudyOptions const& options,
                      ReportHead const& head) {
  std::string out =
      "version,identity,scene,width,height,processor,threads,setting,family,value,aa,seed,cpu_s,"
      "wall_s,scene_s,peak_mib,camera,reflected,refracted,monochromatic,shadow,rays,relative_mse,"
      "relative_mse_rgb,delta_e_mean,delta_e_p99,flip,banding,noise,bias,on_front\n";
  auto const quoted = [](std::string const& text) {
    std::string inside;
    for (char const c : text) inside += c == '"' ? std::string("\"\"") : std::string(1, c);
    return '"' + inside + '"';
  };
  for (auto const& s : result.settings)
    for (auto const& run : s.runs) {
      out += fmt::format("{},{},{},{},{},{},{},", head.version, options.identity,
                         quoted(options.scene), options.width, options.height,
                         quoted(result.machine.processor), result.machine.threads);
      out += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},", quoted(s.setting.name),
                         s.setting.family->name, s.setting.value, s.setting.aa, run.seed, run.cpu_s,
                         run.wall_s, run.scene_s, run.peak_mib, run.rays.camera, run.rays.reflected,
                         run.rays.refracted, run.rays.monochromatic, run.rays.shadow,
                         run.rays.total());
      out += fmt::format("{},{},{},{},{},{},{},{},{}\n", s.errors.relative_mse,
                         s.errors.relative_mse_rgb, s.errors.delta_e_mean, s.errors.delta_e_p99,
                         s.errors.flip, s.errors.banding,
                         s.spread ? fmt::format("{}", s.spread->noise) : "",
                         s.spread ? fmt::format("{}", s.spread->bias) : "", s.on_front ? 1 : 0);
    }
  return out;
}

Result<std::string> read_text(fs::path const& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) return Error{"E0511", fmt::format("cannot read '{}'", path.string())};
  return std::move(text).str();
}

/// Pictures of the page: of the reference, and of each setting the picture, its error and its
/// rays, as data URIs.
class Pictures {
public:
  explicit Pictures(StudyOptions const& options) : folder_(options.folder) {}

  Result<ordered_json> make(StudyResult const& result) {
    auto const reference = image::read(reference_picture(folder_));
    if (!reference) return reference.error();
    std::error_code failed;
    fs::create_directories(folder_ / "pictures", failed);
    ordered_json out{{"settings", ordered_json::object()}};
    out["reference"] = uri(*reference, "reference");
    double const most = most_rays(result);
    for (auto const& s : result.settings) {
      if (!s.measured()) continue;
      auto const picture = image::read(picture_of(folder_, s.setting));
      if (!picture) return picture.error();
      std::string const name = file_name(s.setting.name);
      auto& entry = out["settings"][s.setting.name];
      entry["picture"] = uri(*picture, name);
      auto const error = delta_e_map(*reference, *picture);
      entry["error"] = uri(error_map(error, picture->width, picture->height), name + "-error");
      auto const rays = image::read(cost_map_of(folder_, s.setting));
      entry["cost"] =
          rays ? ordered_json(uri(cost_map(*rays, most), name + "-rays")) : ordered_json(nullptr);
    }
    out["scales"] = {
        {"error", {{"colours", colours_of(ColourScale::Magma)}, {"most", most_delta_e}}},
        {"cost", {{"colours", colours_of(ColourScale::Viridis)}, {"most", most}}}};
    if (error_) return *error_;
    return out;
  }

private:
  double most_rays(StudyResult const& result) const {
    float most = 2;
    for (auto const& s : result.settings)
      if (s.measured())
        if (auto const rays = image::read(cost_map_of(folder_, s.setting)))
          most = std::max(most, *std::max_element(rays->rgb.begin(), rays->rgb.end()));
    return most;
  }

  std::string uri(image::Image const& picture, std::string const& name) {
    auto const png = png_of(picture, (folder_ / "pictures" / (name + ".png")).string());
    if (!png) {
      if (!error_) error_ = png.error();
      return "";
    }
    return "data:image/png;base64," + base64(*png);
  }

  fs::path folder_;
  std::optional<Error> error_;
};

/// The page's parts go where the template names them: <!--part-->.
Result<std::string> make_page(ReportHead const& head, ordered_json const& data) {
  auto page = read_text(head.assets / "report.html");
  if (!page) return page.error();
  std::string json = data.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  for (std::size_t at = 0; (at = json.find("</", at)) != std::string::npos; at += 3)
    json.replace(at, 2, "<\\/");
  std::vector<std::pair<std::string, std::string>> parts{{"<!--data-->", std::move(json)}};
  for (std::string_view const name : {"report.css", "chart.umd.js", "report.js"}) {
    auto text = read_text(head.assets / name);
    if (!text) return text.error();
    parts.emplace_back(fmt::format("<!--{}-->", name), std::move(*text));
  }
  std::string out;
  std::string_view rest = *page;
  for (;;) { // in one pass: what is put in is not looked at again
    std::size_t first = std::string_view::npos;
    std::pair<std::string, std::string> const* found = nullptr;
    for (auto const& part : parts)
      if (auto const at = rest.find(part.first); at < first) {
        first = at;
        found = &part;
      }
    if (!found) break;
    out += rest.substr(0, first);
    out += found->second;
    rest.remove_prefix(first + found->first.size());
  }
  return out.append(rest);
}

} // namespace

std::optional<double> ratio_to_none(StudyResult const& result, SettingResult const& setting) {
  for (auto const& other : result.settings)
    if (other.setting.family->name == "none" && other.measured()
        && other.setting.aa == setting.setting.aa
        && other.runs.front().bands == setting.runs.front().bands && other.cpu_s > 0)
      return setting.cpu_s / other.cpu_s;
  return std::nullopt;
}

image::Status write_report(StudyResult const& result, StudyOptions const& options,
                           ReportHead const& head) {
  ordered_json data = study_json(result, options, head);
  auto written = image::write_text(options.folder / "study.json", data.dump(1) + "\n");
  if (!written) return written;
  written = image::write_text(options.folder / "study.csv", study_csv(result, options, head));
  if (!written) return written;
  auto pictures = Pictures(options).make(result);
  if (!pictures) return pictures.error();
  data["pictures"] = std::move(*pictures);
  auto const page = make_page(head, data);
  if (!page) return page.error();
  return image::write_text(options.folder / "report.html", *page);
}

std::string to_text(StudyResult const& result) {
  std::string out = fmt::format(
      "{:<26} {:>9} {:>7} {:>9} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>7}\n", "setting", "CPU s",
      "x none", "wall s", "dE mean", "dE 99%", "FLIP", "banding", "noise", "bias", "MiB");
  std::vector<SettingResult const*> order;
  for (auto const& s : result.settings)
    if (s.measured()) order.push_back(&s);
  std::stable_sort(order.begin(), order.end(),
                   [](auto const* a, auto const* b) { return a->cpu_s < b->cpu_s; });
  for (auto const* s : order) {
    auto const ratio = ratio_to_none(result, *s);
    auto const part = [](bool there, double value) {
      return there ? fmt::format("{:.4f}", value) : std::string("-");
    };
    out += fmt::format(
        "{:<26} {:>9.3f} {:>7} {:>9.3f} {:>8.4f} {:>8.3f} {:>8.5f} {:>8.4f} {:>8} {:>8} {:>7.1f}\n",
        s->setting.name + (s->on_front ? " *" : ""), s->cpu_s,
        ratio ? fmt::format("{:.2f}", *ratio) : "-", s->wall_s, s->errors.delta_e_mean,
        s->errors.delta_e_p99, s->errors.flip, s->errors.banding,
        part(s->spread.has_value(), s->spread ? s->spread->noise : 0),
        part(s->spread.has_value(), s->spread ? s->spread->bias : 0), s->peak_mib);
  }
  out += "* on the Pareto front: nothing is both cheaper and closer to the reference\n";
  out += fmt::format("reference: {}, {:.1f} CPU s\n", result.reference, result.reference_run.cpu_s);
  for (auto const& note : result.notes) out += note + "\n";
  return out;
}

} // namespace abbe::study
