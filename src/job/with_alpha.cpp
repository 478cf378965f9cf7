// SPDX-License-Identifier: MIT
#include "job/with_alpha.hpp"

#include "plan/quality.hpp"

#include <algorithm>

namespace abbe::job {
namespace {

/// 1 minus the grey of a picture of the background alone.
class CoverageSink : public Sink {
public:
  image::Status take(image::Image const& rows, int) override {
    for (std::size_t i = 0; i < rows.pixels(); ++i) {
      float const* const rgb = &rows.rgb[3 * i];
      double const open = 0.297 * rgb[0] + 0.589 * rgb[1] + 0.114 * rgb[2]; // POV-Ray's grey
      // What rounding leaves of a covered pixel's 1 or 0 is nothing.
      double const covered = 1 - open;
      alpha.push_back(static_cast<float>(covered < 1e-6 ? 0 : covered > 1 - 1e-6 ? 1 : covered));
    }
    return std::monostate{};
  }
  image::Status finish(render::RenderResult const&) override { return std::monostate{}; }
  std::vector<float> alpha; ///< row by row
};

class AlphaSink : public Sink {
public:
  AlphaSink(Sink& sink, std::vector<float> const& alpha) : sink_(sink), alpha_(alpha) {}
  image::Status take(image::Image const& rows, int passes) override {
    image::Image with = rows;
    auto const first = alpha_.begin() + static_cast<std::ptrdiff_t>(taken_);
    with.alpha.assign(first, first + static_cast<std::ptrdiff_t>(rows.pixels()));
    taken_ += rows.pixels();
    return sink_.take(with, passes);
  }
  image::Status finish(render::RenderResult const& result) override { return sink_.finish(result); }

private:
  Sink& sink_;
  std::vector<float> const& alpha_;
  std::size_t taken_ = 0;
};

} // namespace

Outcome run_with_alpha(scene::Scene&& scene, plan::Plan const& plan,
                       plan::Overrides const& overrides, Options const& options, Sink& sink) {
  CoverageSink coverage;
  {
    scene::Scene background = plan::background_only(scene);
    auto grey = overrides;
    grey.spectral = false;
    grey.lenient = true;
    auto const plan_of_background = plan::make_plan(background, grey);
    ABBE_ASSERT(plan_of_background); // the scene's own could be made
    Options first;
    first.render = options.render;
    first.render.spectral_output = false;
    first.render.on_progress = nullptr;
    first.render.passes = 1;
    auto const outcome = run(std::move(background), *plan_of_background, first, coverage);
    if (outcome.end != Outcome::End::Done) return outcome;
  }
  AlphaSink with_alpha(sink, coverage.alpha);
  plan::leave_out_background(scene);
  return run(std::move(scene), plan, options, with_alpha);
}

} // namespace abbe::job
