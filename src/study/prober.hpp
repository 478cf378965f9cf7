// SPDX-License-Identifier: MIT
#pragma once

#include "base/result.hpp"
#include "render/render.hpp"
#include "study/patches.hpp"
#include "study/way.hpp"

#include <map>
#include <optional>

namespace abbe::study {

/// A step of anti-aliasing; depth 0: one ray a pixel.
struct AaStep {
  int depth = 0;
  double threshold = 0;
  bool operator==(AaStep const&) const = default;
};

/// A setting that can be looked at.
struct Place {
  Way const* way = nullptr;
  std::size_t step = 0; ///< of the way's parameter
  int bands = 0;        ///< 0: r g b, or as they are given
  AaStep aa;
  int passes = 1;
  auto key() const { return std::tuple(way, step, bands, aa.depth, aa.threshold, passes); }
  bool operator<(Place const& other) const { return key() < other.key(); }
};

/// What a setting comes to, for the whole picture.
struct Seen {
  double delta_e = 0; ///< mean CIEDE2000 against the converged picture
  double rays = 0;
  double seconds = 0; ///< of the processor, over the number of threads
};

/// Looks at settings on patches of the picture at its own size, and compares them with a converged
/// picture of the same patches.
class Prober {
public:
  /// @param keep_aa the anti-aliasing of the options is given
  Prober(scene::Scene const& scene, plan::Overrides const& overrides,
         render::RenderOptions const& options, bool keep_aa);

  /// @error as plan::make_plan
  std::optional<Error> plan();
  bool spectral() const { return spectral_; }
  bool disperses() const { return disperses_; }
  /// The lights have lines, and how light is represented is not given: lines are channels.
  bool composite() const { return composite_; }
  int given_bands() const { return given_bands_; }
  /// Share of the picture that is looked at.
  double share() const { return patches_.pixels / pixels(); }

  /// How much longer than Seen::seconds the clock goes, by all looks so far: other
  /// programs run, and threads wait for each other.
  double load() const { return load_; }
  /// Fewer and smaller patches, where the coarsest reference would take longer than this.
  void fit_patches(double seconds);
  /// Makes the converged patches until they are known to `noise` (mean CIEDE2000) or `seconds`
  /// (0: any time) have gone; two halves with different random numbers tell how well they are
  /// known.
  void make_reference(double noise, double seconds);
  double reference_noise() const { return noise_; }
  double reference_rays() const { return reference_rays_; }

  /// On one patch in four: for comparing settings.
  Seen const& see(Place const& place);
  /// On all patches.
  Seen const& see_all(Place const& place);
  /// What deeper anti-aliasing of the same threshold and more passes would come to, from shallow
  /// probes: time grows with the samples of the pixels that are sampled again, the error's square
  /// falls with those of all passes to what the bands leave. Where anti-aliasing is given, from one
  /// pass and two.
  Seen reckon(Place const& place);
  /// Looks at a setting on many patches, with one sample a pixel (unless anti-aliasing is given):
  /// what reckon() says of time goes by them from now on. Takes about `seconds`.
  void calibrate(Place const& place, double seconds);
  /// Would a second pass be another picture?
  bool repeats(Place const& place) const;
  std::size_t count() const { return seen_.size() + seen_all_.size(); }
  render::AntiAliasing aa_of(Place const& place) const;
  plan::Overrides overrides_of(Place const& place) const;

private:
  void set_patches(int count, int side = patch_side);
  plan::Overrides reference_overrides() const;
  double pixels() const { return static_cast<double>(options_.width) * options_.height; }
  double scale(Patches const& patches) const { return pixels() / patches.pixels; }
  Probe probe(plan::Overrides const& overrides, render::AntiAliasing const& aa, std::uint64_t seed,
              Patches const& patches);
  Seen look(Place const& place, Patches const& patches);
  Seen one_pass(Place place);
  Place once(Place place) const;
  /// Of one sample a pixel, on as many patches as there are looks at.
  Seen const& middle(Place const& place);
  double seconds_of(Probe const& made, Patches const& patches) const;

  scene::Scene const& scene_;
  plan::Overrides overrides_;
  render::RenderOptions options_;
  bool keep_aa_;
  Patches patches_, some_; ///< the second: those that the first begins with
  bool spectral_ = false, disperses_ = false, composite_ = false;
  int given_bands_ = 0;
  double prepare_s_ = 0, a_patch_s_ = 0, used_s_ = 0, waited_s_ = 0, load_ = 1;
  int threads_ = 1;
  std::vector<Vec3> reference_;
  double noise_ = 0, reference_rays_ = 0;
  std::map<Place, Seen> seen_, seen_all_;
  std::map<Place, Seen> many_; ///< of calibrate()
};

} // namespace abbe::study
