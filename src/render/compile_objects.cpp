// SPDX-License-Identifier: MIT
#include "render/compile_objects.hpp"

#include "base/heap.hpp"
#include "base/word_hash.hpp"
#include "geometry/shapes/instances.hpp"
#include "geometry/shapes/mesh.hpp"
#include "geometry/world_builder.hpp"
#include "render/definitions.hpp"
#include "render/finish_numbers.hpp"
#include "render/interior_numbers.hpp"
#include "render/normal_compiler.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace abbe::render {
namespace {

using geometry::CsgTree;
using geometry::Transform;
using scene::Object;

/// A piece of the scene that becomes one solid.
struct Piece {
  CsgTree tree;
  std::shared_ptr<scene::Interior const> interior;
  InteriorNumbers::Number number; ///< of its interior
  std::uint8_t mask = 0;
  std::uint16_t light_group = 0;
  bool hollow = false; ///< all of it
  bool opaque = true;
  bool receives = false;             ///< some of its surface shows light
  bool mirrors = false;              ///< some of it is a mirror of metal
  std::vector<scene::Throws> throws; ///< of its parts
  transport::Casts casts;
};

class ObjectCompiler {
public:
  ObjectCompiler(scene::Scene const& scene, plan::Plan const& plan, ColourCompiler& colours,
                 PigmentCompiler& pigments, MediaCompiler& media, Stage& stage)
      : scene_(scene),
        plan_(plan),
        colours_(colours),
        pigments_(pigments),
        media_(media),
        stage_(stage) {}

  void run(std::deque<Object>* taken) {
    std::size_t const primitives = leaves(scene_.objects);
    world_.reserve(primitives, scene_.objects.size());
    stage_.textures.surfaces.reserve(primitives);
    std::size_t const objects = scene_.objects.size();
    stage_.solids.reserve(objects);
    for (Object const& object : scene_.objects) numbers_.read(object);
    auto left_out = plan_.out_of_reach.begin();
    for (std::size_t i = 0; i < objects; ++i) {
      if (left_out != plan_.out_of_reach.end() && *left_out == i)
        ++left_out;
      else
        for (auto& piece : pieces(scene_.objects[taken ? 0 : i])) add_solid(std::move(piece));
      if (!taken) continue;
      taken->pop_front();
      if (i % give_back_after == give_back_after - 1) give_back_memory();
    }
    bool const media_touch = plan_.has(plan::Effect::ContactOfMedia);
    stage_.world = std::make_unique<geometry::World>(
        std::move(world_).finish(media_touch ? scene_.settings.contact : 0.0));
  }

private:
  /// Objects, of some hundred bytes as a rule.
  static constexpr std::size_t give_back_after = std::size_t{1} << 16;

  template <class Objects>
  static std::size_t leaves(Objects const& objects) {
    std::size_t count = 0;
    for (Object const& object : objects) {
      count += object.kind == Object::Kind::Shape || object.instance ? 1 : leaves(object.children);
      count += leaves(object.clipped_by);
    }
    return count;
  }

  void add_solid(Piece&& piece) {
    if (is_bare(piece.tree)) return;
    CompiledSolid solid;
    solid.light_group = piece.light_group;
    solid.has_medium = piece.interior != nullptr;
    solid.shuts_out_air = !stage_.air.empty() && !piece.hollow;
    if (piece.interior) {
      solid.medium = media_.add(piece.interior);
      solid.priority = piece.interior->priority;
    }
    if (solid.counts() || piece.number.counts()) {
      solid.leaks = leaks(piece.tree);
      stage_.has_leaks = stage_.has_leaks || solid.leaks;
      bool const alone = piece.tree.op == CsgTree::Op::Primitive;
      auto const boundary =
          alone ? world_.shape(piece.tree.primitive).boundary() : geometry::Boundary::Whole;
      solid.sheet = boundary == geometry::Boundary::Sheet;
      solid.open = boundary != geometry::Boundary::Whole || piece.tree.op == CsgTree::Op::Clip;
      stage_.has_priorities = stage_.has_priorities || solid.priority != 0;
      numbers_.settle(piece.number, piece.tree, solid);
    }
    bool const refracts = numbers_.refracts(piece.tree, solid);
    stage_.solids.push_back(solid);
    if (plan_.has(plan::Effect::Caustics)) {
      settle_casts(piece, refracts);
      if (piece.casts.target) piece.mask |= transport::caster_bit;
      stage_.casts.push_back(piece.casts);
      stage_.has_non_collectors = stage_.has_non_collectors || !piece.casts.collects;
      stage_.solid_receives.push_back(piece.receives);
    }
    if (piece.mask & filter_shadow_bit) stage_.has_filter_shadows = true;
    world_.add({std::move(piece.tree), piece.mask, refracts});
  }

  /// Nothing or all of space: it has no surface.
  static bool is_bare(CsgTree const& tree) {
    return tree.op != CsgTree::Op::Primitive && tree.children.empty();
  }

  bool leaks(CsgTree const& tree) const {
    if (tree.op == CsgTree::Op::Primitive) return geometry::leaks(world_.shape(tree.primitive));
    return std::any_of(tree.children.begin(), tree.children.end(),
                       [this](CsgTree const& child) { return leaks(child); });
  }

  /// The solids that an object is made of. In a finished scene every leaf stands in world space and
  /// has its texture, interior and flags.
  std::vector<Piece> pieces(Object const& object) {
    std::vector<Piece> out;
    auto const around = numbers_.begin(object);
    switch (object.kind) {
    case Object::Kind::Shape:
      out.push_back(primitive(object));
      break;
    case Object::Kind::Union:
    case Object::Kind::LightGroup:
      if (object.instance) out.push_back(instance(object));
      for (auto const& child : object.children)
        for (auto& piece : pieces(child)) out.push_back(std::move(piece));
      // The inverse of a union is one intersection; of none, it is all of space.
      if (object.inverse) {
        std::vector<Piece> one;
        one.push_back(joined(std::move(out), CsgTree::Op::Merge));
        out = std::move(one);
      }
      break;
    case Object::Kind::Merge:
      if (!object.children.empty()) out.push_back(merged(object.children));
      break;
    case Object::Kind::Intersection:
    case Object::Kind::Difference:
      out = cut(object);
      break;
    }
    if (object.inverse)
      for (auto& piece : out) piece.tree.inverse = !piece.tree.inverse;
    clip(object, out);
    numbers_.end(around);
    return out;
  }

  Piece merged(std::span<Object const> objects) {
    std::vector<Piece> parts;
    for (auto const& child : objects)
      for (auto& piece : pieces(child)) parts.push_back(std::move(piece));
    return joined(std::move(parts), CsgTree::Op::Merge);
  }

  Piece joined(std::vector<Piece> parts, CsgTree::Op op) {
    if (parts.size() == 1) return std::move(parts.front());
    Piece out;
    out.tree.op = op;
    out.hollow = true;
    if (!parts.empty()) out.light_group = parts.front().light_group;
    out.number = numbers_.joined(parts);
    for (auto& part : parts) {
      if (!out.interior) out.interior = part.interior;
      out.mask |= part.mask;
      out.hollow = out.hollow && part.hollow;
      out.opaque = out.opaque && part.opaque;
      out.receives = out.receives || part.receives;
      out.mirrors = out.mirrors || part.mirrors;
      out.throws.insert(out.throws.end(), part.throws.begin(), part.throws.end());
      out.tree.children.push_back(std::move(part.tree));
    }
    settle_shadow(out, plan_.is_off(scene::Switch::FilteringShadows));
    return out;
  }

  /// A solid casts opaque shadows only when all of it is opaque.
  static void settle_shadow(Piece& piece, bool full_shadows) {
    bool const casts = (piece.mask & (opaque_shadow_bit | filter_shadow_bit)) != 0;
    piece.mask &= static_cast<std::uint8_t>(~(opaque_shadow_bit | filter_shadow_bit));
    if (casts) piece.mask |= piece.opaque || full_shadows ? opaque_shadow_bit : filter_shadow_bit;
  }

  /// Intersections and differences; several pieces where a see-through union is distributed.
  std::vector<Piece> cut(Object const& object) {
    bool const difference = object.kind == Object::Kind::Difference;
    std::vector<std::vector<Piece>> operands;
    for (std::size_t i = 0; i < object.children.size(); ++i) {
      if (difference && i > 0) {
        // What is taken away has no inner faces to show.
        operands.push_back({});
        operands.back().push_back(merged({&object.children[i], 1}));
        continue;
      }
      auto parts = pieces(object.children[i]);
      bool const opaque =
          std::all_of(parts.begin(), parts.end(), [](Piece const& p) { return p.opaque; });
      if (opaque && parts.size() > 1) {
        std::vector<Piece> one;
        one.push_back(joined(std::move(parts), CsgTree::Op::Merge));
        parts = std::move(one);
      }
      operands.push_back(std::move(parts));
    }
    std::vector<Piece> out;
    std::vector<std::size_t> choice(operands.size(), 0);
    if (std::any_of(operands.begin(), operands.end(),
                    [](auto const& parts) { return parts.empty(); }))
      return out;
    while (true) {
      std::vector<Piece> parts;
      for (std::size_t i = 0; i < operands.size(); ++i) parts.push_back(operands[i][choice[i]]);
      Piece piece = joined(std::move(parts),
                           difference ? CsgTree::Op::Difference : CsgTree::Op::Intersection);
      // The whole is one body: an interior given to the operation itself goes before those of
      // operands.
      if (object.interior) piece.interior = object.interior;
      out.push_back(std::move(piece));
      std::size_t i = 0;
      while (i < choice.size() && ++choice[i] == operands[i].size()) choice[i++] = 0;
      if (i == choice.size()) return out;
    }
  }

  void clip(Object const& object, std::vector<Piece>& out) {
    if (object.clipped_by.empty()) return;
    for (auto& piece : out) {
      numbers_.share(piece.number);
      Piece clipped = piece;
      clipped.tree = {};
      clipped.tree.op = CsgTree::Op::Clip;
      clipped.tree.children.push_back(std::move(piece.tree));
      for (auto const& by : object.clipped_by)
        clipped.tree.children.push_back(merged({&by, 1}).tree);
      piece = std::move(clipped);
    }
  }

  /// A union that is stored once for many places: one surface, whose faces have its textures.
  Piece instance(Object const& object) {
    auto const& [definition, textures] = definitions_.of(object.instance);
    Piece piece;
    piece.tree.primitive = world_.add(
        std::make_shared<geometry::Instances const>(definition, object.placement, to_stage_), {});
    SurfaceLayers surface;
    surface.double_illuminate = object.double_illuminate.value_or(false);
    surface.layers = layers(textures.front());
    if (textures.size() > 1)
      for (auto const& texture : textures) surface.face_layers.push_back(layers(texture));
    stage_.textures.surfaces.add(std::move(surface), object);
    settle_piece(piece, object);
    return piece;
  }

  Piece primitive(Object const& object) {
    Piece piece;
    piece.tree.primitive = world_.add(object.shape, object.placement.then(to_stage_));
    SurfaceLayers surface;
    surface.double_illuminate = object.double_illuminate.value_or(false);
    if (object.texture) surface.layers = layers(object.texture);
    if (object.interior_texture) surface.interior_layers = layers(object.interior_texture);
    for (auto const& face : object.face_textures) surface.face_layers.push_back(layers(face));
    auto const maps = [&](std::vector<int> const& numbers) {
      return std::ranges::any_of(numbers, [&](int n) { return compiled(n).map >= 0; });
    };
    surface.mapped = maps(surface.layers) || maps(surface.interior_layers)
                     || std::ranges::any_of(surface.face_layers, maps);
    piece.opaque = opaque(surface.layers)
                   && (surface.interior_layers.empty() || opaque(surface.interior_layers));
    for (auto const& face : surface.face_layers) piece.opaque = piece.opaque && opaque(face);
    if (plan_.has(plan::Effect::Caustics)) note_light(surface, piece);
    bool const gathers = object.interior && object.interior->caustics != 0;
    if (!gathers) std::erase_if(surface.layers, [&](int number) { return invisible(number); });
    stage_.textures.surfaces.add(std::move(surface), object);
    settle_piece(piece, object);
    return piece;
  }

  /// Takes over what an object says beside its surface.
  void settle_piece(Piece& piece, Object const& object) {
    piece.interior = object.interior;
    piece.number = numbers_.of_shape(object, piece.opaque);
    piece.throws = {object.throws};
    piece.light_group = object.light_group;
    piece.hollow = object.hollow.value_or(false);
    bool const image = !object.no_image.value_or(false);
    bool const reflection = !object.no_reflection.value_or(false);
    bool const shadow = !object.no_shadow.value_or(false);
    bool const full_shadows = plan_.is_off(scene::Switch::FilteringShadows);
    piece.mask =
        static_cast<std::uint8_t>((image ? camera_bit : 0) | (reflection ? reflection_bit : 0)
                                  | (!shadow                        ? 0
                                     : piece.opaque || full_shadows ? opaque_shadow_bit
                                                                    : filter_shadow_bit));
  }

  /// How a solid throws light: as the first of its parts that says so; glass and mirrors of metal
  /// by themselves.
  void settle_casts(Piece& piece, bool refracts) const {
    using scene::Choice;
    transport::Casts& casts = piece.casts;
    bool const photons = scene_.settings.thrown.photons;
    Choice cast = Choice::Unset;
    for (scene::Throws const& part : piece.throws) {
      if (cast == Choice::Unset) cast = part.cast;
      casts.collects = casts.collects && part.collect;
      if (!photons) continue;
      casts.target = casts.target || part.target;
      casts.pass_through = casts.pass_through || part.pass_through;
      if (casts.refraction == Choice::Unset) casts.refraction = part.refraction;
      if (casts.reflection == Choice::Unset) casts.reflection = part.reflection;
    }
    bool const caustics = scene_.settings.thrown.caustics;
    bool const glass = caustics && piece.interior && piece.interior->glass && refracts;
    bool const mirrors = caustics && piece.mirrors;
    if (!caustics && cast == Choice::On) cast = Choice::Unset;
    auto const by_itself = [](Choice& choice) {
      if (choice == Choice::Unset) choice = Choice::On;
    };
    if (glass || cast == Choice::On) by_itself(casts.refraction);
    if (glass || mirrors || cast == Choice::On) by_itself(casts.reflection);
    casts.target = casts.target || glass || mirrors || cast == Choice::On;
    if (cast == Choice::Off) {
      casts.target = false;
      casts.refraction = casts.reflection = Choice::Off;
    }
    piece.receives = piece.receives && casts.collects;
  }

  /// What caustics want to know of a surface.
  void note_light(SurfaceLayers const& surface, Piece& piece) {
    auto const note = [&](auto const& self, std::vector<int> const& numbers) -> void {
      for (int const number : numbers) {
        CompiledLayer const& layer = compiled(number);
        if (layer.map >= 0) {
          auto const& entries = stage_.textures.maps[static_cast<std::size_t>(layer.map)].entries;
          for (auto const& entry : entries) self(self, entry);
          continue;
        }
        CompiledFinish const& finish = stage_.textures.finish(layer);
        bool const scatters =
            (finish.diffuse != 0 || finish.diffuse_back != 0) && !pigments_.clear(layer.pigment);
        piece.receives = piece.receives || scatters || finish.phong != 0 || finish.specular != 0;
        piece.mirrors = piece.mirrors || (finish.reflection && !finish.reflection->metal_n.empty());
      }
    };
    note(note, surface.layers);
    note(note, surface.interior_layers);
    for (auto const& face : surface.face_layers) note(note, face);
    stage_.receives.push_back(piece.receives);
  }

  /// Only what lies under a layer that lets light pass can be seen.
  bool opaque(std::vector<int> const& numbers) const {
    return numbers.empty() || std::any_of(numbers.begin(), numbers.end(), [&](int number) {
             CompiledLayer const& layer = compiled(number);
             if (layer.map < 0) return pigments_.opaque(layer.pigment);
             auto const& entries =
                 stage_.textures.maps[static_cast<std::size_t>(layer.map)].entries;
             return std::ranges::all_of(entries, [&](auto const& entry) { return opaque(entry); });
           });
  }
  CompiledLayer const& compiled(int number) const {
    return stage_.textures.layers[static_cast<std::size_t>(number)];
  }

  /// Lets all light pass and adds none: what a glass without a texture has.
  bool invisible(int number) const {
    CompiledLayer const& layer = stage_.textures.layers[static_cast<std::size_t>(number)];
    CompiledFinish const& finish = stage_.textures.finish(layer);
    return layer.map < 0 && pigments_.clear(layer.pigment) && layer.normal < 0 && finish.phong == 0
           && finish.specular == 0 && !finish.reflection;
  }

  std::vector<int> const& layers(scene::SharedLayers const& textures) {
    // What many objects share often comes many times one after the other.
    if (!textures.shares(latest_)) {
      latest_layers_ = layers(*textures);
      latest_ = textures;
    }
    return latest_layers_;
  }

  std::vector<int> layers(scene::Layers const& textures) {
    std::vector<int> out;
    out.reserve(textures.size());
    for (auto const& texture : textures) out.push_back(layer(texture));
    return out;
  }

  int layer(scene::Texture const& texture) {
    if (texture.map) return mapped_layer(texture);
    CompiledLayer layer;
    layer.uv = texture.uv;
    stage_.textures.uses_uv = stage_.textures.uses_uv || texture.uv;
    if (texture.pigment.pattern) note_needs(texture.pigment);
    if (texture.normal) note_needs(*texture.normal);
    layer.pigment = pigments_.add(texture.pigment);
    bool const tilts = texture.normal && texture.normal->pattern;
    layer.finish = finish(texture.finish, tilts);
    auto const fresh = static_cast<std::uint32_t>(stage_.textures.layers.size());
    if (texture.pigment.pattern || tilts || texture.uv) {
      Transform const to_stage = to_stage_of(texture);
      layer.normal = normals_.add(texture.normal, to_stage.inverse_linear);
      layer.space = static_cast<int>(stage_.textures.texture_spaces.size());
      stage_.textures.texture_spaces.push_back({to_stage.inverse_linear, to_stage.inverse_offset});
    } else {
      // Plain colours are the same everywhere: one layer for all that have the same finish.
      WordHash hash;
      hash.add(static_cast<std::uint64_t>(layer.pigment) << 32
               | static_cast<std::uint64_t>(layer.finish));
      auto const known = plain_layers_.find_or_add(hash.value(), fresh, [&](std::uint32_t number) {
        CompiledLayer const& other = stage_.textures.layers[number];
        return other.pigment == layer.pigment && other.finish == layer.finish;
      });
      if (known != fresh) return static_cast<int>(known);
    }
    stage_.textures.layers.push_back(layer);
    return static_cast<int>(fresh);
  }

  /// What patterns ask of surfaces costs something only where it is asked for.
  void note_needs(texture::PatternInstance const* pattern) {
    if (pattern == nullptr) return;
    stage_.textures.uses_uv = stage_.textures.uses_uv || pattern->uv;
    stage_.textures.sees = stage_.textures.sees || pattern->pattern->looks();
  }
  void note_needs(scene::Pigment const& pigment) {
    note_needs(pigment.pattern.get());
    for (auto const& entry : pigment.entries) note_needs(*entry.pigment);
  }
  void note_needs(scene::Normal const& normal) {
    note_needs(normal.pattern.get());
    for (auto const& entry : normal.entries) note_needs(*entry.normal);
  }

  /// Surface coordinates do not move with the camera.
  Transform to_stage_of(scene::Texture const& texture) const {
    return texture.uv ? texture.placement.transform() : texture.placement.then(to_stage_);
  }

  int mapped_layer(scene::Texture const& texture) {
    surface::Textures& textures = stage_.textures;
    surface::CompiledTextureMap map;
    map.pattern = texture.map->pattern;
    note_needs(map.pattern.get());
    textures.uses_uv = textures.uses_uv || texture.uv;
    Transform const to_stage = to_stage_of(texture);
    map.linear = to_stage.inverse_linear;
    for (auto step = map.pattern->mappings.rbegin(); step != map.pattern->mappings.rend(); ++step)
      map.linear = step->linear * map.linear;
    Transform const outside = std::exchange(to_stage_, Transform{}); // entries lie in the pattern
    for (auto const& entry : texture.map->entries) {
      map.values.push_back(entry.value);
      map.entries.push_back(layers(entry.layers));
    }
    to_stage_ = outside;
    CompiledLayer layer;
    layer.uv = texture.uv;
    layer.map = static_cast<int>(textures.maps.size());
    layer.space = static_cast<int>(textures.texture_spaces.size());
    // A finish that is never asked for, but has a number.
    layer.finish = finish(texture.finish, false);
    textures.texture_spaces.push_back({to_stage.inverse_linear, to_stage.inverse_offset});
    textures.maps.push_back(std::move(map));
    textures.layers.push_back(layer);
    return static_cast<int>(textures.layers.size()) - 1;
  }

  int finish(Shared<scene::Finish> const& finish, bool tilts) {
    int const number = finishes_.of(finish, tilts);
    if (static_cast<std::size_t>(number) == stage_.textures.finishes.size()) {
      stage_.textures.finishes.push_back(compile_finish(*finish, scene_.settings, colours_));
      stage_.textures.finishes.back().tilts = tilts;
      if (plan_.is_off(scene::Switch::Reflection))
        stage_.textures.finishes.back().reflection.reset();
    }
    return number;
  }

  scene::Scene const& scene_;
  plan::Plan const& plan_;
  ColourCompiler& colours_;
  PigmentCompiler& pigments_;
  MediaCompiler& media_;
  Stage& stage_;
  Transform to_stage_ = Transform::translation(-scene_.camera.location);
  geometry::WorldBuilder world_;
  FinishNumbers finishes_;
  InteriorNumbers numbers_{stage_, media_};
  NormalCompiler normals_{stage_.textures};
  NumberTable plain_layers_; ///< by numbers of pigment and finish
  Definitions definitions_;
  scene::SharedLayers latest_;
  std::vector<int> latest_layers_; ///< of these
};

} // namespace

void compile_objects(scene::Scene const& scene, std::deque<Object>* taken, plan::Plan const& plan,
                     ColourCompiler& colours, PigmentCompiler& pigments, MediaCompiler& media,
                     Stage& stage) {
  ObjectCompiler(scene, plan, colours, pigments, media, stage).run(taken);
}

} // namespace abbe::render
