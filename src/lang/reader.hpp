// SPDX-License-Identifier: MIT
#pragma once

#include "base/parameters.hpp"
#include "lang/value.hpp"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace abbe::lang {

class Interpreter;

/// What stands next in a block, after directives were carried out and macros expanded.
enum class Next : std::uint8_t {
  End,
  Word,    ///< a word without value: `translate`, `hollow`, also an unknown or contextual name
  Numeric, ///< an expression or identifier that is a float, vector or colour
  String,
  Identifier, ///< a name (or array element, macro result) that holds a block value
  Block,      ///< `word {`
  Bracket,    ///< `[`
  Punctuation
};

/// Reads the items of a block one after another in text order. Directives met on the way are
/// carried out, macro calls are expanded in place, commas skipped: a block reader is written as
/// plain recursive descent and never sees them. Implements Parameters for the leaf libraries.
///
/// A block reader loop is
///     while (!in.at_end()) {
///       if (in.accept("translate")) ... in.vec3("translation")
///       else if (in.open("pigment")) { read_pigment(in, ...); in.close(); }
///       else in.unexpected("a sphere modifier");   // reports, names the nearest valid word, skips
///       it
///     }
/// The words asked for by accept(), flag() and open() since the last item was taken are remembered:
/// they are what `unexpected` offers as "did you mean".
class Reader : public Parameters {
public:
  virtual Next next() = 0;
  /// Text of the next item when it is a Word or the head of a Block, else "".
  virtual std::string_view next_word() = 0;
  /// Opens the bracket when one is next; then as a block.
  virtual bool open_bracket() = 0;
  /// Opens a Block whatever its head (after next() == Block), or a headless one `{ }`.
  virtual bool open_any() = 0;

  /// Where the next value stands, to ask comma_follows() about when it is read.
  virtual Span value_span() = 0;
  virtual bool comma_follows(Span value) = 0;
  /// The next expression with at least `minimum` components after promotion, at most 5.
  virtual Numeric numeric(std::string_view name, int minimum = 1) = 0;
  virtual std::string string(std::string_view name) = 0;
  /// A file's name: a string in which a backslash is a backslash.
  virtual std::string path(std::string_view name) = 0;
  /// A boolean that may be left out (`hollow`, `hollow off`).
  virtual bool boolean_or(bool absent) = 0;
  /// The value of the next identifier when next() == Identifier, else nullptr; take() consumes it.
  virtual Value const* identifier() = 0;
  virtual void take() = 0;
  /// The block value of type T held by the next identifier, taken; nullptr (nothing taken) if none.
  template <class T>
  std::shared_ptr<T const> accept_value() {
    Value const* value = identifier();
    if (!value) return nullptr;
    auto const* held = std::get_if<std::shared_ptr<T const>>(&value->any);
    if (!held) return nullptr;
    auto copy = *held;
    take();
    return copy;
  }
  /// The same for what a block copies: its name goes first, so that no item before it is lost.
  template <class T>
  std::shared_ptr<T const> accept_copied(bool first, std::string_view block) {
    Span const at = next_span();
    auto copied = accept_value<T>();
    if (copied && !first)
      report(Severity::Error, "E0251",
             "the name of a block to copy must be the first item of " + std::string(block) + " {}",
             at);
    return copied;
  }
  bool accept_punctuation(char symbol) { return take_punctuation(symbol); }
  /// Reports that the next item is not `what` ("a sphere modifier"): "expected a finish item, found
  /// 'scale'", or "unknown name 'shpere': expected an object; did you mean 'sphere'?". Skips it
  /// with what belongs to it.
  virtual void unexpected(std::string_view what) = 0;
  /// Skips the next item with what belongs to it (a block whole, a word with the values and strings
  /// after it), without evaluating anything: for things already reported.
  virtual void skip() = 0;
  /// The textures that face_texture() numbered since the last call, in that order. A texture block
  /// that is nothing but a name gets the same number each time.
  virtual std::vector<scene::Layers> take_face_textures() = 0;
  /// Span of the block being read.
  virtual Span block_span() = 0;
  virtual Interpreter& interpreter() = 0;

protected:
  virtual bool take_punctuation(char symbol) = 0;
};

} // namespace abbe::lang
