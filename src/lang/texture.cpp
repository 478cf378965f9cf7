// SPDX-License-Identifier: MIT
#include "lang/attach.hpp"
#include "lang/texture_map.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace abbe::lang {

bool is_plain(scene::SharedLayers const& layers) {
  return std::ranges::all_of(*layers, [](scene::Texture const& layer) {
    return !layer.map && !layer.normal && !layer.uv && !layer.pigment.pattern;
  });
}

void transform_layers(scene::Layers& layers, geometry::Transform const& transform) {
  for (scene::Texture& layer : layers)
    if (!layer.uv) layer.placement = layer.placement.then(transform);
}

void set_pigment(scene::Texture& layer, scene::Pigment pigment) {
  if (!layer.placement.identity()) transform_pigment(pigment, layer.placement.inverse());
  layer.pigment = std::move(pigment);
}

/// The same of a normal.
void set_normal(scene::Texture& layer, std::shared_ptr<scene::Normal const> normal) {
  if (!layer.placement.identity()) transform_normal(normal, layer.placement.inverse());
  layer.normal = std::move(normal);
}

namespace {

/// `no_bump_scale` behind what it is for.
void keep_bumps(Reader& in, scene::Layers& layers, Span at) {
  bool any = false;
  for (scene::Texture& layer : layers) {
    if (!layer.normal) continue;
    auto normal = std::make_shared<scene::Normal>(*layer.normal);
    normal->no_bump_scale = true;
    layer.normal = std::move(normal);
    any = true;
  }
  if (!any)
    in.report(Severity::Warning, "E0257", "'no_bump_scale' has no effect without bumps", at);
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
  } else if (auto normal = in.accept_value<scene::Normal>()) {
    set_normal(layers.back(), std::move(normal));
  } else if (auto finish = in.accept_value<scene::Finish>()) {
    layers.back().finish = finish;
  } else {
    return false;
  }
  return true;
}

} // namespace

namespace {

/// What a patterned texture has not got. @return true: it was reported
bool reject_part(Reader& in, bool patterned) {
  std::string_view const word = in.next_word();
  bool const part =
      in.next() == Next::Block && (word == "pigment" || word == "normal" || word == "finish");
  if (!patterned || !part) return false;
  in.report(Severity::Error, "E0252",
            fmt::format("a patterned texture has no '{}' of its own: change the textures that it "
                        "is made of",
                        word),
            in.next_span());
  in.skip();
  return true;
}

} // namespace

bool read_texture_part(Reader& in, scene::Texture& layer) {
  if (reject_part(in, layer.map != nullptr)) return true;
  if (in.open("normal")) {
    transform_normal(layer.normal, layer.placement);
    scene::Normal normal = layer.normal ? *layer.normal : scene::Normal{};
    read_normal(in, normal, {}); // a new one stays where it is
    in.close();
    set_normal(layer, std::make_shared<scene::Normal const>(std::move(normal)));
  } else if (in.open("pigment")) {
    bool const plain = !layer.pigment.pattern;
    transform_pigment(layer.pigment, layer.placement);
    read_pigment_of_texture(in, layer.pigment,
                            plain ? layer.placement.transform() : geometry::Transform{});
    in.close();
    // Where the layer was moved to stands in its pattern now.
    if (!plain || layer.pigment.pattern) {
      transform_normal(layer.normal, layer.placement);
      layer.placement = {};
    }
  } else if (in.open("finish")) {
    read_finish(in, *layer.finish);
    in.close();
  } else {
    return false;
  }
  return true;
}

namespace {

/// A patterned texture as it goes on: its pattern has been moved with it.
TextureMapDraft draft_of(scene::Layers& layers) {
  if (layers.size() != 1 || !layers.front().map) return TextureMapDraft(nullptr);
  scene::Texture& layer = layers.front();
  auto map = std::make_shared<scene::TextureMap>(*layer.map);
  transform_pattern(map->pattern, layer.placement);
  layer.placement = {};
  return TextureMapDraft(std::move(map));
}

} // namespace

scene::SharedLayers read_texture(Reader& in) {
  Span const span = in.block_span();
  auto const placed = [](scene::Texture const& layer) { return layer.span.valid(); };
  auto const named = in.accept_value<scene::Layers>();
  if (named && in.at_end() && std::ranges::all_of(*named, placed)) return named;
  scene::Layers layers = named ? *named : scene::Layers(1, default_texture(in, span));
  bool uv = false;
  TextureMapDraft map = draft_of(layers);
  for (bool first = !named; !in.at_end(); first = false) {
    geometry::Transform transform;
    if (in.accept("uv_mapping")) {
      uv = in.boolean_or(true);
      continue;
    }
    if (map.begun() ? map.read(in) : read_texture_part(in, layers.back()) || map.read(in)) continue;
    if (reject_part(in, map.begun())) continue;
    if (read_named(in, layers, first)) {
      map = draft_of(layers);
      continue;
    }
    Span const at = in.next_span();
    if (read_transform(in, transform))
      transform_layers(layers, transform);
    else if (in.accept("no_bump_scale"))
      keep_bumps(in, layers, at);
    else
      reject(in, "a texture item");
  }
  if (map.begun()) {
    layers.resize(1);
    layers.front().map = map.finish(in, span);
    layers.front().normal = nullptr;
  }
  for (scene::Texture& layer : layers) {
    if (!layer.span.valid()) layer.span = span;
    layer.uv = layer.uv || uv;
  }
  return layers;
}

} // namespace abbe::lang
