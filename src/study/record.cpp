// SPDX-License-Identifier: MIT
#include "study/record.hpp"

#include "job/stats.hpp"

#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sys/sysinfo.h>
#include <sys/utsname.h>
#include <thread>

namespace abbe::study {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

/// A JSON file; discarded (json::is_discarded) when it cannot be read.
json read_json(std::filesystem::path const& path) {
  std::ifstream file(path);
  return file ? json::parse(file, nullptr, false) : json(json::value_t::discarded);
}

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

} // namespace

ordered_json to_json(RunRecord const& run) {
  return {{"identity", run.identity},
          {"words", run.words},
          {"seed", run.seed},
          {"done", run.done},
          {"message", run.message},
          {"wall_s", run.wall_s},
          {"cpu_s", run.cpu_s},
          {"scene_s", run.scene_s},
          {"peak_mib", run.peak_mib},
          {"bands", run.bands},
          {"rays", job::rays_to_json(run.rays)}};
}

std::optional<RunRecord> read_record(std::filesystem::path const& path, std::string const& identity,
                                     std::vector<std::string> const& words) {
  auto const data = read_json(path);
  if (data.is_discarded()) return std::nullopt;
  try {
    RunRecord run;
    run.identity = data.at("identity");
    run.words = data.at("words").get<std::vector<std::string>>();
    if (run.identity != identity || run.words != words) return std::nullopt;
    run.seed = data.at("seed");
    run.done = data.at("done");
    run.message = data.at("message");
    run.wall_s = data.at("wall_s");
    run.cpu_s = data.at("cpu_s");
    run.scene_s = data.at("scene_s");
    run.peak_mib = data.at("peak_mib");
    run.bands = data.at("bands");
    run.rays = job::rays_from_json(data.at("rays"));
    return run;
  } catch (json::exception const&) {
    return std::nullopt; // damaged: it is run again
  }
}

bool read_stats(std::filesystem::path const& path, RunRecord& run) {
  auto const data = read_json(path);
  if (data.is_discarded()) return false;
  try {
    run.wall_s = data.at("render_s").at("wall");
    run.cpu_s = data.at("render_s").at("cpu");
    run.scene_s = data.at("scene_s").at("cpu");
    run.bands = data.at("bands");
    run.rays = job::rays_from_json(data.at("rays"));
    return true;
  } catch (json::exception const&) {
    return false;
  }
}

Machine this_machine() {
  Machine machine;
  machine.processor = processor_name();
  utsname system{};
  if (uname(&system) == 0) machine.system = fmt::format("{} {}", system.sysname, system.release);
#if defined(__clang__)
  machine.compiler = fmt::format("clang {}", __clang_version__);
#else
  machine.compiler = fmt::format("g++ {}", __VERSION__);
#endif
  machine.threads = static_cast<int>(std::thread::hardware_concurrency());
  struct sysinfo memory {};
  if (sysinfo(&memory) == 0)
    machine.memory_gib = static_cast<double>(memory.totalram) * memory.mem_unit / 0x1p30;
  double load[1];
  if (getloadavg(load, 1) == 1) machine.load = load[0];
  return machine;
}

ordered_json to_json(Machine const& machine) {
  return {{"processor", machine.processor},   {"threads", machine.threads},
          {"memory_gib", machine.memory_gib}, {"system", machine.system},
          {"compiler", machine.compiler},     {"load", machine.load}};
}

} // namespace abbe::study
