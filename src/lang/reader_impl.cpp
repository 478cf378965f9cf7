// SPDX-License-Identifier: MIT
#include "lang/interpreter.hpp"

#include <cmath>
#include <fmt/format.h>

namespace abbe::lang {
namespace {

/// The single node of a mesh file's items: taken without looking further.
template <class T>
T const* plain(ast::Item const& item) {
  auto const* expr = boost::relaxed_get<ast::Expr>(&item.get());
  return expr ? boost::relaxed_get<T>(&expr->get()) : nullptr;
}

constexpr std::string_view size_names[] = {"",         "a float",    "a 2-vector",
                                           "a vector", "a 4-vector", "a colour"};

Span end_of(Span span) {
  if (span.end > span.begin) span.begin = span.end - 1;
  return span;
}

} // namespace

// ------------------------------------------------------------------------------------- frames

/// What to do with an item: carry it out (and look again), or present it (done).
struct ItemVisitor {
  ReaderImpl& reader;
  bool done = false;

  void operator()(ast::Expr const& expr) {
    reader.classify(expr);
    done = reader.peek_.ready;
  }
  void operator()(ast::Word const& word) {
    reader.set(Next::Word, word.span);
    reader.peek_.word = word.text;
    done = true;
  }
  void operator()(ast::Bracket const& bracket) {
    reader.set(Next::Bracket, bracket.span);
    reader.peek_.bracket = &bracket;
    done = true;
  }
  void operator()(ast::Punctuation const& mark) {
    bool const closes = mark.symbol == '}' && reader.in_open_block();
    reader.set(closes ? Next::End : Next::Punctuation, mark.span);
    reader.peek_.symbol = mark.symbol;
    done = true;
  }
  template <class Directive>
  void operator()(Directive const& directive) {
    ++reader.frames_.back().position;
    reader.execute(directive);
  }
};

void ReaderImpl::settle() {
  ItemVisitor visitor{*this};
  while (!visitor.done) {
    Frame const& frame = frames_.back();
    if (frame.position < frame.items->size())
      ast::visit(visitor, (*frame.items)[frame.position]);
    else
      visitor.done = end_of_frame();
  }
}

/// @return true when the end of the frame is what comes next (a wall)
bool ReaderImpl::end_of_frame() {
  Frame const& frame = frames_.back();
  if (frame.wall()) {
    set(Next::End, end_of(frame.span));
    return true;
  }
  bool const loops = frame.kind == Frame::Kind::While || frame.kind == Frame::Kind::For
                     || frame.kind == Frame::Kind::Switch;
  if (!loops || !next_round(frame)) pop();
  return false;
}

void ReaderImpl::push(Frame&& frame) {
  frames_.push_back(std::move(frame));
  peek_.ready = false;
}

void ReaderImpl::pop() {
  auto const kind = frames_.back().kind;
  if (kind == Frame::Kind::Macro) {
    in_.scope.leave();
    --macros_;
  } else if (kind == Frame::Kind::Include) {
    in_.scope.leave();
    --includes_;
  }
  frames_.pop_back();
  peek_.ready = false;
}

void ReaderImpl::set(Next next, Span span) {
  peek_.ready = true;
  peek_.next = next;
  peek_.span = span;
  peek_.undeclared = false;
  peek_.value = nullptr;
  peek_.split = nullptr;
}

void ReaderImpl::consume() {
  if (!peek_.ready) settle();
  if (peek_.next == Next::End) return;
  Frame& frame = frames_.back();
  if (peek_.split) {
    if (++frame.part > peek_.split->arguments.size()) {
      frame.part = 0;
      ++frame.position;
    }
  } else {
    ++frame.position;
  }
  peek_.ready = false;
  asked_.clear();
}

void ReaderImpl::enter_region(ast::Items const& items, Span span) {
  in_.check_limits(span);
  Frame frame;
  frame.items = &items;
  frame.kind = Frame::Kind::Region;
  frame.span = span;
  push(std::move(frame));
}

void ReaderImpl::leave_region() {
  if (next() != Next::End) unexpected("one value");
  while (!frames_.back().wall()) pop();
  pop();
}

void ReaderImpl::open_block(ast::Items const& items, Span span, std::string_view head) {
  in_.check_limits(span);
  Frame frame;
  frame.items = &items;
  frame.kind = Frame::Kind::Block;
  frame.span = span;
  frame.name = head;
  asked_.clear();
  push(std::move(frame));
}

bool ReaderImpl::open_any() {
  if (next() != Next::Block) return false;
  ast::Block const& block = *peek_.block;
  Frame const& frame = frames_.back();
  ast::Items const* tail = frame.position + 1 == frame.items->size() ? frame.tail : nullptr;
  if (tail) frames_.back().tail = nullptr;
  consume();
  if (!tail && block.open) {
    open_blocks_.push_back({frames_.size(), block.span, block.head.text});
    Frame content;
    content.items = &block.items;
    push(std::move(content));
    return true;
  }
  if (!tail) {
    open_block(block.items, block.span, block.head.text);
    return true;
  }
  // The block goes on with what follows #end: that lies beneath, so it is read afterwards.
  open_block(*tail, block.span, block.head.text);
  Frame head;
  head.items = &block.items;
  push(std::move(head));
  return true;
}

bool ReaderImpl::open(std::string_view word) {
  if (next() == Next::Block && peek_.block->head.text == word) return open_any();
  ask(word);
  return false;
}

ast::Items const* ReaderImpl::take_row() {
  if (next() != Next::Block || !peek_.block->head.text.empty()) return nullptr;
  ast::Items const* const items = &peek_.block->items;
  consume();
  return items;
}

ast::Expr const* ReaderImpl::take_expression() {
  Next const kind = next();
  bool const none = kind == Next::End || kind == Next::Bracket || kind == Next::Punctuation
                    || (kind == Next::Word && !peek_.undeclared);
  if (none) return nullptr;
  ++frames_.back().position;
  peek_.ready = false;
  return peek_.expr;
}

bool ReaderImpl::open_bracket() {
  if (next() != Next::Bracket) return false;
  ast::Bracket const& bracket = *peek_.bracket;
  consume();
  open_block(bracket.items, bracket.span, "[ ]");
  return true;
}

void ReaderImpl::close() {
  if (next() != Next::End) {
    unexpected("the end of this block");
    while (next() != Next::End) skip();
  }
  asked_.clear();
  if (in_open_block()) {
    // At its '}', unless the surrounding block ended first: the grammar has reported that.
    Frame& frame = frames_.back();
    if (frame.position < frame.items->size()) ++frame.position;
    peek_.ready = false;
    open_blocks_.pop_back();
    return;
  }
  while (!frames_.back().wall()) pop();
  pop();
}

bool ReaderImpl::in_open_block() const {
  if (open_blocks_.empty()) return false;
  for (std::size_t i = frames_.size(); i-- > open_blocks_.back().frame;)
    if (frames_[i].wall()) return false;
  return true;
}

Span ReaderImpl::block_span() {
  if (in_open_block()) return open_blocks_.back().span;
  for (auto frame = frames_.rbegin(); frame != frames_.rend(); ++frame)
    if (frame->kind == Frame::Kind::Block) return frame->span;
  return {};
}

Span ReaderImpl::next_span() {
  next();
  return peek_.span;
}

SourceFile const* ReaderImpl::current_source() const {
  for (auto frame = frames_.rbegin(); frame != frames_.rend(); ++frame)
    if (!frame->items->empty()) return ast::span_of(frame->items->front()).source;
  return nullptr;
}

std::vector<Diagnostic::Note> ReaderImpl::chain() const {
  std::vector<Diagnostic::Note> notes;
  std::size_t count = 0;
  for (auto frame = frames_.rbegin(); frame != frames_.rend(); ++frame) {
    bool const call = frame->kind == Frame::Kind::Macro;
    if (!call && frame->kind != Frame::Kind::Include) continue;
    if (++count > 5) continue;
    notes.push_back({frame->span, call ? fmt::format("called from here: '{}'", frame->name)
                                       : "included from here"});
  }
  if (count > 5) notes.push_back({{}, fmt::format("... and {} more", count - 5)});
  return notes;
}

// ------------------------------------------------------------------------------------- values

std::string ReaderImpl::describe_next() {
  switch (next()) {
  case Next::End:
    return "the end";
  case Next::Word:
    return fmt::format("'{}'", peek_.word);
  case Next::Numeric:
    return "a number";
  case Next::String:
    return "a string";
  case Next::Identifier:
    return std::string(type_name(*peek_.value));
  case Next::Block:
    return peek_.block->head.text.empty() ? "'{'" : fmt::format("'{} {{'", peek_.block->head.text);
  case Next::Bracket:
    return "'['";
  case Next::Punctuation:
    return fmt::format("'{}'", peek_.symbol);
  }
  return {};
}

/// Reports that a value is not there: once at a place, whatever else is missed there.
void ReaderImpl::missing(std::string_view name, std::string_view kind) {
  Span const span = next_span();
  if (peek_.next == Next::Word && peek_.undeclared) {
    in_.error("E0201",
              fmt::format("undeclared identifier '{}'{}", peek_.word, in_.suggestion(peek_.word)),
              span);
    consume();
    return;
  }
  if (missing_at_.source == span.source && missing_at_.begin == span.begin
      && missing_at_.end == span.end)
    return;
  missing_at_ = span;
  in_.error("E0301", fmt::format("expected {} ({}), found {}", name, kind, describe_next()), span);
  bool const wrong_type =
      peek_.next == Next::String || peek_.next == Next::Identifier || peek_.next == Next::Numeric;
  if (wrong_type) consume();
}

Numeric ReaderImpl::evaluate_peeked() {
  if (peek_.value) return in_.expressions.to_numeric(*peek_.value, peek_.span);
  if (peek_.split) {
    // Never seen by the first part: that is a name or carries a value.
    ast::Call const* const split = peek_.split;
    auto const part = frames_.back().part;
    if (part > 0) {
      ast::Paren paren;
      paren.span = split->span;
      paren.items = split->arguments[part - 1u];
      return in_.expressions(paren);
    }
  }
  return in_.expressions.numeric(*peek_.expr);
}

Numeric ReaderImpl::numeric(std::string_view name, int minimum) {
  if (next() != Next::Numeric) {
    missing(name, minimum == 1 ? "a number" : size_names[minimum]);
    return Numeric{}.promoted(minimum);
  }
  Span const span = peek_.span;
  Numeric n = evaluate_peeked();
  consume();
  if (n.poisoned()) return Numeric{}.promoted(minimum);
  for (int i = 0; i < n.size; ++i) {
    if (std::isfinite(n.c[static_cast<std::size_t>(i)])) continue;
    in_.error("E0303",
              fmt::format("{} is not a finite number ({})", name, n.c[static_cast<std::size_t>(i)]),
              span);
    return Numeric{}.promoted(minimum);
  }
  return n.promoted(minimum);
}

Numeric ReaderImpl::vector(std::string_view name, int size) {
  Frame& frame = frames_.back();
  if (!peek_.ready && frame.position < frame.items->size()) {
    auto const* literal = plain<ast::LiteralVector>((*frame.items)[frame.position]);
    if (literal && literal->size == size) {
      Numeric n;
      n.size = literal->size;
      std::copy(literal->values, literal->values + 5, n.c.begin());
      ++frame.position;
      asked_.clear();
      return n;
    }
  }
  if (next() != Next::Numeric) {
    missing(name, size_names[size]);
    return Numeric{}.promoted(size);
  }
  Span const span = peek_.span;
  Numeric n = numeric(name, size);
  if (n.size <= size) return n;
  in_.error("E0302",
            fmt::format("{} must be {}, not {}", name, size_names[size], size_names[n.size]), span);
  n.size = static_cast<std::uint8_t>(size);
  return n;
}

double ReaderImpl::number(std::string_view name) {
  Frame& frame = frames_.back();
  if (!peek_.ready && frame.position < frame.items->size()) {
    if (auto const* literal = plain<ast::Number>((*frame.items)[frame.position])) {
      ++frame.position;
      asked_.clear();
      return literal->value;
    }
  }
  return vector(name, 1).scalar();
}

int ReaderImpl::integer(std::string_view name, int low, int high) {
  Span const span = next_span();
  double const value = std::trunc(number(name));
  if (value >= low && value <= high) return static_cast<int>(value);
  in_.error("E0304", fmt::format("{} must lie in {} .. {}, not {}", name, low, high, value), span);
  return value < low ? low : high;
}

Vec2 ReaderImpl::vec2(std::string_view name) {
  Numeric const n = vector(name, 2);
  return {n.c[0], n.c[1]};
}

Vec3 ReaderImpl::vec3(std::string_view name) {
  return vector(name, 3).vec3();
}

Vec4 ReaderImpl::vec4(std::string_view name) {
  Numeric const n = vector(name, 4);
  return {n.c[0], n.c[1], n.c[2], n.c[3]};
}

std::vector<double> ReaderImpl::components(std::string_view name, int count) {
  std::vector<double> values;
  auto const wanted = static_cast<std::size_t>(count);
  if (next() != Next::Numeric) {
    missing(name, fmt::format("a vector of {} components", count));
    return std::vector<double>(wanted);
  }
  Span const span = peek_.span;
  auto const* vector_node = peek_.expr ? ast::get_if<ast::Vector>(*peek_.expr) : nullptr;
  if (!vector_node) {
    Numeric const n = numeric(name, 1);
    values.assign(n.c.begin(), n.c.begin() + n.size);
  } else {
    consume();
    enter_region(vector_node->components, span);
    while (!at_end()) {
      std::size_t const errors = static_cast<std::size_t>(in_.error_count());
      values.push_back(number("a component"));
      if (static_cast<std::size_t>(in_.error_count()) > errors && !at_end()) skip();
    }
    leave_region();
  }
  if (values.size() != wanted)
    in_.error("E0302",
              fmt::format("{} must have {} components, not {}", name, count, values.size()), span);
  values.resize(wanted);
  return values;
}

std::string ReaderImpl::string(std::string_view name) {
  if (next() != Next::String) {
    missing(name, "a string");
    return {};
  }
  std::string text;
  if (peek_.value)
    text = std::get<std::string>(peek_.value->any);
  else
    text = in_.expressions.string(*peek_.expr, name);
  consume();
  return text;
}

std::string ReaderImpl::path(std::string_view name) {
  if (next() == Next::String && !peek_.value) {
    if (auto const* literal = ast::get_if<ast::String>(*peek_.expr)) {
      consume();
      return literal->raw;
    }
  }
  return string(name);
}

bool ReaderImpl::boolean_or(bool absent) {
  if (next() != Next::Numeric) return absent;
  return std::abs(number("a boolean")) > 1e-10;
}

Value const* ReaderImpl::identifier() {
  return next() == Next::Identifier ? peek_.value : nullptr;
}

// -------------------------------------------------------------------------------------- words

std::string_view ReaderImpl::next_word() {
  switch (next()) {
  case Next::Word:
    return peek_.word;
  case Next::Block:
    return peek_.block->head.text;
  default:
    return {};
  }
}

bool ReaderImpl::accept(std::string_view word) {
  next();
  std::string_view found;
  if (peek_.next == Next::Word) {
    found = peek_.word;
  } else if ((peek_.next == Next::Numeric || peek_.next == Next::Identifier
              || peek_.next == Next::String)
             && peek_.expr && !peek_.split) {
    // A word of abbe's is no reserved one: the user may have declared it. Who asks for it, gets it.
    if (auto const* name = ast::get_if<ast::Name>(*peek_.expr)) found = name->text;
  }
  if (found == word) {
    consume();
    return true;
  }
  ask(word);
  return false;
}

std::optional<bool> ReaderImpl::flag(std::string_view word) {
  if (!accept(word)) return std::nullopt;
  return boolean_or(true);
}

bool ReaderImpl::take_punctuation(char symbol) {
  if (next() != Next::Punctuation || peek_.symbol != symbol) return false;
  consume();
  return true;
}

int ReaderImpl::face_texture() {
  if (next() != Next::Block || peek_.block->head.text != "texture") {
    ask("texture");
    return -1;
  }
  open_any();
  Value const* const value = identifier();
  auto const* held =
      value ? std::get_if<std::shared_ptr<scene::Layers const>>(&value->any) : nullptr;
  void const* const key = held ? held->get() : nullptr;
  scene::Layers layers;
  read_texture(*this, layers);
  // Only a block that is the bare name stands for the declared texture itself.
  Frame const& frame = frames_.back();
  bool const bare = key && frame.kind == Frame::Kind::Block && frame.items->size() == 1;
  close();
  if (bare) {
    auto const found = face_texture_index_.find(key);
    if (found != face_texture_index_.end()) return found->second;
    face_texture_index_[key] = static_cast<int>(face_textures_.size());
  }
  face_textures_.push_back(std::move(layers));
  return static_cast<int>(face_textures_.size()) - 1;
}

std::vector<scene::Layers> ReaderImpl::take_face_textures() {
  face_texture_index_.clear();
  return std::exchange(face_textures_, {});
}

// ------------------------------------------------------------------------------------- errors

void ReaderImpl::report(Severity severity, std::string_view code, std::string_view message,
                        Span span) {
  in_.report(severity, code, std::string(message), span.valid() ? span : block_span());
}

void ReaderImpl::unexpected(std::string_view where) {
  Span const span = next_span();
  std::string const asked = [&] {
    if (peek_.next != Next::Word && peek_.next != Next::Block) return std::string();
    std::string_view const word = next_word();
    return did_you_mean(word, asked_);
  }();
  if (peek_.next == Next::Word && peek_.undeclared)
    in_.error("E0202",
              fmt::format("unknown name '{}' where {} was expected{}", peek_.word, where,
                          asked.empty() ? in_.suggestion(peek_.word) : asked),
              span);
  else if (peek_.next == Next::Block && !peek_.block->head.text.empty()
           && !find_block_kind(peek_.block->head.text))
    in_.error("E0202",
              fmt::format("unknown block '{}' where {} was expected{}", peek_.block->head.text,
                          where, asked.empty() ? in_.suggestion(peek_.block->head.text) : asked),
              peek_.block->head.span.valid() ? peek_.block->head.span : span);
  else
    in_.error("E0203", fmt::format("expected {}, found {}{}", where, describe_next(), asked), span);
  skip();
}

void ReaderImpl::skip() {
  bool const word = next() == Next::Word;
  consume();
  if (!word) return;
  for (;;) {
    Next const n = next();
    bool const belongs = n == Next::Numeric || n == Next::String || n == Next::Bracket
                         || (n == Next::Block && peek_.block->head.text.empty());
    if (!belongs) return;
    consume();
  }
}

} // namespace abbe::lang
