// SPDX-License-Identifier: MIT
#include "cli/commands.hpp"
#include "cli/scene_arguments.hpp"
#include "job/interrupt.hpp"
#include "render/render.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fmt/format.h>

/// explain: which effects a scene calls for, why, where, and what each costs.
///
/// The cost is measured by a probe: the picture, small, by one thread, once as planned and once
/// without each effect (as `effects { X off }` would). An effect's share is what is saved when it
/// alone is off, so shares need not add up. Rays are counted, and the same in every run; time is
/// the processor's, the least of three, without what the scene takes to be made ready.
namespace abbe::cli {
namespace {

constexpr std::uint64_t probe_rays = 200'000; ///< as many at most, about
constexpr int probe_width = 160;

struct Cost {
  render::RayCounts rays;
  double seconds = 0;
};

class Probe {
public:
  Probe(scene::Scene const& scene, SceneArguments const& arguments)
      : scene_(scene), arguments_(arguments) {}

  /// Chooses a size by the rays of a very small picture: the same in every run.
  void choose_size(plan::Plan const& plan) {
    set_width(16);
    auto const first = static_cast<double>(once(plan).rays.total());
    double const fits = 16 * std::sqrt(probe_rays / std::max(first, 1.0));
    set_width(std::clamp(static_cast<int>(fits), 16, probe_width));
  }

  Cost measure(plan::Plan const& plan) {
    Cost best = once(plan);
    for (int i = 1; i < 3 && !job::interrupted(); ++i)
      best.seconds = std::min(best.seconds, once(plan).seconds);
    return best;
  }

  int width() const { return options_.width; }
  int height() const { return options_.height; }

private:
  void set_width(int width) {
    options_.width = width;
    options_.height = std::max(1, width * arguments_.height / arguments_.width);
    options_.threads = 1;
    options_.stop = &job::interrupted();
  }

  static double processor_seconds() {
    return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
  }

  Cost once(plan::Plan const& plan) const {
    render::RenderOptions one_pixel = options_;
    one_pixel.region = render::Region{0, 0, 1, 1};
    double const start = processor_seconds();
    render::render(scene_, plan, one_pixel);
    double const ready = processor_seconds();
    auto const result = render::render(scene_, plan, options_);
    return {result.counts, std::max(0.0, processor_seconds() - ready - (ready - start))};
  }

  scene::Scene const& scene_;
  SceneArguments const& arguments_;
  render::RenderOptions options_;
};

double share(double with, double without) {
  return with > 0 ? 100 * (with - without) / with : 0;
}

/// What is saved without the effect; empty where it cannot be off.
std::string cost_of(plan::Effect effect, scene::Scene const& scene, plan::Overrides overrides,
                    Probe& probe, Cost const& whole) {
  auto const by = plan::switch_of(effect);
  if (!by || effect == plan::Effect::StochasticDispersion) return "";
  overrides.lenient = true;
  overrides.effects.push_back({*by, false, {}});
  if (*by == scene::Switch::Dispersion) overrides.dispersion.reset();
  if (*by == scene::Switch::Spectral) {
    overrides.spectral = false;
    overrides.bands.reset();
  }
  auto const without = plan::make_plan(scene, overrides);
  if (!without) return "  [cannot be off]";
  Cost const cost = probe.measure(*without);
  return fmt::format(
      "  [{:.0f} % of the rays, {:.0f} % of the time]",
      share(static_cast<double>(whole.rays.total()), static_cast<double>(cost.rays.total())),
      share(whole.seconds, cost.seconds));
}

} // namespace

int run_explain(int argc, char** argv) {
  SceneArguments arguments;
  CommandLine app("Which effects a scene calls for, why, where, and what each costs.",
                  "abbe explain");
  arguments.add_to(app, true);
  bool no_probe = false;
  app.add_flag("--no-probe", no_probe, "do not measure what the effects cost");
  app.footer(
      "The probe renders the scene small, by one thread, as planned and without each effect\n"
      "that can be off: its share is what is saved then. Rays are counted, the same in every\n"
      "run; time is the processor's, the least of three. Shares need not add up.");
  if (int const status = app.parse(argc, argv); status >= 0) return status;
  int status = 0;
  lang::Evaluated const* const evaluated = load_scene(arguments, status);
  if (!evaluated) return status;
  auto const plan = plan_scene(*evaluated, arguments, status);
  if (!plan) return status;
  if (no_probe) {
    fmt::print("{}", plan::describe(*plan));
    return 0;
  }
  Probe probe(evaluated->scene, arguments);
  probe.choose_size(*plan);
  Cost const whole = probe.measure(*plan);
  std::string out = plan::describe_transport(*plan);
  render::RayCounts const& rays = whole.rays;
  out += fmt::format("probe: {} x {} pixels, {:.3f} s, {} rays: camera {}, reflected {}, refracted "
                     "{}, monochromatic {}, shadow {}\n",
                     probe.width(), probe.height(), whole.seconds, rays.total(), rays.camera,
                     rays.reflected, rays.refracted, rays.monochromatic, rays.shadow);
  for (int i = 0; i < plan::effect_count && !job::interrupted(); ++i) {
    auto const effect = static_cast<plan::Effect>(i);
    out += plan::describe(*plan, effect);
    if (plan->has(effect))
      out += cost_of(effect, evaluated->scene, overrides_of(arguments), probe, whole);
    out += '\n';
  }
  if (job::interrupted()) return job::interrupted_status();
  fmt::print("{}", out);
  return 0;
}

} // namespace abbe::cli
