// SPDX-License-Identifier: MIT
#include "lang/blocks.hpp"
#include "lang/libraries.hpp"
#include "lang/not_rendered.hpp"

#include <fmt/format.h>

#include <cmath>

namespace abbe::lang {

namespace {

using scene::Finish;
using scene::Reflection;

/// `albedo` asks for the total reflected share rather than the peak; settled when brilliance,
/// phong_size and roughness are known.
struct Albedo {
  bool diffuse = false, phong = false, specular = false;
};

double read_at_least(Reader& in, std::string_view name, double low) {
  Span const at = in.next_span();
  double const value = in.number(name);
  if (value >= low) return value;
  in.report(Severity::Error, "E0353",
            fmt::format("{} must be at least {}, not {}", name, low, value), at);
  return low;
}

double read_positive(Reader& in, std::string_view name) {
  Span const at = in.next_span();
  double const value = in.number(name);
  if (value > 0) return value;
  in.report(Severity::Error, "E0353", fmt::format("{} must be positive, not {}", name, value), at);
  return 1;
}

/// Options of `reflection { }` behind its colours.
bool read_reflection_option(Reader& in, Reflection& reflection) {
  if (in.accept("fresnel"))
    reflection.fresnel = in.boolean_or(true);
  else if (in.accept("falloff"))
    reflection.falloff = in.number("falloff");
  else if (in.accept("exponent"))
    reflection.exponent = read_positive(in, "exponent");
  else if (in.accept("metallic"))
    reflection.metallic = in.optional_number("metallic").value_or(1);
  else
    return false;
  return true;
}

void read_reflection_block(Reader& in, Reflection& reflection) {
  int colours = 0;
  while (!in.at_end()) {
    if (in.accept("metal")) {
      reflection.metal = read_metal(in);
      reflection.minimum.rgb = reflection.maximum.rgb = Vec3(1);
      colours = 2;
    } else if (read_reflection_option(in, reflection)) {
      continue;
    } else if (colours < 2 && starts_colour(in)) {
      (colours == 0 ? reflection.minimum : reflection.maximum) = read_rgb(in, "reflection");
      ++colours;
    } else {
      reject(in, "a colour or an item of reflection");
    }
  }
  if (colours == 0)
    in.report(Severity::Error, "E0250", "reflection {} needs a colour or a metal", in.block_span());
  if (colours == 1) {
    reflection.maximum = reflection.minimum;
    if (reflection.fresnel) reflection.minimum = {};
  }
}

bool read_reflection(Reader& in, Finish& finish) {
  Reflection fresh;
  if (finish.reflection) fresh.exponent = finish.reflection->exponent;
  if (in.open("reflection")) {
    read_reflection_block(in, fresh);
    in.close();
    finish.reflection = std::move(fresh);
  } else if (in.accept("reflection")) {
    fresh.minimum = fresh.maximum = read_rgb(in, "reflection");
    finish.reflection = std::move(fresh);
  } else if (in.accept("reflection_exponent")) {
    double const exponent = read_positive(in, "reflection_exponent");
    if (!finish.reflection) finish.reflection = fresh;
    finish.reflection->exponent = exponent;
  } else {
    return false;
  }
  return true;
}

bool read_diffuse(Reader& in, Finish& finish, Albedo& albedo) {
  if (!in.accept("diffuse")) return false;
  albedo.diffuse = in.accept("albedo");
  finish.diffuse = in.number("diffuse");
  if (auto back = in.optional_number("diffuse from behind")) finish.diffuse_back = *back;
  return true;
}

bool read_highlight(Reader& in, Finish& finish, Albedo& albedo) {
  if (in.accept("phong")) {
    albedo.phong = in.accept("albedo");
    finish.phong = in.number("phong");
  } else if (in.accept("phong_size")) {
    finish.phong_size = in.number("phong_size");
  } else if (in.accept("specular")) {
    albedo.specular = in.accept("albedo");
    finish.specular = in.number("specular");
  } else if (in.accept("roughness")) {
    finish.roughness = read_positive(in, "roughness");
  } else if (in.accept("metallic")) {
    finish.metallic = in.optional_number("metallic").value_or(1);
  } else {
    return false;
  }
  return true;
}

/// `irid { AMOUNT [thickness T] [turbulence T] }`
void read_irid(Reader& in, Finish& finish) {
  finish.irid = in.number("amount of iridescence");
  while (!in.at_end()) {
    if (in.accept("thickness"))
      finish.irid_thickness = in.number("thickness");
    else if (in.accept("turbulence"))
      finish.irid_turbulence = in.number("turbulence");
    else
      reject(in, "an item of irid");
  }
  in.close();
}

bool read_item(Reader& in, Finish& finish, Albedo& albedo) {
  if (in.accept("ambient"))
    finish.ambient = read_rgb(in, "ambient");
  else if (in.accept("emission"))
    finish.emission = read_rgb(in, "emission");
  else if (in.accept("brilliance"))
    finish.brilliance = read_at_least(in, "brilliance", 0);
  else if (in.accept("crand"))
    finish.crand = in.number("crand");
  else if (in.open("irid"))
    read_irid(in, finish);
  else if (in.accept("conserve_energy"))
    finish.conserve_energy = in.boolean_or(true);
  else
    return read_diffuse(in, finish, albedo) || read_highlight(in, finish, albedo)
           || read_reflection(in, finish) || read_subsurface(in);
  return true;
}

void apply(Albedo const& albedo, Finish& finish) {
  if (albedo.diffuse) {
    finish.diffuse *= (finish.brilliance + 1) / 2;
    finish.diffuse_back *= (finish.brilliance + 1) / 2;
  }
  if (albedo.phong) finish.phong *= (finish.phong_size + 1) / 2;
  if (albedo.specular) {
    double const e = 1 / finish.roughness;
    finish.specular *= (e + 2) / (4 * (2 - std::exp2(-e / 2)));
  }
}

bool reject_legacy(Reader& in) {
  for (std::string_view word : {"ior", "caustics", "refraction"})
    if (in.next_word() == word) {
      in.report(Severity::Error, "E0901",
                fmt::format("'{}' in a finish is not supported: write it in interior {{ }}", word),
                in.next_span());
      in.skip();
      return true;
    }
  return false;
}

} // namespace

void read_finish(Reader& in, Finish& finish) {
  Albedo albedo;
  for (bool first = true; !in.at_end(); first = false) {
    if (read_item(in, finish, albedo)) continue;
    if (auto named = in.accept_copied<Finish>(first, "finish"))
      finish = *named;
    else if (!reject_legacy(in))
      reject(in, "a finish item");
  }
  apply(albedo, finish);
}

} // namespace abbe::lang
