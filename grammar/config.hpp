// SPDX-License-Identifier: MIT
#pragma once

#include "grammar/ast_adapted.hpp"
#include "grammar/structure.hpp"

#include <boost/spirit/home/x3.hpp>
#include <optional>

/// What every rule of the grammar shares: iterator, context and the state of a parse.
namespace abbe::grammar {

namespace x3 = boost::spirit::x3;

/// Which operators an expression may use: depends on what it stands in (pov-language 2.2 and 19).
/// Bare: + - * / only (`<` would close a vector). Full: inside parentheses. Function: a function
/// body.
enum class Flavour : std::uint8_t { Bare, Full, Function };

constexpr int max_nesting = 1000; ///< blocks, parentheses, vectors, bodies of directives
/// Bytes of stack. A release build needs 2 MB for max_nesting; builds with sanitizers stop sooner.
constexpr std::size_t max_stack = 5u << 20;
constexpr int max_height =
    4000; ///< of the tree, operators included: `lang` and destructors recurse

/// Not restored when an exception passes, so that error recovery sees how deep it happened.
struct State {
  SourceFile const* source = nullptr;
  Iterator begin = nullptr; ///< of the text
  Flavour flavour = Flavour::Bare;
  int depth = 0;
  int height = 0;     ///< greatest depth of the tree so far, within the enclosing expression
  int brackets = 0;   ///< open { ( [ < : 0 means that a statement may come
  char bracket = 0;   ///< the innermost of them, 0 for none
  int braces = 0;     ///< of them '{'
  int directives = 0; ///< open #if, #while ...
  char const* stack_start = nullptr;
  bool closed = true;               ///< was the last bracket closed (or left to another branch)?
  Iterator path_word_end = nullptr; ///< end of `png`, `ttf` ...: a string right after it is a path

  /// The list of the top level, and from where on it is left (StatementParser).
  void const* statements = nullptr;
  Iterator pause = nullptr;
  bool lasting = false; ///< was there a macro or a function since the last pause?
  bool flat = false;    ///< an item of a Text is being read: values of #declare follow it
  /// A Text or an #include came before: macros may open blocks that are closed here, and close
  /// some.
  bool loose = false;

  Iterator end = nullptr;             ///< of the text
  std::optional<Structure> structure; ///< made at the first #if

  /// The text before is given up (FileText).
  Iterator kept_from = nullptr;
  void pass(Iterator at) {
    constexpr std::ptrdiff_t piece = 1 << 20;
    if (at - kept_from < piece) return;
    source->bytes().give_up(static_cast<std::size_t>(kept_from - begin),
                            static_cast<std::size_t>(at - begin));
    kept_from = at;
  }

  /// Looks at the rest of the text.
  void make_structure(Iterator from) {
    structure = scan_structure(from, end);
    source->bytes().give_up(static_cast<std::size_t>(from - begin),
                            static_cast<std::size_t>(end - begin));
  }

  Span span(Iterator from, Iterator to) const {
    return {source, static_cast<std::uint32_t>(from - begin),
            static_cast<std::uint32_t>(to - begin)};
  }
};

struct StateTag;
using Context = x3::context<StateTag, State>;

template <class AnyContext>
State& state_of(AnyContext const& context) {
  return x3::get<StateTag>(context);
}

/// Base of rule tags: sets `span` of the node, blanks in front of it left out. (X3's own annotation
/// differs between Boost versions and misses operands inside variants.)
struct tag_span {
  template <class Node, class AnyContext>
  void on_success(Iterator const& first, Iterator const& end, Node& node,
                  AnyContext const& context) {
    // X3 calls with (start, end of the match).
    node.span = state_of(context).span(skip_blanks(first, end), end);
  }
};

/// The same for a node that values will refer to: Macro, Function.
struct tag_lasting : tag_span {
  template <class Node, class AnyContext>
  void on_success(Iterator const& first, Iterator const& end, Node& node,
                  AnyContext const& context) {
    tag_span::on_success(first, end, node, context);
    state_of(context).lasting = true;
  }
};

} // namespace abbe::grammar
