// SPDX-License-Identifier: MIT
#include "job/picture_file.hpp"

#include <fmt/format.h>

namespace abbe::job {
namespace {

std::string text_of(render::AntiAliasing const& aa) {
  if (aa.method == 0) return "off";
  if (!aa.by_samples()) return fmt::format("{}", aa.depth);
  auto const& samples = aa.samples;
  if (samples.least == samples.most) return fmt::format("samples {}", samples.least);
  return fmt::format("samples {}..{} error {}", samples.least, samples.most, samples.error);
}

} // namespace

image::ImageHead head_of(render::RenderOptions const& options, plan::Plan const& plan,
                         std::string const& scene) {
  image::ImageHead head;
  render::Region const region = options.pixels();
  head.width = region.x1 - region.x0;
  head.height = region.y1 - region.y0;
  if (options.spectral_output) {
    auto const centers = plan.spectral->bands.centers();
    auto const edges = plan.spectral->bands.edges();
    head.band_centres_nm.assign(centers.begin(), centers.end());
    head.band_edges_nm.assign(edges.begin(), edges.end());
  }
  head.metadata = {{"Software", "abbe " ABBE_VERSION},
                   {"Scene", scene},
                   {"Plan", plan::describe(plan)},
                   {"Seed", fmt::format("{}", options.seed)},
                   {"AntiAliasing", text_of(options.anti_aliasing)}};
  return head;
}

image::Status PictureFile::take(image::Image const& rows, int passes) {
  if (!writer_) {
    if (passes > 1) head_.metadata.emplace_back("Passes", fmt::format("{}", passes));
    head_.late_keys = {"MissingLight"};
    auto opened = image::open_writer(head_, path_, options_);
    if (!opened) return opened.error();
    writer_ = std::move(*opened);
  }
  return writer_->write(rows);
}

image::Status PictureFile::finish(render::RenderResult const& result) {
  return writer_->finish({fmt::format("at most {:.3g}, in no sample more than {:.3g}",
                                      result.missing_mean, result.missing_most)});
}

} // namespace abbe::job
