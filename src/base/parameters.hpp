// SPDX-License-Identifier: MIT
#pragma once

#include "base/diagnostic.hpp"
#include "base/scalar_field.hpp"
#include "base/vec.hpp"

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace abbe {

/// A transformation of a part of a shape: p -> linear p + offset and its inverse, with bounds of
/// their errors, entry by entry.
struct AffineMap {
  Mat3 linear{1}, inverse_linear{1}, linear_error{0}, inverse_linear_error{0};
  Vec3 offset{0}, inverse_offset{0}, offset_error{0}, inverse_offset_error{0};
};

/// What a shape or pattern reads its parameters from, in the order in which the scene gives them.
/// The leaf libraries read through this interface and so know nothing of the language; `lang`
/// implements it on the items of a block. A value that is missing or of the wrong type is reported
/// at its place and a harmless default returned: reading goes on, so that one run reports all
/// errors. Commas between values are optional and skipped.
class Parameters {
public:
  virtual ~Parameters() = default;

  /// A scalar; `name` ("major radius") is for messages.
  virtual double number(std::string_view name) = 0;
  /// A whole number, truncated toward zero; reported when outside [low, high].
  virtual int integer(std::string_view name, int low, int high) = 0;
  virtual Vec2 vec2(std::string_view name) = 0;
  /// A scalar is replicated.
  virtual Vec3 vec3(std::string_view name) = 0;
  virtual Vec4 vec4(std::string_view name) = 0;
  /// Is a number or vector next (and not a word, a block or the end)?
  virtual bool has_value() = 0;
  /// Is a number next, and not a vector? Decides between `<i, j, k>, number` and `<i, j, k>, <l
  /// ...>`.
  virtual bool has_number() { return has_value(); }
  /// The components, one vector behind another, of vectors of exactly `size` numbers that stand
  /// next as such; at most `most` vectors, which are taken. Empty where anything else stands, and
  /// whenever reading one by one is as well: for lists that are long. Valid until the block is
  /// closed.
  virtual std::span<double const> literal_vectors(int /*size*/, std::size_t /*most*/) { return {}; }
  /// The components of one `<...>` that has exactly `count` of them, any number (matrix 12, quartic
  /// 35 ...); zeros after an error.
  virtual std::vector<double> components(std::string_view /*name*/, int count) {
    return std::vector<double>(static_cast<std::size_t>(count));
  }
  /// A number when one is next.
  std::optional<double> optional_number(std::string_view name) {
    if (!has_value()) return std::nullopt;
    return number(name);
  }
  /// Takes the word when it is next.
  virtual bool accept(std::string_view word) = 0;
  /// A word that may be followed by a boolean (`open`, `hierarchy off`): true when it is there and
  /// on.
  virtual std::optional<bool> flag(std::string_view word) = 0;
  /// Takes `word(a, b, ...)` when it is next: its arguments, of which there must be `count`. Empty
  /// when it is not.
  virtual std::vector<double> call(std::string_view /*word*/, std::size_t /*count*/) { return {}; }
  /// Opens `word {` when it is next; read its content, then close(), which reports what is left
  /// unread.
  virtual bool open(std::string_view word) = 0;
  virtual void close() = 0;
  /// Reads `texture { ... }` (its word included) and returns its number among the textures that
  /// this object gives to its faces; -1 when none is next.
  virtual int face_texture() = 0;
  /// Takes one modifier of a part of a shape (a component of a blob) when one is next: a
  /// transformation is appended to `steps`; a texture, pigment, normal or finish makes or changes
  /// the part's own texture, of which `texture` becomes the number. @return false when none is next
  virtual bool part_modifier(std::vector<AffineMap>& /*steps*/, int& /*texture*/) { return false; }
  /// Reads `function { ... }` of x, y, z (its word included); nullptr, reported, when none is next
  /// or it is wrong.
  virtual std::shared_ptr<ScalarField const> field() { return nullptr; }
  /// Is the current block (or the whole) used up?
  virtual bool at_end() = 0;
  /// Place of the next item, for report().
  virtual Span next_span() = 0;
  /// Reports an error or warning; the span defaults to the block that is being read.
  virtual void report(Severity severity, std::string_view code, std::string_view message,
                      Span span = {}) = 0;
};

} // namespace abbe
