// SPDX-License-Identifier: MIT
#include "lang/attach.hpp"

#include "geometry/shape.hpp"
#include "geometry/shapes/height_field.hpp"

#include <fmt/format.h>

#include <limits>

namespace abbe::lang {

namespace {

using scene::Object;

std::string_view kind_name(Object::Kind kind) {
  switch (kind) {
  case Object::Kind::Shape:
    return "shape";
  case Object::Kind::Union:
    return "union";
  case Object::Kind::Merge:
    return "merge";
  case Object::Kind::Intersection:
    return "intersection";
  case Object::Kind::Difference:
    return "difference";
  case Object::Kind::LightGroup:
    return "light_group";
  }
  return "";
}

void warn_about_patch(Reader& in, Object::Kind kind, Object const& child) {
  if (kind == Object::Kind::Union || kind == Object::Kind::LightGroup
      || child.kind != Object::Kind::Shape || !child.shape || child.shape->solid())
    return;
  in.report(
      Severity::Warning, "E0253",
      fmt::format("this surface has no inside: its part in the {} is undefined", kind_name(kind)),
      child.span);
}

} // namespace

void deepen(Object& object) {
  if (auto const* field = dynamic_cast<geometry::HeightField const*>(object.shape.get()))
    if (!field->form().deep) object.shape = field->deepened();
  for (Object& child : object.children) deepen(child);
}

namespace {

/// Lights are no operands.
void add(Object& object, Object&& child) {
  bool const light = child.kind == Object::Kind::Union && child.children.empty();
  if (light) object.lights.append(child.lights);
  if (!light || child.lights.empty()) object.children.push_back(std::move(child));
}

/// A block that is neither an object nor a modifier: most likely a misspelt object.
bool is_unknown_block(Reader& in) {
  if (in.next() != Next::Block) return false;
  std::string_view const head = in.next_word();
  return !find_block_kind(head) && head != "clipped_by" && head != "bounded_by"
         && head != "interior_texture" && head != "photons" && head != "radiosity";
}

} // namespace

/// Children, then (read by the caller) modifiers.
scene::Object read_csg(Reader& in, Object::Kind kind) {
  Object object;
  object.kind = kind;
  object.span = in.block_span();
  bool failed = false;
  while (!in.at_end()) {
    if (auto child = accept_object(in)) {
      warn_about_patch(in, kind, *child);
      if (kind != Object::Kind::Union) deepen(*child);
      add(object, std::move(*child));
    } else if (in.next() == Next::Block && skip_unsupported(in)) {
      failed = true;
    } else if (is_unknown_block(in)) {
      in.unexpected("an object");
      failed = true;
    } else {
      break;
    }
  }
  if (object.children.empty() && object.lights.empty() && !failed)
    in.report(Severity::Warning, "E0250",
              fmt::format("{} {{}} holds no objects: nothing is drawn", kind_name(kind)),
              object.span);
  return object;
}

namespace {

/// What a part takes from the combination it stands in.
struct Inherited {
  scene::SharedLayers texture, interior_texture;
  std::shared_ptr<scene::Interior const> interior;
  std::optional<bool> hollow;
  bool uv_mapping = false; ///< of the textures
  std::uint16_t light_group = 0;
  bool no_shadow = false, no_image = false, no_reflection = false, double_illuminate = false;
  scene::Throws throws;
};

/// A glass without a texture is clear, not black.
scene::Texture clear_texture(Span span) {
  scene::Texture texture;
  texture.span = span;
  texture.pigment.span = span;
  texture.pigment.colour = {Vec3(1), 0, 1, nullptr};
  texture.finish->ambient.rgb = Vec3(0);
  texture.finish->diffuse = 0;
  return texture;
}

/// What a part says itself goes before what the combination says.
scene::Throws inherit_throws(scene::Throws own, scene::Throws const& from) {
  using scene::Choice;
  for (auto const item :
       {&scene::Throws::refraction, &scene::Throws::reflection, &scene::Throws::cast})
    if (own.*item == Choice::Unset) own.*item = from.*item;
  own.target = own.target || from.target;
  own.collect = own.collect && from.collect;
  own.pass_through = own.pass_through || from.pass_through;
  return own;
}

bool inherit_flag(std::optional<bool>& own, bool from_parent) {
  own = own.value_or(false) || from_parent;
  return *own;
}

Inherited inherit(Object& object, Inherited const& from) {
  Inherited to;
  if (!object.interior)
    object.interior = from.interior;
  else if (object.interior == from.interior && !object.interior->glass) // a copy, as in POV-Ray
    object.interior = std::make_shared<scene::Interior>(*object.interior);
  if (!object.hollow) object.hollow = from.hollow;
  to.interior = object.interior;
  to.hollow = object.hollow;
  to.no_shadow = inherit_flag(object.no_shadow, from.no_shadow);
  to.no_image = inherit_flag(object.no_image, from.no_image);
  to.no_reflection = inherit_flag(object.no_reflection, from.no_reflection);
  to.light_group = from.light_group;
  to.throws = object.throws = inherit_throws(object.throws, from.throws);
  to.double_illuminate = inherit_flag(object.double_illuminate, from.double_illuminate);
  // An own texture is complete: nothing of the parent's, not even its inner one, is added.
  bool const own = object.texture.has_value();
  to.texture = own ? object.texture : from.texture;
  to.uv_mapping = own ? object.uv_mapping : from.uv_mapping || object.uv_mapping;
  to.interior_texture =
      own || object.interior_texture ? object.interior_texture : from.interior_texture;
  return to;
}

/// A polygon, or a flat box or prism: nothing is entered, so that light does not bend or fade. (A
/// triangle of a mesh is part of a surface.)
void warn_about_interior(Reader& in, Object const& object) {
  bool const patch =
      object.keyword == "polygon" || object.keyword == "box" || object.keyword == "prism";
  if (!patch || !object.interior || object.shape->solid()) return;
  auto const& interior = *object.interior;
  if (!interior.glass && interior.ior == 1 && interior.fade_distance == 0) return;
  in.report(Severity::Warning, "E0253",
            "this surface has no inside: light passes it as if it had no interior", object.span);
}

void settle_leaf(Object& object, Inherited const& with, Reader& in) {
  if (!object.texture) object.texture = with.texture;
  if (!object.interior_texture) object.interior_texture = with.interior_texture;
  if (auto const* field = dynamic_cast<geometry::HeightField const*>(object.shape.get());
      field != nullptr && field->form().smooth)
    object.shape = field->placed(object.placement.transform().inverse_linear);
  warn_about_interior(in, object);
  if (with.uv_mapping)
    for (scene::SharedLayers* const layers : {&object.texture, &object.interior_texture})
      if (layers->has_value())
        for (scene::Texture& layer : **layers) layer.uv = true;
  if (object.texture) return;
  bool const glass = object.interior && object.interior->glass;
  object.texture =
      scene::Layers(1, glass ? clear_texture(object.span) : default_texture(in, object.span));
}

/// Clipping objects are geometry only.
void flatten_clip(Object& clip) {
  clip.texture.reset();
  clip.interior_texture.reset();
  clip.face_textures.clear();
  clip.interior.reset();
  clip.bounded_by.clear();
  clip.lights.clear();
  geometry::Transform const placement = clip.placement;
  for (Object& child : clip.children) {
    transform_object(child, placement);
    flatten_clip(child);
  }
  for (Object& inner : clip.clipped_by) flatten_clip(inner);
  if (clip.kind != Object::Kind::Shape) clip.placement = {};
}

std::uint16_t add_light_group(Object const& object, std::uint16_t outer, Reader& in) {
  auto& groups = scene_state(in.interpreter()).scene.light_groups;
  if (groups.size() == std::numeric_limits<std::uint16_t>::max()) {
    in.report(Severity::Error, "E0702", "there are too many light groups", object.span);
    return outer;
  }
  groups.push_back({object.global_lights, outer});
  return static_cast<std::uint16_t>(groups.size());
}

/// Where an object stands while it is settled.
struct Where {
  bool in_unions = true;    ///< all that it is part of are unions, of which nothing is cut away
  bool in_instance = false; ///< it is part of what is stored once
  bool begins = false;      ///< it is the whole of that
};
void settle(Object& object, Inherited const& from, Where where, Reader& in);

/// What is stored once for all unions that have the same parts and textures, in its own space.
std::shared_ptr<Object const> instance_of(Object const& object, Inherited const& to, Reader& in) {
  SceneState& state = scene_state(in.interpreter());
  auto& known = state.instances.find(object.children, to.texture, state.defaults_read);
  if (known) return known;
  Object made;
  made.kind = Object::Kind::Union;
  made.span = object.span;
  made.children = object.children;
  Inherited own;
  own.texture = to.texture;
  settle(made, own, {true, true, true}, in);
  known = std::make_shared<Object const>(std::move(made));
  return known;
}

bool is_instance(Object const& object, Inherited const& to, Where where, Reader& in) {
  if (!where.in_unions || object.kind != Object::Kind::Union || object.inverse
      || !object.clipped_by.empty() || to.interior || to.interior_texture || to.uv_mapping)
    return false;
  SceneState& state = scene_state(in.interpreter());
  scene::SharedLayers const by_default = scene::Layers(1, state.default_texture);
  return Instances::may_have(to.texture) && Instances::may_have(by_default)
         && state.instances.wants(object, where.in_instance);
}

void settle(Object& object, Inherited const& from, Where where, Reader& in) {
  scene_state(in.interpreter()).plain_textures.share(object.texture);
  Inherited to = inherit(object, from);
  object.bounded_by.clear();
  for (Object& clip : object.clipped_by) flatten_clip(clip);
  bool const group = object.kind == Object::Kind::LightGroup;
  if (group) {
    to.light_group = add_light_group(object, from.light_group, in);
    object.kind = Object::Kind::Union;
  }
  object.light_group = to.light_group;
  for (scene::Light& light : object.lights) {
    // A light in a union that stands in a group belongs to none, as in POV-Ray.
    light.group = group ? to.light_group : std::uint16_t{0};
    place_light(std::move(light), in);
  }
  object.lights.clear();
  if (object.kind == Object::Kind::Shape) {
    settle_leaf(object, to, in);
    if (!where.in_instance) scene_state(in.interpreter()).instances.count_copy();
    return;
  }
  if (!group && !where.begins && is_instance(object, to, where, in)) {
    object.instance = instance_of(object, to, in);
    object.children.clear();
    object.texture.reset();
    return;
  }
  geometry::Transform const placement = object.placement;
  Where const below{where.in_unions && object.kind == Object::Kind::Union && !object.inverse
                        && object.clipped_by.empty(),
                    where.in_instance};
  for (Object& child : object.children) {
    transform_settled(child, placement);
    settle(child, to, below, in);
  }
  object.placement = {};
}

} // namespace

void place_object(scene::Object object, Reader& in) {
  settle(object, {}, {}, in);
  if (object.kind == Object::Kind::Shape || object.instance || !object.children.empty())
    scene_state(in.interpreter()).scene.objects.push_back(std::move(object));
}

} // namespace abbe::lang
