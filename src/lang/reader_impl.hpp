// SPDX-License-Identifier: MIT
#pragma once

#include "lang/reader.hpp"
#include "lang/scope.hpp"
#include "lang/statement_streams.hpp"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace abbe::lang {

/// The reader over the syntax tree: a stack of frames, each a list of items, a position in it, and
/// what to do at its end (go round a loop, leave a macro's table of names ...). Directives push and
/// pop frames, so that what a macro, a loop or an included file yields is simply what comes next.
///
/// A Region or Block frame is a wall: what reads above it sees End there.
class ReaderImpl final : public Reader {
public:
  explicit ReaderImpl(Interpreter& interpreter) : in_(interpreter) {}

  // Parameters
  double number(std::string_view name) override;
  int integer(std::string_view name, int low, int high) override;
  Vec2 vec2(std::string_view name) override;
  Vec3 vec3(std::string_view name) override;
  Vec4 vec4(std::string_view name) override;
  std::span<double const> literal_vectors(int size, std::size_t most) override;
  bool has_value() override { return next() == Next::Numeric; }
  bool has_number() override;
  bool accept(std::string_view word) override;
  std::optional<bool> flag(std::string_view word) override;
  bool open(std::string_view word) override;
  void close() override;
  int face_texture() override;
  bool part_modifier(std::vector<AffineMap>& steps, int& texture) override;
  std::shared_ptr<ScalarField const> field() override;
  bool at_end() override { return next() == Next::End; }
  Span next_span() override;
  void report(Severity, std::string_view code, std::string_view message, Span) override;

  // Reader
  Next next() override {
    if (!peek_.ready) settle();
    return peek_.next;
  }
  std::string_view next_word() override;
  bool open_bracket() override;
  bool open_any() override;
  Numeric numeric(std::string_view name, int minimum) override;
  std::vector<double> components(std::string_view name, int count) override;
  std::string string(std::string_view name) override;
  std::string path(std::string_view name) override;
  bool boolean_or(bool absent) override;
  Value const* identifier() override;
  void take() override;
  void unexpected(std::string_view what) override;
  void skip() override;
  std::vector<scene::Layers> take_face_textures() override;
  Span block_span() override;
  Interpreter& interpreter() override { return in_; }

  // For the interpreter and its expressions.

  /// Reads `items` behind a wall until leave_region(), which reports what is left unread.
  void enter_region(ast::Items const& items, Span);
  /// The innermost list goes on with the next pieces of the stream, if there is one.
  void read_from(StatementStream* stream) { frames_.back().stream = stream; }
  /// Is a block being read that an #if left open?
  bool in_loose_block() const { return !open_blocks_.empty(); }
  void leave_region();
  /// What may stand behind `=` or as a macro's argument; empty (reported) when there is none.
  Value read_value();
  /// The value of the only thing in the items.
  Value value_of(ast::Items const& items, Span);
  /// The content of `{ ... }` without a head, taken; nullptr when something else is next.
  ast::Items const* take_row();
  /// The next item unevaluated, taken, when it is an expression or a block; else nullptr.
  ast::Expr const* take_expression();
  /// A block where a value is wanted.
  Value block_value(ast::Block const&);
  /// A macro called where a value is wanted.
  Value macro_value(ast::Call const&, MacroValue const&);
  /// "called from", "included from": innermost first, shortened.
  std::vector<Diagnostic::Note> chain() const;
  /// The source that the innermost directive stands in.
  SourceFile const* current_source() const;
  /// Is there a value of that name or array element?
  bool is_defined(ast::Expr const&);

private:
  struct Frame {
    enum class Kind : std::uint8_t { Region, Block, Splice, While, For, Switch, Macro, Include };
    ast::Items const* items = nullptr;
    std::size_t position = 0;
    Kind kind = Kind::Splice;
    std::uint32_t element = 0; ///< of an item that is many vectors
    std::uint8_t part = 0;     ///< of an item that is a value and a parenthesised one: 1 done
    ast::Items const* tail = nullptr;  ///< goes on inside the block that is the last item
    void const* loop = nullptr;        ///< the ast::While or ast::Switch
    StatementStream* stream = nullptr; ///< `items` are a piece of it
    Symbol counter = 0;                ///< of a For
    double last = 0, step = 1;
    std::size_t clause = 0;
    bool tainted = false; ///< of a Block: holds a value that was wrong and is a stand-in
    Span span;            ///< the block, the call, the #include
    std::string_view name;
    bool wall() const { return kind == Kind::Region || kind == Kind::Block; }
  };
  /// What comes next, once directives are out of the way.
  struct Peek {
    bool ready = false;
    Next next = Next::End;
    char symbol = 0;
    bool undeclared = false; ///< a Word that is a name of the user's without a value
    Span span;
    std::string_view word;
    ast::Expr const* expr = nullptr; ///< to be evaluated, unless `value` is set
    ast::Block const* block = nullptr;
    ast::Bracket const* bracket = nullptr;
    ast::Call const* split = nullptr; ///< first or second part of such a call
    Value const* value = nullptr;
    Value owned;
  };
  friend struct ItemVisitor;

  bool take_punctuation(char symbol) override;

  // reader_frames.cpp, reader_values.cpp, reader_words.cpp
  void settle();
  bool end_of_frame();
  void pop();
  void push(Frame&& frame);
  void consume();
  /// Past the item, or the one of many vectors, that is next.
  static void advance(Frame&);
  /// Takes a vector of that size that stands there as such, without looking further.
  bool take_literal(Numeric& n, int size);
  void set(Next, Span);
  void open_block(ast::Items const&, Span, std::string_view head);
  Numeric evaluate_peeked();
  Numeric vector(std::string_view name, int size);
  void missing(std::string_view name, std::string_view kind);
  std::string describe_next();
  void ask(std::string_view word) {
    if (asked_.empty() || asked_.back() != word) asked_.push_back(word);
  }

  // classify.cpp: what an expression is as an item
  void classify(ast::Expr const&);
  void classify_name(ast::Name const&, Span);
  void classify_element(ast::Index const&);
  void classify_value(Value const&, Span);
  void classify_call(ast::Call const&, Span);
  void classify_owned(Value&&, Span);
  ast::Call const* split_call(ast::Expr const&);

  // directives.cpp
  void execute(ast::If const&);
  void execute(ast::While const&);
  void execute(ast::For const&);
  void execute(ast::Switch const&);
  void execute(ast::Declare const&);
  void execute(ast::Macro const&);
  void execute(ast::Directive const&);
  bool next_round(Frame const&);
  bool enter_clause(ast::Switch const&, std::size_t from, bool falling);
  void break_out(Span);

  // assign.cpp
  void assign(ast::Declare const&, Value&&);
  Scope::Cell argument(ast::Items const&, Span);
  void push_macro(ast::Call const&, MacroValue const&);
  Value finish_colour(Numeric first);

  // statements.cpp: directives that are a word and its arguments
  void include(ast::Directive const&);
  void push_include(SourceFile const&, ast::Directive const&);
  void message(ast::Directive const&);
  void set_version(ast::Directive const&);
  void set_default(ast::Directive const&);
  void undefine(ast::Directive const&);
  void open_file(ast::Directive const&);
  void close_file(ast::Directive const&);
  void read_file(ast::Directive const&);
  void write_file(ast::Directive const&);
  std::shared_ptr<FileValue> file_handle(ast::Directive const&, Symbol& symbol);

  /// A block that an #if left open: it has no wall but ends at a Punctuation '}'.
  struct OpenBlock {
    std::size_t frame; ///< where its frames begin; the innermost block while no wall lies above
    Span span;
    std::string_view head;
  };
  bool in_open_block() const;
  Frame const& innermost_block() const;
  /// The frame of the block being read; null outside of all.
  Frame* this_block();
  void taint();
  bool tainted();

  Interpreter& in_;
  std::vector<Frame> frames_;
  std::vector<OpenBlock> open_blocks_;
  Peek peek_;
  ast::Expr element_; ///< the one of many vectors that is next, as an expression
  std::vector<std::string_view> asked_;
  Span missing_at_;
  bool comma_ = false; ///< behind a macro call that ended since this was last cleared
  int macros_ = 0;
  int includes_ = 0;
  /// Number of a face texture; `declared` tells apart those that were declared, null otherwise.
  int add_face_texture(void const* declared, scene::Layers layers);

  std::vector<scene::Layers> face_textures_;
  std::map<void const*, int> face_texture_index_;
};

} // namespace abbe::lang
