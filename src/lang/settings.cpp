// SPDX-License-Identifier: MIT
#include "lang/blocks.hpp"
#include "lang/not_rendered.hpp"

#include "optics/bands.hpp"

#include <fmt/format.h>

namespace abbe::lang {

namespace {

using scene::Settings;
using scene::SpectralSettings;

void read_spacing(Reader& in, SpectralSettings& spectral) {
  if (in.accept("uniform")) {
    spectral.spacing = SpectralSettings::Spacing::Uniform;
  } else if (in.accept("hall")) {
    spectral.spacing = SpectralSettings::Spacing::Hall;
  } else if (in.open("boundaries")) {
    spectral.spacing = SpectralSettings::Spacing::Boundaries;
    spectral.boundaries_nm.clear();
    while (in.has_value()) spectral.boundaries_nm.push_back(in.number("boundary in nm"));
    in.close();
  } else {
    in.report(Severity::Error, "E0250",
              "expected 'uniform', 'hall' or 'boundaries { ... }' after 'spacing'", in.next_span());
    if (!in.at_end()) in.skip();
  }
}

/// After `representation`.
void read_representation(Reader& in, scene::Representation& out) {
  using Kind = scene::Representation::Kind;
  out = {};
  if (in.accept("bands")) return;
  if (in.accept("composite")) {
    out.kind = Kind::Composite;
  } else if (in.accept("basis")) {
    out.kind = Kind::Basis;
    out.size = in.integer("size of the basis", 1, 1000);
  } else if (in.accept("adaptive")) {
    out.kind = Kind::Adaptive;
    if (!in.accept("tolerance")) return;
    Span const at = in.next_span();
    out.tolerance = in.number("tolerance (CIEDE2000)");
    if (!(out.tolerance > 0))
      in.report(Severity::Error, "E0353",
                fmt::format("the tolerance must be positive, not {}", out.tolerance), at);
  } else {
    in.report(Severity::Error, "E0250",
              "expected 'bands', 'composite', 'basis SIZE' or 'adaptive tolerance T' after "
              "'representation'",
              in.next_span());
    if (!in.at_end()) in.skip();
  }
}

double read_unit(Reader& in) {
  Span const at = in.next_span();
  double const mm = in.number("millimetres per unit");
  if (mm > 0) return mm;
  in.report(Severity::Error, "E0353",
            fmt::format("a scene unit must have a positive number of millimetres, not {}", mm), at);
  return 1;
}

/// Half of what the adaptive mode allows itself.
constexpr double default_merge_px = 0.25;

/// After `merge`.
double read_merge(Reader& in) {
  Span const at = in.next_span();
  if (in.accept("off") || in.accept("no")) return 0;
  if (in.accept("on") || in.accept("yes")) return default_merge_px;
  double const pixels = in.number("pixels that wavelengths may land apart, 'on' or 'off'");
  if (pixels >= 0) return pixels;
  in.report(Severity::Error, "E0353",
            fmt::format("'merge' must not be negative: {} pixels", pixels), at);
  return 0;
}

void read_spectral(Reader& in, SpectralSettings& spectral) {
  spectral.requested = true;
  spectral.span = in.block_span();
  while (!in.at_end()) {
    if (in.accept("bands")) {
      spectral.bands = in.integer("number of bands", 1, optics::Bands::max_count);
    } else if (in.accept("range")) {
      spectral.low_nm = in.number("lower end of the range in nm");
      spectral.high_nm = in.number("upper end of the range in nm");
    } else if (in.accept("spacing")) {
      read_spacing(in, spectral);
    } else if (in.accept("representation")) {
      read_representation(in, spectral.representation);
    } else if (in.open("dispersion")) {
      spectral.dispersion = read_dispersion_mode(in);
      in.close();
    } else if (in.accept("merge")) {
      spectral.merge_px = read_merge(in);
    } else if (in.accept("unit")) {
      spectral.mm_per_unit = read_unit(in);
    } else {
      reject(in, "a spectral setting");
    }
  }
  if (spectral.spacing == SpectralSettings::Spacing::Boundaries
      && spectral.boundaries_nm.size() >= 2) {
    spectral.bands = static_cast<int>(spectral.boundaries_nm.size()) - 1;
    spectral.low_nm = spectral.boundaries_nm.front();
    spectral.high_nm = spectral.boundaries_nm.back();
  }
  if (auto bands = make_bands(spectral); !bands)
    in.report(Severity::Error, bands.error().code, bands.error().message, spectral.span);
}

void read_gamma(Reader& in, Settings& settings) {
  Span const at = in.next_span();
  bool& given = scene_state(in.interpreter()).gamma_given;
  bool const srgb = in.accept("srgb");
  double const gamma = srgb ? 2.2 : in.number("assumed_gamma");
  if (given) {
    in.report(Severity::Warning, "E0357", "a second assumed_gamma is ignored", at);
    return;
  }
  if (!(gamma > 0)) {
    in.report(Severity::Error, "E0353",
              fmt::format("assumed_gamma must be positive, not {}", gamma), at);
    return;
  }
  given = true;
  settings.assumed_gamma = gamma;
  settings.assumed_gamma_srgb = srgb;
}

/// Settings of POV-Ray that change nothing in what abbe does; those that would change a picture in
/// POV-Ray are not taken without a word.
bool read_ignored(Reader& in) {
  if (in.accept("charset")) {
    if (!in.accept("ascii") && !in.accept("utf8") && !in.accept("sys")) in.unexpected("charset");
  } else if (in.accept("hf_gray_16")) {
    in.boolean_or(true);
  } else if (in.accept("max_intersections")) {
    in.number("max_intersections");
  } else if (in.accept("number_of_waves")) {
    scene_state(in.interpreter()).number_of_waves = in.integer("number_of_waves", 1, 1000);
  } else if (in.accept("mm_per_unit")) {
    in.number("mm_per_unit"); // for subsurface, which is told
  } else {
    return false;
  }
  return true;
}

double read_contact(Reader& in) {
  Span const at = in.next_span();
  double const share = in.number("contact");
  if (share >= 0 && share < 1) return share;
  in.report(Severity::Error, "E0353",
            fmt::format("contact is a share of the smaller solid's extent, at least 0 and below 1, "
                        "not {}",
                        share),
            at);
  return Settings::default_contact;
}

/// After `samples`.
scene::SampleSettings read_samples(Reader& in) {
  constexpr int limit = scene::SampleSettings::most_of_all;
  scene::SampleSettings samples;
  Span const at = in.next_span();
  samples.least = samples.most = in.integer("number of samples", 1, limit);
  if (in.has_value()) samples.most = in.integer("largest number of samples", 1, limit);
  if (samples.most < samples.least) {
    in.report(Severity::Error, "E0353",
              fmt::format("the largest number of samples, {}, is less than the first, {}",
                          samples.most, samples.least),
              at);
    samples.most = samples.least;
  }
  if (!in.accept("error")) return samples;
  Span const error_at = in.next_span();
  double const error = in.number("error of a pixel as displayed");
  if (error >= 0 && error <= 1)
    samples.error = error;
  else
    in.report(Severity::Error, "E0353",
              fmt::format("the error of a pixel as displayed is from 0 to 1, not {}", error),
              error_at);
  return samples;
}

bool read_item(Reader& in, Settings& settings) {
  if (in.open("spectral")) {
    read_spectral(in, settings.spectral);
    in.close();
  } else if (in.accept("assumed_gamma")) {
    read_gamma(in, settings);
  } else if (in.accept("adc_bailout")) {
    settings.adc_bailout = in.number("adc_bailout");
  } else if (in.accept("contact")) {
    settings.contact = read_contact(in);
  } else if (in.accept("samples")) {
    settings.samples = read_samples(in);
  } else if (in.accept("ambient_light")) {
    settings.ambient_light = read_rgb(in, "ambient_light");
  } else if (in.accept("irid_wavelength")) {
    settings.irid_wavelength = read_rgb(in, "irid_wavelength").rgb;
  } else if (in.accept("max_trace_level")) {
    settings.max_trace_level = in.integer("max_trace_level", 1, 256);
  } else if (in.accept("noise_generator")) {
    int const generator = in.integer("noise_generator", 1, 3);
    settings.noise_generator = generator;
    scene_state(in.interpreter()).default_noise_generator = generator;
  } else {
    return read_ignored(in) || read_global_light(in, settings);
  }
  return true;
}

} // namespace

Result<optics::Bands> make_bands(SpectralSettings const& spectral) {
  switch (spectral.spacing) {
  case SpectralSettings::Spacing::Hall:
    return optics::Bands::hall(spectral.bands, spectral.low_nm, spectral.high_nm);
  case SpectralSettings::Spacing::Boundaries:
    return optics::Bands::from_edges(spectral.boundaries_nm);
  case SpectralSettings::Spacing::Uniform:
    break;
  }
  return optics::Bands::uniform(spectral.bands, spectral.low_nm, spectral.high_nm);
}

void read_global_settings(Reader& in, Settings& settings) {
  while (!in.at_end())
    if (!read_item(in, settings)) reject(in, "a global setting");
}

} // namespace abbe::lang
