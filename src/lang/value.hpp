// SPDX-License-Identifier: MIT
#pragma once

#include "base/diagnostic.hpp"
#include "base/few.hpp"
#include "base/source.hpp"
#include "grammar/ast.hpp"
#include "optics/glass.hpp"
#include "optics/spectrum.hpp"
#include "scene/scene.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace abbe::lang {

/// A number of one to five components: float, vector or colour value of the language.
/// Promotion (section 2.3 of the language notes): one component is replicated, two or more are
/// padded with zeros.
struct Numeric {
  std::uint8_t size = 1;
  bool colour = false; ///< is or contains a declared colour (may stand where a colour keyword must)
  std::array<double, 5> c{};

  double scalar() const { return c[0]; }
  Vec3 vec3() const { return {c[0], c[1], c[2]}; }
  /// At least `to` components: one is replicated, more are padded with zeros.
  Numeric promoted(int to) const;
  /// Comes of something wrong that was reported already (size 0).
  bool poisoned() const { return size == 0; }
};

struct Value;

struct ArrayValue {
  std::vector<int> sizes;
  std::vector<Value> elements; ///< the last subscript runs fastest; empty: not set yet
  int type = -1;               ///< of all elements, fixed by the first one assigned
  std::string_view type_text;  ///< that type, for messages

  /// May the value become an element? The first fixes the type of all.
  bool admit(Value const&);
};

/// A macro: its tree and where it was defined.
struct MacroValue {
  ast::Macro const* tree = nullptr;
};
struct FunctionValue; // user function; see function.hpp
struct SplineValue;   // see spline.hpp
struct FileValue;     // see files.hpp

/// `color_map`, `pigment_map`: entries ready for a pigment.
struct MapValue {
  std::vector<scene::Pigment::Entry> entries;
};
/// `normal_map`.
struct NormalMapValue {
  std::vector<scene::Normal::Entry> entries;
};
/// `texture_map`.
struct TextureMapValue {
  std::vector<scene::TextureMap::Entry> entries;
};
/// `slope_map`.
struct SlopeMapValue {
  std::vector<scene::Normal::Slope> entries;
};
/// `media`: read, and not rendered yet.
struct MediaValue {};
struct MaterialValue {
  scene::SharedLayers texture, interior_texture;
  std::shared_ptr<scene::Interior const> interior;
};

/// A block of a kind that is not supported yet; see Value::deferred.
struct Unsupported {};

/// Everything that can be declared. Block values are snapshots: using a name copies it.
struct Value {
  using Any =
      std::variant<std::monostate, Numeric, std::string, scene::Colour /* with a spectrum */,
                   std::shared_ptr<ArrayValue>, MacroValue, std::shared_ptr<FunctionValue>,
                   std::shared_ptr<SplineValue>, std::shared_ptr<FileValue>,
                   std::shared_ptr<scene::Object const>, std::shared_ptr<scene::Pigment const>,
                   std::shared_ptr<scene::Finish const>, std::shared_ptr<scene::Layers const>,
                   std::shared_ptr<scene::Interior const>, std::shared_ptr<MaterialValue const>,
                   std::shared_ptr<MapValue const>, std::shared_ptr<geometry::Transform const>,
                   std::shared_ptr<scene::Camera const>, std::shared_ptr<scene::Light const>,
                   std::shared_ptr<scene::SkySphere const>, std::shared_ptr<optics::Glass const>,
                   std::shared_ptr<optics::Spectrum const>, std::shared_ptr<scene::Normal const>,
                   std::shared_ptr<NormalMapValue const>, std::shared_ptr<SlopeMapValue const>,
                   std::shared_ptr<TextureMapValue const>, std::shared_ptr<MediaValue const>,
                   std::shared_ptr<scene::Fog const>, std::shared_ptr<scene::Rainbow const>,
                   Unsupported>;
  Any any;
  Span declared_at;
  Few<Diagnostic> deferred = {}; ///< what of it is not supported yet: told when it is used

  bool empty() const { return any.index() == 0; }
};

/// "a float", "a texture": for messages.
std::string_view type_name(Value const&);

} // namespace abbe::lang
