// SPDX-License-Identifier: MIT
#include "lang/image_pattern.hpp"

#include "image/colour.hpp"
#include "image/texels.hpp"
#include "lang/blocks.hpp"
#include "lang/function.hpp"
#include "lang/load_file.hpp"
#include "lang/scene_patterns.hpp"
#include "simd/math.hpp"
#include "texture/patterns/image.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace abbe::lang {

namespace {

using image::Texels;
using texture::ImagePattern, texture::Picture;
using Use = ImagePattern::Use;

constexpr std::string_view type_words[] = {"png", "gif", "tga", "jpeg", "tiff", "iff", "ppm",
                                           "pgm", "pot", "sys", "exr",  "hdr",  "bmp"};

/// How codes of a file become numbers of the scene's working space.
struct Gamma {
  double file = 0;    ///< as Texels::gamma says it
  double working = 0; ///< power that decodes the working space; below 0: sRGB; 0: codes are taken
  double operator()(double code) const {
    if (working == 0) return code;
    double const light = file < 0 ? image::srgb_decode(code) : simd::pow(code, file);
    return working < 0 ? image::srgb_encode(light) : simd::pow(light, 1 / working);
  }
};

/// A Gamma that knows codes that come again: most files have 256 of them.
class KnownGamma {
public:
  explicit KnownGamma(Gamma const& gamma) : gamma_(gamma) {}
  float operator()(float code) {
    auto const bits = std::bit_cast<std::uint32_t>(code);
    Known& known = known_[(bits * 0x9e3779b1U) >> 22];
    if (known.bits != bits) known = {bits, static_cast<float>(gamma_(static_cast<double>(code)))};
    return known.value;
  }

private:
  struct Known {
    std::uint32_t bits = 0xffffffffU; ///< of no number
    float value = 0;
  };
  Gamma gamma_;
  std::vector<Known> known_ = std::vector<Known>(1024);
};

Gamma gamma_of(Reader& in, Texels const& texels, double written, bool colours) {
  SceneState const& state = scene_state(in.interpreter());
  scene::Settings const& settings = state.scene.settings;
  bool const newer = state.effective_version >= 3.7;
  double const usual = newer && texels.default_gamma != 0 ? texels.default_gamma : 0;
  Gamma out;
  out.working = settings.assumed_gamma_srgb ? -1 : settings.assumed_gamma.value_or(newer ? 1 : 0);
  out.file = written != 0        ? written
             : texels.gamma != 0 ? texels.gamma
             : usual != 0        ? usual
                                 : out.working;
  if (out.file == out.working || (!colours && written == 0)) out.working = 0;
  return out;
}

/// The picture that a function is: its value at x and y from 0 to 1, the first row at y = 0, in the
/// 16 bits of a code that POV-Ray keeps of it.
std::optional<Texels> read_function(Reader& in) {
  Span const at = in.next_span();
  auto const function = std::get<std::shared_ptr<FunctionValue>>(in.identifier()->any);
  in.take();
  char const* wrong = nullptr;
  if (!function->unsupported.empty())
    in.report(Severity::Error, "E0901", function->unsupported, at);
  else if (function->picture_width == 0)
    wrong = "a function that is a picture has a size: 'function 100, 80 { ... }'";
  else if (function->parameters != 3)
    wrong = "a function that is a picture is one of x, y and z";
  if (wrong) in.report(Severity::Error, "E0622", wrong, at);
  if (wrong || !function->unsupported.empty()) return std::nullopt;
  auto out = image::make_texels(function->picture_width, function->picture_height, "function");
  if (!out) return std::nullopt;
  constexpr double most = 65535;
  auto const code = [](double value) {
    double const whole = std::trunc(value * most);
    if (!std::isfinite(whole)) return 0.0F;
    return static_cast<float>((whole - 65536 * std::floor(whole / 65536)) / most);
  };
  out->has_alpha = function->vector;
  float* to = out->rgba.data();
  for (int y = 0; y < out->height; ++y)
    for (int x = 0; x < out->width; ++x, to += 4) {
      double const place[] = {x / std::max(1.0, out->width - 1.0),
                              y / std::max(1.0, out->height - 1.0), 0};
      Numeric const value = evaluate_function(*function, place);
      for (std::size_t c = 0; c < 3; ++c) to[c] = code(value.c[function->vector ? c : 0]);
      if (function->vector) to[3] = code(1 - value.promoted(5).c[4]);
    }
  return std::move(*out);
}

std::optional<Texels> read_file(Reader& in) {
  std::string_view kind;
  for (std::string_view const word : type_words) {
    if (!in.accept(word)) continue;
    kind = word;
    break;
  }
  Span const at = in.next_span();
  std::string const name = in.path("the file of a picture");
  auto const bytes = load_picture(in.interpreter(), name, kind);
  if (!bytes) {
    in.report(Severity::Error, bytes.error().code, bytes.error().message, at);
    return std::nullopt;
  }
  auto texels = image::read_texels(*bytes, name);
  if (texels) return std::move(*texels);
  in.report(Severity::Error, texels.error().code, texels.error().message, at);
  return std::nullopt;
}

/// `filter i, f`, `transmit all f`: of a palette's entry or of all.
bool read_passing(Reader& in, Texels const& texels, Picture& picture) {
  bool const filter = in.accept("filter");
  if (!filter && !in.accept("transmit")) return false;
  bool const all = in.accept("all");
  int const number = all ? 0 : in.integer("number of a palette's entry", 0, 65535);
  auto const share = static_cast<float>(in.number("share of light"));
  for (std::size_t k = 0; k < picture.texels.size(); ++k) {
    if (!all && (texels.index.empty() || texels.index[k] != number)) continue;
    (filter ? picture.texels[k].filter : picture.texels[k].transmit) += share;
  }
  return true;
}

/// @param divide colours are those of light, which alpha has weakened
std::shared_ptr<Picture> picture_of(Texels const& texels, Gamma const& gamma, bool divide) {
  auto out = std::make_shared<Picture>();
  out->width = texels.width;
  out->height = texels.height;
  out->index = texels.index;
  out->texels.resize(texels.rgba.size() / 4);
  KnownGamma light(gamma);
  for (std::size_t k = 0; k < out->texels.size(); ++k) {
    float const* const from = &texels.rgba[4 * k];
    float const share = divide && from[3] > 0 ? from[3] : 1;
    out->texels[k] = {light(from[0]) / share, light(from[1]) / share, light(from[2]) / share, 0,
                      1 - from[3]};
  }
  return out;
}

double read_gamma(Reader& in) {
  if (!in.accept("gamma")) return 0;
  if (in.accept("srgb")) return -1;
  Span const at = in.next_span();
  double const value = in.number("gamma");
  if (value > 0) return value;
  in.report(Severity::Error, "E0353", "gamma must be positive", at);
  return 1;
}

} // namespace

std::optional<Texels> read_texels_source(Reader& in) {
  return starts_function(in) ? read_function(in) : read_file(in);
}

namespace {

/// The block's picture and items. What is wrong is a picture of one black pixel.
std::shared_ptr<texture::Pattern const> read_picture(Reader& in, Use use, bool close) {
  bool const file = !starts_function(in);
  auto texels = read_texels_source(in);
  if (!texels) texels = std::move(*image::make_texels(1, 1, ""));
  double written = 0;
  bool divide = texels->premultiplied;
  while (file && !in.at_end()) {
    if (double const gamma = read_gamma(in); gamma != 0)
      written = gamma;
    else if (in.accept("premultiplied"))
      divide = in.number("premultiplied") != 0;
    else
      break;
  }
  auto picture = picture_of(*texels, gamma_of(in, *texels, written, use == Use::Colours),
                            divide && texels->has_alpha);
  std::shared_ptr<texture::Pattern const> pattern = std::make_shared<ImagePattern>(picture, use);
  while (!in.at_end()) {
    if (auto changed = pattern->read_item(in))
      pattern = std::move(changed);
    else if (!read_passing(in, *texels, *picture)) {
      if (!close) break;
      reject(in, "an item of a picture");
    }
  }
  if (close) in.close();
  return pattern;
}

} // namespace

std::shared_ptr<texture::Pattern const> read_image_map(Reader& in, bool&) {
  in.open("image_map");
  return read_picture(in, Use::Colours, true);
}
std::shared_ptr<texture::Pattern const> read_image_pattern(Reader& in, bool&) {
  in.open("image_pattern");
  return read_picture(in, Use::Values, true);
}
std::shared_ptr<texture::Pattern const> read_bump_map(Reader& in, bool&) {
  in.open("bump_map");
  return read_picture(in, Use::Bumps, true);
}
std::shared_ptr<texture::Pattern const> read_material_map(Reader& in, bool& encloses) {
  in.open("material_map");
  encloses = true;
  return read_picture(in, Use::Numbers, false);
}

} // namespace abbe::lang
