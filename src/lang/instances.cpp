// SPDX-License-Identifier: MIT
#include "lang/instances.hpp"

#include "base/word_hash.hpp"
#include "geometry/shape.hpp"
#include "geometry/shapes/height_field.hpp"
#include "lang/attach.hpp"

#include <algorithm>
#include <utility>

namespace abbe::lang {
namespace {

using scene::Object;

/// Fewer shapes than this are not worth a definition of their own.
constexpr double least_instance = 64;

bool opaque(scene::SharedLayers const& layers) {
  return !layers.has_value() || std::ranges::any_of(*layers, [](scene::Texture const& layer) {
    return layer.pigment.colour.filter == 0 && layer.pigment.colour.transmit == 0;
  });
}

/// What a plain layer holds, but for its place and its span.
struct Holds {
  void const *finish, *spectrum, *quick_colour;
  Vec3 rgb;
  double filter, transmit;
  bool operator==(Holds const&) const = default;
  static Holds of(scene::Texture const& layer) {
    scene::Colour const& colour = layer.pigment.colour;
    return {layer.finish.held().get(),
            colour.spectrum.get(),
            layer.pigment.quick_colour.get(),
            colour.rgb,
            colour.filter,
            colour.transmit};
  }
};

/// Does it say anything of how light is thrown?
bool throws(scene::Throws const& of) {
  using scene::Choice;
  return of.refraction != Choice::Unset || of.reflection != Choice::Unset
         || of.cast != Choice::Unset || of.target || !of.collect || of.pass_through;
}

/// What of an object, beside its parts, keeps it from being stored once.
bool is_simple(Object const& object) {
  bool flags = object.inverse || object.uv_mapping || throws(object.throws);
  for (auto const& flag : {object.hollow, object.no_shadow, object.no_image, object.no_reflection,
                           object.double_illuminate})
    flags = flags || flag.value_or(false);
  if (flags || object.interior || object.interior_texture || !object.face_textures.empty()
      || !object.clipped_by.empty() || !object.lights.empty()
      || !Instances::may_have(object.texture))
    return false;
  if (object.kind != Object::Kind::Shape) return object.kind == Object::Kind::Union;
  // Normals of a height field hang on where it stands.
  return object.shape && !object.shape->bounds().infinite
         && dynamic_cast<geometry::HeightField const*>(object.shape.get()) == nullptr;
}

} // namespace

struct PlainTextures::Known {
  Holds holds{};
  scene::SharedLayers layers; ///< keeps what `holds` points to
};

PlainTextures::PlainTextures() : known_(std::make_unique<std::array<Known, 256>>()) {}
PlainTextures::~PlainTextures() = default;

void PlainTextures::share(scene::SharedLayers& layers) {
  scene::SharedLayers const& read = layers;
  if (!read.has_value() || read->size() != 1 || !is_plain(read) || read->front().placement.none())
    return;
  Holds const holds = Holds::of(read->front());
  static_assert(sizeof(Holds) == 8 * sizeof(double)); // no gaps
  WordHash hash;
  hash.add(&holds, sizeof holds);
  Known& known = (*known_)[hash.value() % known_->size()];
  Span const here = read->front().span;
  scene::SharedLayers const& before = known.layers;
  bool const same = before.has_value() && known.holds == holds
                    && before->front().span.source == here.source
                    && before->front().span.begin == here.begin;
  if (!same) {
    known = {holds, read};
    known.layers->front().placement = {};
  }
  layers = known.layers;
}

bool Instances::may_have(scene::SharedLayers const& texture) {
  return is_plain(texture) && opaque(texture);
}

Instances::Content Instances::content(SharedList<Object> const& parts) {
  if (auto const known = seen_.find(parts.id()); known != seen_.end()) return known->second.content;
  Content inside;
  for (Object const& part : parts) {
    Content const own = content(part);
    inside.shapes += own.shapes;
    inside.simple = inside.simple && own.simple;
  }
  // The null list's address is that of all empty ones.
  if (!parts.empty() && parts.shares()) seen_[parts.id()] = {parts, inside};
  return inside;
}

Instances::Content Instances::content(Object const& object) {
  Content const inside = content(object.children);
  bool const shape = object.kind == Object::Kind::Shape;
  return {inside.shapes + (shape ? 1.0 : 0.0), inside.simple && is_simple(object)};
}

bool Instances::wants(Object const& object, bool in_instance) {
  bool const shared = object.children.shares();
  if (in_instance) {
    Content const of = content(object);
    return shared && of.simple && of.shapes >= least_instance;
  }
  if (!shared) return false;
  // What the union itself says is for all of it.
  Content const inside = content(object.children);
  return inside.simple && inside.shapes >= least_instance && copied_ + inside.shapes > most_copied;
}

std::shared_ptr<Object const>& Instances::find(SharedList<Object> const& parts,
                                               scene::SharedLayers const& texture, int defaults) {
  auto const held = texture.held();
  Made& made = made_[{parts.id(), held.get(), defaults}];
  made.parts = parts;
  made.texture = held;
  return made.made;
}

} // namespace abbe::lang
