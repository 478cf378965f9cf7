// SPDX-License-Identifier: MIT
#include "lang/blocks.hpp"
#include "lang/not_rendered.hpp"

#include <fmt/format.h>

namespace abbe::lang {

namespace {

constexpr PigmentWords density_words{"density", "density_map"};

/// `scattering { type, colour [eccentricity f] [extinction f] }`
void read_scattering(Reader& in) {
  in.integer("type of scattering", 1, 5);
  read_rgb(in, "scattering");
  while (!in.at_end())
    if (in.accept("eccentricity"))
      in.number("eccentricity");
    else if (in.accept("extinction"))
      in.number("extinction");
    else
      reject(in, "'eccentricity' or 'extinction'");
}

/// How POV-Ray looks for light on the way.
bool read_sampling(Reader& in) {
  if (in.accept("method")) {
    in.integer("method", 1, 3);
  } else if (in.accept("samples")) {
    in.number("samples");
    in.optional_number("samples at most");
  } else if (in.accept("collect")) {
    in.boolean_or(true);
  } else {
    for (std::string_view const word :
         {"aa_level", "aa_threshold", "confidence", "intervals", "jitter", "ratio", "variance"})
      if (in.accept(word)) {
        in.number(word);
        return true;
      }
    return false;
  }
  return true;
}

bool read_item(Reader& in) {
  geometry::Transform transform;
  if (in.accept("absorption")) {
    read_rgb(in, "absorption");
  } else if (in.accept("emission")) {
    read_rgb(in, "emission");
  } else if (in.open("scattering")) {
    read_scattering(in);
    in.close();
  } else if (in.open("density")) {
    read_density(in);
    in.close();
  } else {
    return read_sampling(in) || read_transform(in, transform);
  }
  return true;
}

} // namespace

void read_media(Reader& in) {
  note_not_rendered(in, "media", in.block_span());
  for (bool first = true; !in.at_end(); first = false)
    if (!in.accept_copied<MediaValue>(first, "media") && !read_item(in)) reject(in, "a media item");
}

scene::Pigment read_density(Reader& in) {
  scene::Pigment density;
  density.colour.rgb = Vec3(1);
  read_pigment_of_texture(in, density, {}, density_words);
  return density;
}

std::vector<scene::Pigment::Entry> read_density_map(Reader& in) {
  return read_pigment_map(in, density_words);
}

} // namespace abbe::lang
