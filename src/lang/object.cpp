// SPDX-License-Identifier: MIT
#include "geometry/shapes/registry.hpp"
#include "lang/blocks.hpp"
#include "lang/file_shapes.hpp"

#include <fmt/format.h>

#include <string>
#include <unordered_map>

namespace abbe::lang {

scene::Object read_csg(Reader& in, scene::Object::Kind kind);

namespace {

using scene::Object;

geometry::ShapeKind const* find_shape(std::string_view word) {
  static auto const by_word = [] {
    std::unordered_map<std::string_view, geometry::ShapeKind const*> map;
    for (auto const& kind : geometry::shape_kinds()) map.emplace(kind.keyword, &kind);
    return map;
  }();
  auto const found = by_word.find(word);
  return found == by_word.end() ? nullptr : found->second;
}

std::optional<Object::Kind> csg_kind(std::string_view word) {
  if (word == "union" || word == "composite") return Object::Kind::Union;
  if (word == "merge") return Object::Kind::Merge;
  if (word == "intersection") return Object::Kind::Intersection;
  if (word == "difference") return Object::Kind::Difference;
  if (word == "light_group") return Object::Kind::LightGroup;
  return std::nullopt;
}

/// What stands for an object that could not be made: nothing, and no further errors.
Object nothing(Span span) {
  Object object;
  object.kind = Object::Kind::Union;
  object.span = span;
  return object;
}

Object read_shape(Reader& in, geometry::ShapeKind const& kind) {
  // POV-Ray lets the name of any object stand behind any shape's word.
  if (auto named = in.accept_value<Object>()) return *named;
  Span const span = in.block_span();
  Object object;
  std::optional<geometry::PlacedShape> placed = kind.read(in);
  if (!placed) {
    object = nothing(span);
  } else {
    object.shape = std::move(placed->shape);
    object.keyword = kind.keyword;
    object.placement = placed->placement;
  }
  object.span = span;
  object.face_textures = in.take_face_textures();
  return object;
}

/// `object { X ... }`
Object read_wrapped(Reader& in) {
  if (auto object = accept_object(in)) return std::move(*object);
  Span const span = in.block_span();
  if (in.at_end())
    in.report(Severity::Error, "E0250", "object {} must hold an object or the name of one", span);
  else
    reject(in, "an object or the name of one");
  while (!in.at_end()) in.skip();
  return nothing(span);
}

} // namespace

namespace {

/// A light can stand wherever an object can.
Object light_object(scene::Light light) {
  Object object = nothing(light.span);
  object.lights.push_back(std::move(light));
  return object;
}

Object only_light(Reader& in) {
  in.open_any();
  Object object = light_object(read_light(in));
  in.close();
  return object;
}

} // namespace

bool is_object_head(std::string_view head) {
  return head == "object" || csg_kind(head) || find_shape(head) || find_file_shape(head);
}

namespace {

/// What stands in the block before the modifiers.
Object read_body(Reader& in, std::string_view head) {
  if (auto const* shape = find_shape(head)) return read_shape(in, *shape);
  if (auto const* shape = find_file_shape(head)) {
    auto named = in.accept_value<Object>();
    return named ? *named : shape->read(in);
  }
  if (auto kind = csg_kind(head)) return read_csg(in, *kind);
  return read_wrapped(in);
}

} // namespace

scene::Object read_object(Reader& in, std::string_view head) {
  Object object = read_body(in, head);
  while (!in.at_end()) {
    if (read_object_modifier(in, object)) continue;
    if (in.next() == Next::Block && is_object_head(in.next_word())) {
      in.report(Severity::Error, "E0251",
                fmt::format("objects must stand before the modifiers of '{}'", head),
                in.next_span());
      in.skip();
      continue;
    }
    reject(in, fmt::format("a modifier of {}", head));
  }
  return object;
}

std::optional<scene::Object> accept_object(Reader& in) {
  if (in.next() == Next::Block) {
    // The reader forgets the word when the block opens: keep it.
    std::string const head(in.next_word());
    if (head == "light_source") return only_light(in);
    if (!is_object_head(head) || !in.open_any()) return std::nullopt;
    Object object = read_object(in, head);
    in.close();
    return object;
  }
  if (auto named = in.accept_value<Object>()) return *named;
  if (auto light = in.accept_value<scene::Light>()) return light_object(*light);
  return std::nullopt;
}

} // namespace abbe::lang
