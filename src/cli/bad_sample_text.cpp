// SPDX-License-Identifier: MIT
#include "cli/bad_sample_text.hpp"

#include <fmt/format.h>

namespace abbe::cli {
namespace {

using render::BadSample;
using render::PathStep;

std::string_view adjective(BadSample::Kind kind) {
  switch (kind) {
  case BadSample::Kind::NotANumber:
    return "not a number";
  case BadSample::Kind::Infinite:
    return "infinite";
  case BadSample::Kind::Negative:
    return "negative";
  }
  ABBE_ASSERT(false);
}

std::string_view event(PathStep::Kind kind) {
  switch (kind) {
  case PathStep::Kind::Camera:
    return "camera";
  case PathStep::Kind::Reflected:
    return "reflected";
  case PathStep::Kind::Refracted:
    return "refracted";
  case PathStep::Kind::Passed:
    return "passed";
  }
  ABBE_ASSERT(false);
}

} // namespace

std::string bad_sample_text(BadSample const& sample) {
  std::string out = fmt::format(
      "error[E0710]: the light of pixel {}, {} (sample {}) is {}: rgb {:.9g} {:.9g} {:.9g}\n",
      sample.x, sample.y, sample.sample, adjective(sample.kind), sample.rgb.x, sample.rgb.y,
      sample.rgb.z);
  for (std::size_t i = 0; i < sample.path.size(); ++i) {
    PathStep const& step = sample.path[i];
    std::string const light = step.lambda_nm ? fmt::format("{:.2f} nm", *step.lambda_nm)
                                             : fmt::format("{} channels", step.lanes);
    out += fmt::format("  {:<9} ray, {}{}", event(step.kind), light,
                       step.in_order ? "" : ", its light wrong already");
    if (!step.met) {
      out += ", meets the background";
    } else {
      out += fmt::format(", meets the {} at <{:.17g}, {:.17g}, {:.17g}>", step.keyword,
                         step.point.x, step.point.y, step.point.z);
      if (step.object.valid()) {
        auto const place = step.object.source->place(step.object.begin);
        out += fmt::format(" of {}:{}:{}", step.object.source->name(), place.line, place.column);
      }
    }
    out += i + 1 == sample.path.size() ? ": made there\n" : "\n";
  }
  return out;
}

} // namespace abbe::cli
