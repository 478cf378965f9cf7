// SPDX-License-Identifier: MIT
#pragma once

#include "grammar/parse.hpp"
#include "lang/reader.hpp"
#include "lang/scope.hpp"
#include "lang/statement_streams.hpp"

#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <unordered_set>
#include <utility>
#include <vector>

namespace abbe::lang {

class Pasted;

/// The reader over the syntax tree: a stack of frames, each a list of items, a position in it, and
/// what to do at its end (go round a loop, leave a macro's table of names ...). Directives push and
/// pop frames, so that what a macro, a loop or an included file yields is simply what comes next.
///
/// A Region or Block frame is a wall: what reads above it sees End there. To the language there are
/// no trees, only text: a macro may open a block that what follows its call closes, or close one
/// that was opened before it. Then walls fall, so that what is read is what the text says.
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
  std::vector<double> call(std::string_view word, std::size_t count) override;
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
  Next next() override { return peek_.ready ? peek_.next : (settle(), peek_.next); }
  std::string_view next_word() override;
  bool open_bracket() override;
  bool open_any() override;
  Span value_span() override;
  bool comma_follows(Span) override;
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
  /// Reads `items` behind a wall until leave_region(), which reports what is left unread. Where
  /// `falls`, the wall gives way to a block that is not closed at the end of the items.
  void enter_region(ast::Items const& items, Span, bool falls = false);
  /// The innermost list goes on with the next pieces of the stream, if there is one.
  void read_from(StatementStream* stream) { frames_.back().stream = stream; }
  /// Is a block being read that an #if left open?
  bool in_loose_block() const { return !open_blocks_.empty(); }
  /// @return false when the wall has fallen: what comes next stands behind the items
  bool leave_region();
  /// To be told before and after the content of parentheses is evaluated. @return what was before
  bool set_in_parentheses(bool yes) { return std::exchange(in_parentheses_, yes); }
  /// What may stand behind `=` or as a macro's argument; empty (reported) when there is none. Where
  /// no wall ends it, directives behind it are not carried out to see whether it goes on.
  Value read_value(bool walled = true);
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
  /// A macro called as an operand: adds what it yields.
  void paste(ast::Call const&, MacroValue const&, Pasted& into);
  /// "called from", "included from": innermost first, shortened.
  std::vector<Diagnostic::Note> chain() const;
  /// The source that the innermost directive stands in.
  SourceFile const* current_source() const;
  /// Is there a value of that name or array element?
  bool is_defined(ast::Expr const&);

private:
  struct Frame {
    /// At the end of a Brace a '}' stands that closes what is open then.
    enum class Kind : std::uint8_t {
      Region,
      Block,
      Splice,
      Brace,
      While,
      For,
      Switch,
      Macro,
      Include
    };
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
    bool full = false;    ///< of a Region: what is read there stands in parentheses
    bool falls = false;   ///< of a Region, see enter_region()
    bool alone = false;   ///< of a Splice: the word in it is the head of no block
    Span text;            ///< what is left of a Text; `items` hold the latest item of it
    Span span;            ///< the block, the call, the #include
    std::string_view name;
    bool wall() const { return kind == Kind::Region || kind == Kind::Block; }
  };
  /// What comes next, once directives are out of the way.
  struct Peek {
    bool ready = false;
    Next next = Next::End;
    char symbol = 0;
    bool brace = false;      ///< an End that is the '}' of another text
    bool undeclared = false; ///< a Word that is a name of the user's without a value
    Span span;
    std::string_view word;           ///< also the head of a Block
    ast::Expr const* expr = nullptr; ///< to be evaluated, unless `value` is set
    ast::Block const* block = nullptr;
    ast::Bracket const* bracket = nullptr;
    ast::Call const* split = nullptr; ///< first or second part of such a call
    ast::Expr const* rest = nullptr;  ///< first or second part of `Object -y`
    Value const* value = nullptr;
    Value owned;
  };
  friend struct ItemVisitor;

  bool take_punctuation(char symbol) override;

  // reader_text.cpp: texts that are not whole
  void look_for_block();
  bool next_of_text(Frame&);
  LooseItem const& loose_item(Span text);
  void meet_brace(Span);
  void close_at_brace();
  void close_at_wall();
  void fall();
  /// What comes next as it stands, nothing carried out; null where a body, block or region ends.
  ast::Item const* upcoming();

  // reader_frames.cpp, reader_values.cpp, reader_words.cpp
  void settle() {
    settle_item();
    if (peek_.next == Next::Word) look_for_block();
  }
  void settle_item();
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
  bool classify_sum(ast::Expr const&, ast::Binary const&);

  // directives.cpp
  void execute(ast::If const&);
  void execute(ast::While const&);
  void execute(ast::For const&);
  void execute(ast::Switch const&);
  void execute(ast::Declare const&);
  void execute(ast::Macro const&);
  void execute(ast::Directive const&);
  bool is_broken(ast::Expr const& question, std::string_view wants);
  std::optional<bool> is_for(ast::Switch::Clause const&, double value);
  bool next_round(Frame ended);
  void break_out(Span);
  void leave_loop();

  // assign.cpp
  Value opened_value(std::string_view head, Span);
  Value declared_value(ast::Declare const&);
  std::optional<Value> simple_value(ast::Items const&);
  struct Target {
    int depth;        ///< of the tables of names, where the directive stands
    Scope::Cell cell; ///< what a #declare sets there
  };
  Target target_of(ast::Declare const&);
  void assign(ast::Declare const&, Target const&, Value&&);
  Scope::Cell argument(ast::Items const&, Span);
  Scope::Cell shared_cell(ast::Expr const&);
  std::optional<std::size_t> arguments_in_a_row(ast::Call const&, std::vector<Scope::Cell>&);
  void push_macro(ast::Call const&, MacroValue const&);
  void yields_nothing(ast::Call const&);
  Value finish_colour(Numeric first, bool walled, Span at);
  /// Is the next item of that sort one that a value goes on with?
  bool goes_on(bool walled, Next, std::string_view word);

  // statements.cpp: directives that are a word and its arguments
  void include(ast::Directive const&);
  void push_include(SourceFile const&, ast::Directive const&);
  void message(ast::Directive const&);
  void set_version(ast::Directive const&);
  void set_default(ast::Directive const&);
  void undefine(ast::Directive const&);
  void open_file(ast::Directive const&);
  void close_file(ast::Directive const&);
  void close_handle(Symbol);
  void read_file(ast::Directive const&);
  void write_file(ast::Directive const&);
  std::shared_ptr<FileValue> file_handle(ast::Directive const&, Symbol& symbol);

  /// A block that its text leaves open: it has no wall but ends at a '}' of another.
  struct OpenBlock {
    std::size_t frame; ///< where its frames begin; the innermost block while no wall lies above
    Span span;
    std::string_view head;
    bool tainted = false;
  };
  bool in_open_block() const;
  Frame const& innermost_block() const;
  /// The frame of the block being read; null outside of all.
  Frame* this_block();
  /// Where it is kept that the block being read is tainted; null outside of all.
  bool* block_taint();
  void taint();
  bool tainted();

  Interpreter& in_;
  std::vector<Frame> frames_;
  std::vector<OpenBlock> open_blocks_;
  struct Entered {
    bool fallen; ///< has its wall fallen?
    bool full;   ///< in_parentheses_ outside of it
    bool comma;  ///< comma_ outside of it
  };
  std::vector<Entered> entered_; ///< the regions that were entered and not left
  bool in_parentheses_ = false;  ///< is the expression being evaluated the content of some?
  std::map<std::tuple<SourceFile const*, std::uint32_t, bool>, LooseItem> loose_items_;
  std::map<ast::Item const*, ast::Items> lone_words_;
  std::map<ast::Binary const*, ast::Expr> rests_;
  std::unordered_set<Symbol> closed_files_; ///< handles of files that were open once
  int rounds_with_errors_ = 0;              ///< of #while loops
  Peek peek_;
  ast::Expr element_; ///< the one of many vectors that is next, as an expression
  std::vector<std::string_view> asked_;
  Span missing_at_;
  int missing_again_ = 0; ///< how often since
  bool comma_ = false;    ///< behind a macro call that ended since this was last cleared
  int macros_ = 0;
  int includes_ = 0;
  /// Number of a face texture; `declared` tells apart those that were declared, null otherwise.
  int add_face_texture(void const* declared, scene::Layers layers);

  std::vector<scene::Layers> face_textures_;
  std::map<void const*, int> face_texture_index_;
};

} // namespace abbe::lang
