// SPDX-License-Identifier: MIT
#pragma once

#include "base/source.hpp"
#include "grammar/node.hpp"

#include <cstdint>
#include <string>
#include <vector>

/// The syntax tree of a scene file. It is generic: blocks, words, expressions and directives.
/// No node knows what a sphere or a pigment is; `lang` gives meaning.
///
/// The language is spliced together token by token (macros and directives may stand between any two
/// items of any list), so every list is a list of `Item`s and meaning is given in text order.
/// Commas between items are optional in the language and leave no trace here, except that they end
/// an expression (`<1 -2 3>` has two components).
namespace abbe::ast {

struct Expr;
struct Item;
using Items = std::vector<Item>;

/// A name that the user made up (an identifier) or a reserved word that can be an operand
/// (`x`, `pi`, `clock`, `yes`, `image_width`): `reserved` tells which.
struct Name {
  Span span;
  std::string text;
  bool reserved = false;
  mutable std::uint32_t symbol = 0; ///< the interpreter's number for `text`, 0 until it is needed
};

struct Number {
  Span span;
  double value = 0;
};

/// Text between quotes, its escapes resolved; `raw`, for paths: a backslash is a backslash.
struct String {
  Span span;
  std::string text;
  std::string raw;
};

/// `<1, 2.5, -3>`: nothing but (signed) numbers. By far the most frequent node of mesh files.
struct LiteralVector {
  Span span;
  std::uint8_t size = 0;
  double values[5] = {};
};

enum class UnaryOp : std::uint8_t { Plus, Minus, Not };
enum class BinaryOp : std::uint8_t {
  Add,
  Sub,
  Mul,
  Div,
  And,
  Or,
  Less,
  LessEqual,
  Equal,
  NotEqual,
  GreaterEqual,
  Greater
};

struct Vector;
struct Unary;
struct Binary;
struct Conditional;
struct Member;
struct Index;
struct Call;
struct Paren;
struct Array;
struct Function;
struct Block;

/// An expression: one of these kinds, which ast_visit.hpp looks into.
struct Expr : OneOf<Number, LiteralVector, Name, String, Box<Vector>, Box<Unary>, Box<Binary>,
                    Box<Conditional>, Box<Member>, Box<Index>, Box<Call>, Box<Paren>, Box<Array>,
                    Box<Function>, Box<Block>> {
  using OneOf::OneOf;
};

/// `<e, e, ...>`: two to five components or many coefficients; macros may yield some.
struct Vector {
  Span span;
  Items components;
};
struct Unary {
  Span span;
  UnaryOp op = UnaryOp::Plus;
  bool calls = false; ///< is the operand, or one of its operands, a call that may be a macro's?
  Expr operand;
};
struct Binary {
  Span span;
  BinaryOp op = BinaryOp::Add;
  bool calls = false; ///< as of Unary
  Expr left;
  Expr right;
};
/// `c ? a : b`
struct Conditional {
  Span span;
  Expr condition;
  Expr yes;
  Expr no;
};
/// `operand.x`
struct Member {
  Span span;
  Expr operand;
  Name member;
};
/// `A[i][j]`
struct Index {
  Span span;
  Name array;
  std::vector<Expr> subscripts;
};
/// `F(a, b)`: a macro, a user function, a spline, a built-in function, or (commas being optional)
/// a plain value followed by a parenthesised one. Which, is known when it is evaluated. `F[i](a,
/// b)` likewise: then `element` holds one, and `callee` is the name of the array. Each argument is
/// a list of items: one expression as a rule, more where directives stand inside.
struct Call {
  Span span;
  Name callee;
  std::vector<Items> arguments;
  std::vector<Index> element;
};
/// `( ... )`: one expression as a rule; directives may stand inside.
struct Paren {
  Span span;
  Items items;
};
/// `array[3][2] { {a, b} ... }`; elements are flattened rows: nested braces are Blocks without a
/// head.
struct Array {
  Span span;
  std::vector<Expr> sizes;
  bool has_elements = false;
  Items elements;
};
/// `function(a, b) { ... }` or `function { ... }`, whose body has its own precedences
/// (| & relational + * unary member), or `function { pattern { ... } }` and its like: `special`.
/// `sizes` are those of `function 100, 100 { ... }`, where it stands for an image.
struct Function {
  Span span;
  bool has_parameters = false;
  std::vector<Name> parameters;
  std::vector<Expr> sizes;
  Items body; ///< one Expr as a rule; directives and macro calls may stand inside
};
/// `word { items }`, the general form of every object, texture, finish, map ...; the head is empty
/// for a bare `{ items }` (rows of arrays). `spectrum`, `glass` and the like have no other form.
struct Block {
  Span span;
  Name head;
  Items items;
  /// Not closed here, but in another text. Either it is the end of a branch of an #if that has
  /// `open_blocks`, and its `tail` goes on with this block; or whatever is executed next, up to a
  /// Punctuation '}', belongs to it as well.
  bool open = false;
};

// ---------------------------------------------------------------------------------------- items

/// A reserved word that is no operand: `translate`, `color`, `no_shadow`, `hollow` ...
struct Word {
  Span span;
  std::string text;
};
/// Many LiteralVectors of one size, one after another, in a fifth of the memory: the lists of mesh
/// files, which are as long as these. Stands for as many items.
struct LiteralVectors {
  Span span; ///< from the first to the last
  std::uint8_t size = 0;
  std::vector<double> values;       ///< component by component
  std::vector<std::uint32_t> begin; ///< where each begins in the source
  std::size_t count() const { return begin.size(); }
  LiteralVector operator[](std::size_t i) const;
};
/// `[ ... ]`: an entry of a map.
struct Bracket {
  Span span;
  Items items;
};
/// A lone `:` (`xyz(1,0,0): 2`) or `;`, which few contexts allow. `}` closes the Block, `)` the
/// #write, that another text left `open`.
struct Punctuation {
  Span span;
  char symbol = 0;
};

/// The body of a directive that is not whole: it opens a block that another text closes, or makes
/// no sense. When it is executed, it is read an item at a time (parse_loose).
struct Text {
  Span span;
};

/// `#if #ifdef #ifndef ... #elseif ... #else ... #end`
struct If {
  Span span;
  struct Branch {
    Span span;
    enum class Test : std::uint8_t { If, Ifdef, Ifndef, Else } test = Test::If;
    Expr condition; ///< for Ifdef and Ifndef a Name or Index; for Else unused; a Paren otherwise
    Items items;
  };
  std::vector<Branch> branches;
  /// 1 when every branch ends in a Block that is `open` and closed behind `#end`, as in
  /// `#if(M) merge { #else union { #end ... }`: then `tail` is what follows `#end` inside that
  /// block, whichever it is. Where opening and closing lie further apart, this is 0 and
  /// `Block::open` tells.
  std::uint8_t open_blocks = 0;
  Items tail;
};
/// `#while(c) ... #end`
struct While {
  Span span;
  Expr condition;
  Items items;
};
/// `#for(N, first, last, step) ... #end`; `arguments` are first, last and perhaps step.
struct For {
  Span span;
  Name counter;
  std::vector<Expr> arguments;
  Items items;
};
/// `#switch(e) #case(v) ... #range(a, b) ... #else ... #end`
struct Switch {
  Span span;
  Expr value;
  Items before; ///< what stands before the first clause is executed, whichever is taken
  struct Clause {
    Span span;
    enum class Kind : std::uint8_t { Case, Range, Else } kind = Kind::Case;
    std::vector<Expr> bounds; ///< one for Case, two for Range
    Items items;
  };
  std::vector<Clause> clauses;
};
/// `#declare N = value;` or `#local`; the target is a Name or an Index.
struct Declare {
  Span span;
  bool local = false;
  bool deprecated = false;
  bool deprecated_once = false;
  String deprecation; ///< the message of `deprecated "..."`, its span invalid when there is none
  Expr target;
  /// One expression as a rule; more for fragments (`color rgb <1,0,0> filter .5`). None: the value
  /// is what comes next when the directive is carried out (`#declare A = #declare B = 3; B;`).
  Items value;
  bool has_semicolon = false;
};
/// `#macro N(a, b) ... #end`
struct Macro {
  Span span;
  Name name;
  std::vector<Name> parameters;
  Items body;
};
/// All directives that are a word and what follows: include version default debug warning error
/// render statistics undef fopen fclose read write break. `word` is without the '#'.
struct Directive {
  Span span;
  std::string word;
  Items arguments;   ///< a block for default, names and expressions else
  bool open = false; ///< a #write whose ')' comes later: a Punctuation, in another branch of an #if
};

/// An item of a list: an expression, or one of these.
struct Item : OneOf<Expr, Word, LiteralVectors, Bracket, Punctuation, Text, Box<If>, Box<While>,
                    Box<For>, Box<Switch>, Box<Declare>, Box<Macro>, Box<Directive>> {
  using OneOf::OneOf;
};

/// The tree of one source.
struct Document {
  SourceFile const* source = nullptr;
  Items items;
};

} // namespace abbe::ast

#include "grammar/ast_visit.hpp"
