// SPDX-License-Identifier: MIT
#include "geometry/shapes/registry.hpp"
#include "lang/blocks.hpp"
#include "lang/file_shapes.hpp"
#include "lang/not_rendered.hpp"
#include "lang/unsupported.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>
#include <vector>

namespace abbe::lang {

namespace {

template <class T>
Value shared(T value, Span span) {
  return Value{std::shared_ptr<T const>(std::make_shared<T>(std::move(value))), span};
}

SceneState& state_of(Reader& in) {
  return scene_state(in.interpreter());
}

// ------------------------------------------------------------------------------- reading values

Value object_value(Reader& in, std::string_view head) {
  Span const span = in.block_span();
  return shared(read_object(in, head), span);
}
Value light_value(Reader& in, std::string_view) {
  Span const span = in.block_span();
  return shared(read_light(in), span);
}
Value camera_value(Reader& in, std::string_view) {
  Span const span = in.block_span();
  return shared(read_camera(in), span);
}
Value sky_value(Reader& in, std::string_view) {
  Span const span = in.block_span();
  return shared(read_sky_sphere(in), span);
}
Value pigment_value(Reader& in, std::string_view) {
  Span const span = in.block_span();
  scene::Pigment pigment = default_texture(in, span).pigment;
  read_pigment(in, pigment);
  return shared(std::move(pigment), span);
}
Value normal_value(Reader& in, std::string_view) {
  Span const span = in.block_span();
  scene::Normal normal;
  if (auto const& known = default_texture(in, span).normal) normal = *known;
  read_normal(in, normal, {});
  return shared(std::move(normal), span);
}
Value finish_value(Reader& in, std::string_view) {
  Span const span = in.block_span();
  scene::Finish finish = *default_texture(in, span).finish;
  read_finish(in, finish);
  return shared(std::move(finish), span);
}
Value texture_value(Reader& in, std::string_view) {
  Span const span = in.block_span();
  return Value{read_texture(in).held(), span};
}
Value interior_value(Reader& in, std::string_view) {
  Span const span = in.block_span();
  scene::Interior interior;
  read_interior(in, interior);
  return shared(std::move(interior), span);
}
Value material_value(Reader& in, std::string_view) {
  Span const span = in.block_span();
  return shared(read_material(in), span);
}
Value transform_value(Reader& in, std::string_view) {
  Span const span = in.block_span();
  return shared(read_transform_block(in), span);
}
Value color_map_value(Reader& in, std::string_view) {
  Span const span = in.block_span();
  return shared(MapValue{read_color_map(in)}, span);
}
Value pigment_map_value(Reader& in, std::string_view) {
  Span const span = in.block_span();
  return shared(MapValue{read_pigment_map(in)}, span);
}
Value normal_map_value(Reader& in, std::string_view) {
  Span const span = in.block_span();
  return shared(NormalMapValue{read_normal_map(in)}, span);
}
Value slope_map_value(Reader& in, std::string_view) {
  Span const span = in.block_span();
  return shared(SlopeMapValue{read_slope_map(in)}, span);
}
Value texture_map_value(Reader& in, std::string_view) {
  Span const span = in.block_span();
  return shared(TextureMapValue{read_texture_map(in)}, span);
}
Value media_value(Reader& in, std::string_view) {
  Span const span = in.block_span();
  read_media(in);
  return shared(MediaValue{}, span);
}
Value fog_value(Reader& in, std::string_view) {
  Span const span = in.block_span();
  return shared(read_fog(in), span);
}
Value rainbow_value(Reader& in, std::string_view) {
  Span const span = in.block_span();
  return shared(read_rainbow(in), span);
}
Value density_value(Reader& in, std::string_view) {
  Span const span = in.block_span();
  return shared(read_density(in), span);
}
Value density_map_value(Reader& in, std::string_view) {
  Span const span = in.block_span();
  return shared(MapValue{read_density_map(in)}, span);
}
/// A spectrum is a colour: it can be scaled and stand wherever a colour may.
Value spectrum_value(Reader& in, std::string_view) {
  Span const span = in.block_span();
  return Value{scene::Colour{Vec3(1), 0, 0, read_spectrum(in)}, span};
}
/// A glass that could not be made was reported: it stands for nothing, silently.
Value glass_value(Reader& in, std::string_view) {
  Span const span = in.block_span();
  return Value{read_glass(in), span};
}
Value settings_value(Reader& in, std::string_view) {
  read_global_settings(in, state_of(in).scene.settings);
  return {};
}
Value effects_value(Reader& in, std::string_view) {
  read_effects(in, state_of(in).scene.settings.effects);
  return {};
}
Value background_value(Reader& in, std::string_view) {
  state_of(in).scene.background = read_colour(in, "the background");
  state_of(in).scene.has_background = true;
  while (!in.at_end()) reject(in, "the end of background");
  return {};
}

/// A block that is not supported yet where a value is wanted. What is declared as a shape can then
/// be used without a further message.
Value unsupported_value(Reader& in, std::string_view head) {
  Span const span = in.block_span();
  report_unsupported(in, head, span);
  while (!in.at_end()) in.skip();
  if (!is_unsupported_shape(head)) return Value{Unsupported{}, span};
  scene::Object nothing;
  nothing.kind = scene::Object::Kind::Union;
  nothing.span = span;
  return shared(std::move(nothing), span);
}

// -------------------------------------------------------------------------- placing into the scene

template <class T>
T const& held(Value const& value) {
  return **std::get_if<std::shared_ptr<T const>>(&value.any);
}

void place_object_value(Value&& value, Reader& in) {
  auto const& held = std::get<std::shared_ptr<scene::Object const>>(value.any);
  // One that nothing else holds is moved into the scene; shared() made it, not const.
  if (held.use_count() == 1)
    place_object(std::move(*std::const_pointer_cast<scene::Object>(held)), in);
  else
    place_object(*held, in);
}
void place_light_value(Value&& value, Reader& in) {
  place_light(held<scene::Light>(value), in);
}
void place_fog(Value&& value, Reader& in) {
  if (held<scene::Fog>(value).distance > 0)
    state_of(in).scene.fogs.push_back(held<scene::Fog>(value));
}
void place_rainbow(Value&& value, Reader& in) {
  scene::Rainbow const& rainbow = held<scene::Rainbow>(value);
  if (rainbow.distance > 0 && rainbow.width_deg > 0 && !rainbow.entries.empty())
    state_of(in).scene.rainbows.push_back(rainbow);
}
void place_camera(Value&& value, Reader& in) {
  SceneState& state = state_of(in);
  if (state.cameras++ > 0)
    in.report(Severity::Warning, "E0254", "more than one camera: the last one is used",
              value.declared_at);
  state.scene.camera = held<scene::Camera>(value);
}
void place_sky(Value&& value, Reader& in) {
  state_of(in).scene.sky_sphere = held<scene::SkySphere>(value);
}
void place_nothing(Value&&, Reader&) {}

constexpr BlockKind kinds_without_shapes[] = {
    {"background", background_value, place_nothing},
    {"camera", camera_value, place_camera},
    {"color_map", color_map_value, nullptr},
    {"colour_map", color_map_value, nullptr},
    {"composite", object_value, place_object_value},
    {"density", density_value, nullptr},
    {"density_map", density_map_value, nullptr},
    {"difference", object_value, place_object_value},
    {"effects", effects_value, place_nothing},
    {"finish", finish_value, nullptr},
    {"fog", fog_value, place_fog},
    {"glass", glass_value, nullptr},
    {"global_settings", settings_value, place_nothing},
    {"interior", interior_value, nullptr},
    {"intersection", object_value, place_object_value},
    {"light_group", object_value, place_object_value},
    {"light_source", light_value, place_light_value},
    {"material", material_value, nullptr},
    {"media", media_value, place_nothing},
    {"merge", object_value, place_object_value},
    {"normal", normal_value, nullptr},
    {"normal_map", normal_map_value, nullptr},
    {"object", object_value, place_object_value},
    {"pigment", pigment_value, nullptr},
    {"pigment_map", pigment_map_value, nullptr},
    {"rainbow", rainbow_value, place_rainbow},
    {"sky_sphere", sky_value, place_sky},
    {"slope_map", slope_map_value, nullptr},
    {"spectrum", spectrum_value, nullptr},
    {"texture", texture_value, nullptr},
    {"texture_map", texture_map_value, nullptr},
    {"transform", transform_value, nullptr},
    {"union", object_value, place_object_value},
};

std::vector<BlockKind> const& all_kinds() {
  static std::vector<BlockKind> const kinds = [] {
    std::vector<BlockKind> all(std::begin(kinds_without_shapes), std::end(kinds_without_shapes));
    for (auto const& shape : geometry::shape_kinds())
      all.push_back({shape.keyword, object_value, place_object_value});
    for (auto const& shape : file_shapes())
      all.push_back({shape.keyword, object_value, place_object_value});
    auto const known = all.size();
    for (std::string_view const word : unsupported_words())
      if (std::ranges::find(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(known), word,
                            &BlockKind::head)
          == all.begin() + static_cast<std::ptrdiff_t>(known))
        all.push_back({word, unsupported_value, nullptr});
    std::ranges::sort(all, {}, &BlockKind::head);
    return all;
  }();
  return kinds;
}

void read_block_statement(Reader& in) {
  std::string const head(in.next_word());
  BlockKind const* const kind = find_block_kind(head);
  if (!kind || kind->read == unsupported_value)
    return reject(in, "an object, a setting or a directive");
  if (!kind->place) {
    in.report(Severity::Error, "E0255",
              fmt::format("'{}' cannot stand alone: it belongs inside an object or behind #declare",
                          head),
              in.next_span());
    return in.skip();
  }
  in.open_any();
  Value value = kind->read(in, head);
  in.close();
  kind->place(std::move(value), in);
}

bool place_named(Reader& in) {
  if (auto object = in.accept_value<scene::Object>())
    place_object(*object, in);
  else if (auto light = in.accept_value<scene::Light>())
    place_light(*light, in);
  else
    return false;
  return true;
}

} // namespace

std::span<BlockKind const> block_kinds() {
  return all_kinds();
}

BlockKind const* find_block_kind(std::string_view head) {
  static auto const by_head = [] {
    std::unordered_map<std::string_view, BlockKind const*> map;
    for (auto const& kind : all_kinds()) map.emplace(kind.head, &kind);
    return map;
  }();
  auto const found = by_head.find(head);
  return found == by_head.end() ? nullptr : found->second;
}

void read_statement(Reader& in) {
  if (in.next() == Next::Block) return read_block_statement(in);
  if (place_named(in)) return;
  if (in.accept("glass_catalog")) return read_glass_catalog(in);
  if (in.accept("max_trace_level")) {
    state_of(in).scene.settings.max_trace_level = in.integer("max_trace_level", 1, 256);
    return;
  }
  if (Span const at = in.next_span(); in.accept("effects")) {
    scene::EffectSettings& effects = state_of(in).scene.settings.effects;
    effects.strict = true;
    effects.strict_span = at;
    if (!in.accept("strict")) reject(in, "'strict' or a block behind 'effects'");
    return;
  }
  reject(in, "an object, a setting or a directive");
}

} // namespace abbe::lang
