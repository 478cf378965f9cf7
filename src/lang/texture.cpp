// SPDX-License-Identifier: MIT
#include "lang/attach.hpp"
#include "lang/blocks.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace abbe::lang {

void transform_layers(scene::Layers& layers, geometry::Transform const& transform) {
  for (scene::Texture& layer : layers) layer.placement = layer.placement.then(transform);
}

void set_pigment(scene::Texture& layer, scene::Pigment pigment) {
  if (!layer.placement.identity()) transform_pigment(pigment, layer.placement.inverse());
  layer.pigment = std::move(pigment);
}

namespace {

/// `checker texture{} ...`, `bozo texture_map{}`: a texture that begins with a pattern.
bool reject_patterned(Reader& in) {
  std::string_view const word = in.next_word();
  bool const pattern = std::ranges::any_of(texture::pattern_kinds(),
                                           [&](auto const& kind) { return kind.keyword == word; })
                       || word == "object";
  if (!pattern) return false;
  in.report(
      Severity::Error, "E0901",
      fmt::format("a texture with a pattern ('{}') is not supported yet; a pigment with one is",
                  word),
      in.next_span());
  while (!in.at_end()) in.skip();
  return true;
}

bool read_named(Reader& in, scene::Layers& layers, bool first) {
  Span const at = in.next_span();
  if (auto named = in.accept_value<scene::Layers>()) {
    if (!first)
      in.report(Severity::Error, "E0251",
                "the name of a texture must be the first item of texture {}", at);
    layers = *named;
  } else if (auto pigment = in.accept_value<scene::Pigment>()) {
    set_pigment(layers.back(), *pigment);
  } else if (auto finish = in.accept_value<scene::Finish>()) {
    layers.back().finish = finish;
  } else {
    return false;
  }
  return true;
}

} // namespace

bool read_texture_part(Reader& in, scene::Texture& layer) {
  if (in.open("pigment")) {
    bool const plain = !layer.pigment.pattern;
    transform_pigment(layer.pigment, layer.placement);
    read_pigment_of_texture(in, layer.pigment,
                            plain ? layer.placement.transform() : geometry::Transform{});
    in.close();
    // Where the layer was moved to stands in its pattern now.
    if (!plain || layer.pigment.pattern) layer.placement = {};
  } else if (in.open("finish")) {
    read_finish(in, *layer.finish);
    in.close();
  } else {
    return false;
  }
  return true;
}

scene::SharedLayers read_texture(Reader& in) {
  Span const span = in.block_span();
  auto const placed = [](scene::Texture const& layer) { return layer.span.valid(); };
  auto const named = in.accept_value<scene::Layers>();
  if (named && in.at_end() && std::ranges::all_of(*named, placed)) return named;
  scene::Layers layers = named ? *named : scene::Layers(1, default_texture(in, span));
  for (bool first = !named; !in.at_end(); first = false) {
    geometry::Transform transform;
    if (read_texture_part(in, layers.back()) || read_named(in, layers, first)) continue;
    Span const at = in.next_span();
    if (read_transform(in, transform))
      transform_layers(layers, transform);
    else if (in.accept("no_bump_scale"))
      in.report(Severity::Warning, "E0257", "'no_bump_scale' has no effect without bumps", at);
    else if (!reject_patterned(in))
      reject(in, "a texture item");
  }
  for (scene::Texture& layer : layers)
    if (!layer.span.valid()) layer.span = span;
  return layers;
}

} // namespace abbe::lang
