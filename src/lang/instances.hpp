// SPDX-License-Identifier: MIT
#pragma once

#include "scene/scene.hpp"

#include <array>
#include <map>
#include <memory>
#include <tuple>

namespace abbe::lang {

/// Plain textures of one layer that were moved with their objects, and look alike wherever they
/// stand: copies are told by what they hold, and share one again.
class PlainTextures {
public:
  PlainTextures();
  ~PlainTextures();
  /// Puts the layers that were met first in place of equal ones, where these are among the latest
  /// few hundred. Others, and what is not plain, stay as they are.
  void share(scene::SharedLayers& layers);

private:
  struct Known;
  std::unique_ptr<std::array<Known, 256>> known_; ///< by what they hold, hashed
};

/// Unions that are stored once, however often they are placed (scene::Object::instance).
///
/// A scene's shapes are copied, which is how rays meet them fastest, until there are most_copied of
/// them. What is placed from then on and would be more is stored once, where it is a union whose
/// parts others share (a declared one) and that is simple: shapes and unions of such, without an
/// interior, flags of their own, things cut away, lights; textures opaque and plain.
class Instances {
public:
  /// Shapes that are copied before anything is stored once.
  double most_copied = 0x1p20;

  /// A shape was copied into the scene.
  void count_copy() { ++copied_; }
  /// Texture that is opaque and plain, or none.
  static bool may_have(scene::SharedLayers const& texture);
  /// Leaves aside what the union itself is like. @param in_instance it is part of what is stored
  /// once
  bool wants(scene::Object const& object, bool in_instance);
  /// What there is for unions of these parts, or null to be filled.
  /// @param texture that the union gives its parts @param defaults how many defaults were read
  std::shared_ptr<scene::Object const>& find(SharedList<scene::Object> const& parts,
                                             scene::SharedLayers const& texture, int defaults);

private:
  struct Content {
    double shapes = 0;
    bool simple = true;
  };
  Content content(scene::Object const& object);
  Content content(SharedList<scene::Object> const& parts);

  double copied_ = 0;
  /// By lists of parts, which are kept so that their addresses stay their own.
  struct Seen {
    SharedList<scene::Object> parts;
    Content content;
  };
  std::map<void const*, Seen> seen_;
  struct Made {
    SharedList<scene::Object> parts;
    std::shared_ptr<scene::Layers const> texture;
    std::shared_ptr<scene::Object const> made;
  };
  std::map<std::tuple<void const*, void const*, int>, Made> made_;
};

} // namespace abbe::lang
