// SPDX-License-Identifier: MIT
#include "cli/render_target.hpp"

#include "cli/say.hpp"
#include "job/interrupt.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace abbe::cli {
namespace {

/// What was not given but chosen, as options.
std::string options_of(study::Choice const& choice, RenderArguments const& arguments) {
  std::string out;
  if (!choice.dispersion.empty()) out += fmt::format(" --dispersion \"{}\"", choice.dispersion);
  if (!choice.representation.empty())
    out += fmt::format(" --representation {}", choice.representation);
  if (choice.bands && !arguments.scene.bands) out += fmt::format(" --bands {}", *choice.bands);
  if (arguments.target.keep_aa) return out;
  auto const& aa = choice.aa;
  if (aa.method == 0) return out + " --aa off";
  if (aa.by_samples()) return out + fmt::format(" --samples {}", aa.samples.least);
  return out
         + fmt::format(" --aa {} --aa-threshold {} --aa-jitter {}", aa.depth, aa.threshold,
                       aa.jitter);
}

} // namespace

int choose(RenderArguments& arguments, lang::Evaluated const& evaluated, Stopwatch const& since,
           std::string& chosen) {
  auto& options = arguments.options;
  auto target = arguments.target;
  if (target.seconds > 0) target.seconds = std::max(1e-3, target.seconds - since.wall_s());
  auto const choice =
      study::choose_setting(evaluated.scene, overrides_of(arguments.scene), options, target);
  if (job::interrupted()) return job::interrupted_status();
  if (!choice) return render_failed(choice.error(), 1);
  chosen = options_of(*choice, arguments);
  if (choice->bands && !arguments.scene.bands) arguments.scene.bands = choice->bands;
  if (!choice->dispersion.empty()) arguments.scene.dispersion = choice->dispersion;
  if (!choice->representation.empty()) arguments.scene.representation = choice->representation;
  options.anti_aliasing = choice->aa;
  if (arguments.scene.quiet) return 0;
  say("abbe: {}: expected error {:.3g} (mean CIEDE2000), about {:.2g} s; the {} of {} "
      "settings tried on {:.2g} % of the picture\n",
      choice->text, choice->expected_delta_e, choice->expected_s,
      target.seconds > 0 ? "closest in the time"
      : choice->reached  ? "one with the fewest rays"
                         : "closest",
      choice->probes, 100 * choice->probe_share);
  if (!choice->reached)
    say("abbe: the {} cannot be reached with what may be chosen\n",
        target.seconds > 0 ? "time" : "error");
  else if (target.delta_e > 0 && choice->expected_delta_e < 0.75 * target.delta_e)
    say("abbe: nothing cheaper is less exact than asked for\n");
  return 0;
}

void say_again(RenderArguments const& arguments, std::string const& chosen, int passes) {
  say("abbe: {} pass{}; the same bytes again without a clock, for --time {}:{}{}\n", passes,
      passes == 1 ? "" : "es", arguments.time_text, chosen,
      passes == 1 ? "" : fmt::format(" --passes {}", passes));
}

} // namespace abbe::cli
