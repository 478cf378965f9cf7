// SPDX-License-Identifier: MIT
#include "lang/attach.hpp"
#include "lang/not_rendered.hpp"

namespace abbe::lang {

namespace {

using scene::Object;

void read_objects(Reader& in, Few<Object>& into, std::string_view where) {
  std::size_t const before = into.size();
  bool rejected = false;
  while (!in.at_end()) {
    if (auto object = accept_object(in)) {
      deepen(*object);
      into.push_back(std::move(*object));
    } else {
      reject(in, "an object");
      rejected = true;
    }
  }
  if (into.size() == before && !rejected)
    in.report(Severity::Error, "E0250", std::string(where) + " holds no object", in.block_span());
}

/// `clipped_by { objects }`, `bounded_by { objects }` and the forms that name the other.
bool read_bounds(Reader& in, Object& object) {
  bool const clip = in.open("clipped_by");
  if (!clip && !in.open("bounded_by")) return false;
  std::string_view const other = clip ? "bounded_by" : "clipped_by";
  Few<Object>& into = clip ? object.clipped_by : object.bounded_by;
  Few<Object> const& from = clip ? object.bounded_by : object.clipped_by;
  if (in.accept(other)) {
    if (from.empty())
      in.report(Severity::Error, "E0252",
                "there is no " + std::string(other) + " before this to be named", in.block_span());
    into.append(from);
  } else {
    read_objects(in, into, clip ? "clipped_by" : "bounded_by");
  }
  in.close();
  return true;
}

bool read_flag(Reader& in, std::string_view word, std::optional<bool>& flag) {
  if (!in.accept(word)) return false;
  flag = in.boolean_or(true);
  return true;
}

bool read_flags(Reader& in, Object& object) {
  if (Span const at = in.next_span(); in.accept("uv_mapping")) {
    object.uv_mapping = in.boolean_or(true);
    if (object.texture || object.interior_texture)
      in.report(Severity::Error, "E0252", "uv_mapping must stand before the textures of an object",
                at);
    return true;
  }
  if (in.accept("no_shadow")) {
    object.no_shadow = true;
    return true;
  }
  if (object.kind == Object::Kind::LightGroup && in.accept("global_lights")) {
    object.global_lights = in.boolean_or(true);
    return true;
  }
  if (in.accept("inverse")) {
    object.inverse = !object.inverse;
    return true;
  }
  return read_flag(in, "hollow", object.hollow) || read_flag(in, "no_image", object.no_image)
         || read_flag(in, "no_reflection", object.no_reflection)
         || read_flag(in, "double_illuminate", object.double_illuminate);
}

/// Hints to POV-Ray's solvers and bounding, and flags for effects that do not exist here (whose own
/// blocks are reported): no picture depends on them.
bool read_hint(Reader& in) {
  for (std::string_view word : {"sturm", "hierarchy", "no_radiosity", "split_union"})
    if (in.accept(word)) {
      in.boolean_or(true);
      return true;
    }
  return false;
}

/// Is a block next that read_surface() takes? Nothing else needs to be asked for then.
bool at_surface(Reader& in) {
  if (in.next() != Next::Block) return false;
  std::string_view const word = in.next_word();
  return word == "texture" || word == "pigment" || word == "finish" || word == "normal"
         || word == "interior" || word == "interior_texture" || word == "material";
}

} // namespace

bool read_object_modifier(Reader& in, Object& object) {
  if (at_surface(in))
    return read_surface(in, {object.texture, object.interior_texture, object.interior});
  geometry::Transform transform;
  Span const at = in.next_span();
  if (read_transform(in, transform)) {
    transform_object(object, transform);
    geometry::Transform placed = object.placement;
    check_range(in, placed, at);
    object.placement = placed;
    return true;
  }
  // For the words that it asks for: "did you mean".
  Surface const surface{object.texture, object.interior_texture, object.interior};
  return read_surface(in, surface) || read_flags(in, object) || read_bounds(in, object)
         || read_hint(in) || read_object_light(in, object);
}

namespace {

/// @param move moves the layers of a texture
template <class Move>
void transform_with(Object& object, geometry::Transform const& transform, Move const& move) {
  if (transform.none()) return;
  object.placement = object.placement.then(transform);
  if (!object.uv_mapping) {
    move(object.texture);
    move(object.interior_texture);
  }
  for (scene::Layers& layers : object.face_textures) transform_layers(layers, transform);
  for (Object& clip : object.clipped_by) transform_object(clip, transform);
  for (Object& bound : object.bounded_by) transform_object(bound, transform);
  for (scene::Light& light : object.lights) transform_light(light, transform);
}

} // namespace

void transform_object(Object& object, geometry::Transform const& transform) {
  transform_with(object, transform, [&](scene::SharedLayers& layers) {
    if (layers) transform_layers(*layers, transform);
  });
}

void transform_settled(Object& object, geometry::Transform const& transform) {
  transform_with(object, transform, [&](scene::SharedLayers& layers) {
    if (layers && !is_plain(layers)) transform_layers(*layers, transform);
  });
}

} // namespace abbe::lang
