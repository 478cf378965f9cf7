// SPDX-License-Identifier: MIT
#include "lang/blocks.hpp"

namespace abbe::lang {

scene::SkySphere read_sky_sphere(Reader& in) {
  scene::SkySphere sky;
  for (bool first = true; !in.at_end(); first = false) {
    geometry::Transform transform;
    if (auto named = in.accept_copied<scene::SkySphere>(first, "sky_sphere")) {
      sky = *named;
    } else if (in.open("pigment")) {
      scene::Pigment pigment = default_texture(in, in.block_span()).pigment;
      read_pigment(in, pigment);
      in.close();
      // A pigment written after a transform does not move with it.
      if (!sky.placement.identity()) transform_pigment(pigment, sky.placement.inverse());
      sky.pigments.push_back(std::move(pigment));
    } else if (in.accept("emission")) {
      sky.emission = read_rgb(in, "emission");
    } else if (read_transform(in, transform)) {
      sky.placement = sky.placement.then(transform);
    } else {
      reject(in, "a sky_sphere item");
    }
  }
  sky.span = in.block_span();
  if (sky.pigments.empty())
    in.report(Severity::Error, "E0250", "sky_sphere {} needs a pigment", sky.span);
  return sky;
}

} // namespace abbe::lang
