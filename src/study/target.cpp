// SPDX-License-Identifier: MIT
#include "study/target.hpp"

#include "study/search.hpp"

#include <fmt/format.h>

namespace abbe::study {
namespace {

/// How well the converged picture is to be known, of the error that is asked for.
constexpr double reference_noise = 0.4;
/// Of a time: for the converged patches.
constexpr double patches_share = 0.04, reference_share = 0.08;

Choice choice_of(Prober const& prober, Answer const& answer) {
  Choice choice;
  auto const& place = answer.place;
  if (prober.spectral()) choice.bands = place.bands > 0 ? place.bands : prober.given_bands();
  auto const overrides = prober.overrides_of(place);
  if (place.way->mode) {
    choice.dispersion = scene::text(*overrides.dispersion);
    choice.text = choice.dispersion + ", ";
  }
  if (prober.composite()) choice.representation = "composite";
  choice.aa = prober.aa_of(place);
  choice.passes = place.passes;
  choice.expected_delta_e = answer.seen.delta_e;
  choice.expected_s = answer.seen.seconds;
  choice.reached = answer.reached;
  choice.probes = static_cast<int>(prober.count());
  choice.probe_share = prober.share();
  if (choice.bands)
    choice.text +=
        fmt::format("{} bands{}, ", *choice.bands, prober.composite() ? " and lines" : "");
  choice.text +=
      choice.aa.method == 0 ? std::string("no anti-aliasing")
      : choice.aa.by_samples()
          ? fmt::format("{} samples a pixel", choice.aa.samples.least)
          : fmt::format("aa {} (threshold {:.3g})", choice.aa.depth, choice.aa.threshold);
  if (choice.passes > 1) choice.text += fmt::format(", about {} passes", choice.passes);
  return choice;
}

} // namespace

std::vector<Way const*> Question::open_ways() const {
  if (mode_given || !prober.disperses()) return {&way_of_the_scene()};
  std::vector<Way const*> out;
  for (auto const& way : ways()) out.push_back(&way);
  return out;
}

Place Question::first_place(Way const& way) const {
  return {&way, 0, prober.spectral() && !bands_given ? way.first_bands : 0, {}};
}

std::optional<Place> Question::more_bands(Place place) const {
  if (place.bands == 0 || place.bands >= most_bands) return std::nullopt;
  place.bands *= 2;
  return place;
}

std::optional<Place> Question::next_step(Place place) const {
  if (place.step + 1 >= place.way->steps.size()) return std::nullopt;
  ++place.step;
  return place;
}

Result<Choice> choose_setting(scene::Scene const& scene, plan::Overrides const& overrides,
                              render::RenderOptions const& options, Target const& target) {
  Prober prober(scene, overrides, options, target.keep_aa);
  Question const question{prober, target, overrides.bands.has_value(),
                          overrides.dispersion.has_value(), options.stop};
  if (auto const error = prober.plan()) return *error;
  if (target.seconds > 0) {
    prober.fit_patches(patches_share * target.seconds);
    prober.make_reference(0, reference_share * target.seconds);
    return choice_of(prober, search_for_time(question));
  }
  prober.make_reference(reference_noise * target.delta_e, 0);
  return choice_of(prober, search_for_error(question));
}

} // namespace abbe::study
