// SPDX-License-Identifier: MIT
#pragma once

#include "render/media_compiler.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace abbe::render {

/// Which surfaces share an interior. As in POV-Ray, an interior that is written at a shape is that
/// shape's, and one that is written at a combination is shared by those of its parts that have
/// none; a copy of an object has interiors of its own. What has none by then gets one for each
/// object of the scene, with an index of 1: its surfaces bend light that is inside of others. A
/// closed shape with an interior of its own needs no number: its SolidId will do.
///
/// `glass { }`, and all interiors of a scene with priorities, are not POV-Ray's: there a
/// combination is one body with one interior, and nothing is where none is written.
class InteriorNumbers {
public:
  /// The interior of a piece.
  struct Number {
    enum class Kind : std::uint8_t {
      None,   ///< there is none
      Body,   ///< the piece is one body
      Alone,  ///< of one shape, which has not been given a number
      Shared, ///< `number`, of all surfaces
      Mixed   ///< each primitive has its own; `number` is that of the whole, or -1
    } kind = Kind::None;
    std::int32_t number = -1;
    std::shared_ptr<scene::Interior const> interior; ///< of Alone; null: the air
    bool counts() const { return kind != Kind::None; }
  };
  /// The combination whose parts are being looked at.
  struct Owner {
    scene::Interior const* interior = nullptr;
    std::int32_t number = -1;
  };

  InteriorNumbers(Stage& stage, MediaCompiler& media) : stage_(stage), media_(media) {}

  /// Looks whether the scene asks for any of this.
  void read(scene::Object const& object);

  /// Before and after the parts of an object are compiled. @return for end()
  Owner begin(scene::Object const& object);
  void end(Owner const& around) {
    owner_ = around;
    --depth_;
  }
  /// Of a shape. @param opaque no light passes it
  Number of_shape(scene::Object const& object, bool opaque);
  /// Of several pieces as one. @param parts have `tree` and `number`
  template <class Pieces>
  Number joined(Pieces& parts) {
    Number out;
    bool same = true, body = false;
    for (auto& part : parts) {
      body = body || part.number.kind == Number::Kind::Body;
      same = same && part.number.kind == parts.front().number.kind
             && part.number.kind != Number::Kind::Alone && part.number.kind != Number::Kind::Mixed
             && part.number.number == parts.front().number.number;
    }
    if (body) {
      out.kind = Number::Kind::Body;
    } else if (same && !parts.empty()) {
      out = parts.front().number;
    } else if (!parts.empty()) {
      for (auto& part : parts) assign(part.number, part.tree);
      out.kind = Number::Kind::Mixed;
      out.number = owner_.interior != nullptr ? owner_.number : without_;
    }
    return out;
  }
  /// The piece's surface will not enclose it.
  void share(Number& number);
  /// Tells the solid. @param solid knows its medium, and whether it is open
  void settle(Number number, geometry::CsgTree const& tree, transport::CompiledSolid& solid);
  /// Does some surface of the solid bend light?
  bool refracts(geometry::CsgTree const& tree, transport::CompiledSolid const& solid) const;

private:
  bool acts() const { return plain_ && !priorities_; }
  /// @param interior null: the air
  std::int32_t fresh(std::shared_ptr<scene::Interior const> const& interior);
  /// Gives each of the tree's primitives its number.
  void assign(Number& number, geometry::CsgTree const& tree);
  template <class Visit>
  static void each_primitive(geometry::CsgTree const& tree, Visit const& visit) {
    if (tree.op == geometry::CsgTree::Op::Primitive) visit(tree.primitive);
    for (auto const& child : tree.children) each_primitive(child, visit);
  }

  Stage& stage_;
  MediaCompiler& media_;
  Owner owner_;
  std::int32_t depth_ = 0;    ///< of combinations around
  std::int32_t without_ = -1; ///< number of what has no interior, of this object of the scene
  bool plain_ = false, priorities_ = false; ///< some interior of the scene
};

} // namespace abbe::render
