// SPDX-License-Identifier: MIT
// The reader's stack: what comes next, blocks opened and closed, the chain of calls.
#include "lang/interpreter.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace abbe::lang {
namespace {

Span end_of(Span span) {
  if (span.end > span.begin) span.begin = span.end - 1;
  return span;
}

} // namespace

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
  void operator()(ast::LiteralVectors const& vectors) {
    reader.element_ = vectors[reader.frames_.back().element];
    reader.classify(reader.element_);
    done = true;
  }
  void operator()(ast::Bracket const& bracket) {
    reader.set(Next::Bracket, bracket.span);
    reader.peek_.bracket = &bracket;
    done = true;
  }
  void operator()(ast::Punctuation const& mark) {
    if (mark.symbol == '}')
      reader.meet_brace(mark.span);
    else
      reader.set(Next::Punctuation, mark.span);
    reader.peek_.symbol = mark.symbol;
    done = true;
  }
  void operator()(ast::Text const& text) {
    ++reader.frames_.back().position;
    static ast::Items const nothing;
    ReaderImpl::Frame frame;
    frame.items = &nothing;
    frame.text = text.span;
    reader.push(std::move(frame));
  }
  template <class Directive>
  void operator()(Directive const& directive) {
    ++reader.frames_.back().position;
    reader.execute(directive);
    done = reader.peek_.ready;
  }
};

void ReaderImpl::settle_item() {
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
  Frame& frame = frames_.back();
  if (frame.stream != nullptr && in_.streams.next(*frame.stream)) {
    frame.position = 0;
    return false;
  }
  if (frame.text.begin < frame.text.end && next_of_text(frame)) return false;
  if (frame.tail != nullptr) { // of a block that was not opened as the last item of its branch
    frame.items = std::exchange(frame.tail, nullptr);
    frame.position = 0;
    frame.kind = Frame::Kind::Brace;
    return false;
  }
  if (frame.kind == Frame::Kind::Brace) {
    meet_brace(end_of(frame.span));
    return true;
  }
  if (frame.wall()) {
    if (frame.falls && in_open_block()) {
      fall();
      return false;
    }
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
    comma_ = comma_ || comma_behind(frames_.back().span);
  } else if (kind == Frame::Kind::Include) {
    in_.scope.leave();
    --includes_;
    if (frames_.back().stream != nullptr) in_.streams.close();
  }
  frames_.pop_back();
  // What is pushed from now on lies above the blocks that were left open here.
  for (OpenBlock& open : open_blocks_) open.frame = std::min(open.frame, frames_.size());
  peek_.ready = false;
}

void ReaderImpl::set(Next next, Span span) {
  peek_.ready = true;
  peek_.next = next;
  peek_.span = span;
  peek_.undeclared = false;
  peek_.brace = false;
  peek_.value = nullptr;
  peek_.split = nullptr;
  peek_.rest = nullptr;
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
  } else if (peek_.rest) {
    frame.part ^= 1;
    frame.position += frame.part == 0;
  } else if (frame.position < frame.items->size()) {
    advance(frame);
  } else { // a '}' that nothing is open for
    pop();
  }
  peek_.ready = false;
  asked_.clear();
}

void ReaderImpl::advance(Frame& frame) {
  auto const* const many = ast::get_if<ast::LiteralVectors>((*frame.items)[frame.position]);
  if (many != nullptr && ++frame.element < many->count()) return;
  frame.element = 0;
  ++frame.position;
}

void ReaderImpl::enter_region(ast::Items const& items, Span span, bool falls) {
  in_.check_limits(span);
  Frame frame;
  frame.items = &items;
  frame.kind = Frame::Kind::Region;
  frame.span = span;
  frame.falls = falls;
  push(std::move(frame));
  frames_.back().full = in_parentheses_;
  entered_.push_back({false, std::exchange(in_parentheses_, false), comma_});
}

bool ReaderImpl::leave_region() {
  if (!entered_.back().fallen) {
    if (next() != Next::End) unexpected("one value");
    while (!frames_.back().wall()) pop();
    pop();
  }
  Entered const left = entered_.back();
  entered_.pop_back();
  in_parentheses_ = left.full;
  comma_ = left.comma;
  return !left.fallen;
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
  std::string_view const head = peek_.word;
  Span const span = peek_.span;
  Frame const& frame = frames_.back();
  ast::Items const* tail = frame.position + 1 == frame.items->size() ? frame.tail : nullptr;
  if (tail) frames_.back().tail = nullptr;
  consume();
  if (!tail && block.open) {
    open_blocks_.push_back({frames_.size(), span, head});
    Frame content;
    content.items = &block.items;
    push(std::move(content));
    return true;
  }
  if (!tail) {
    open_block(block.items, span, head);
    return true;
  }
  // The block goes on with what follows #end: that lies beneath, so it is read afterwards.
  open_block(*tail, span, head);
  Frame begin;
  begin.items = &block.items;
  push(std::move(begin));
  return true;
}

bool ReaderImpl::open(std::string_view word) {
  if (next() == Next::Block && peek_.word == word) return open_any();
  ask(word);
  return false;
}

ast::Items const* ReaderImpl::take_row() {
  if (next() != Next::Block || !peek_.word.empty() || peek_.block->open) return nullptr;
  ast::Items const* const items = &peek_.block->items;
  consume();
  return items;
}

ast::Expr const* ReaderImpl::take_expression() {
  Next const kind = next();
  bool const none = kind == Next::End || kind == Next::Bracket || kind == Next::Punctuation
                    || (kind == Next::Word && !peek_.undeclared);
  if (none) return nullptr;
  advance(frames_.back());
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
    std::string_view const head =
        in_open_block() ? open_blocks_.back().head : innermost_block().name;
    unexpected(head.empty()    ? "'}'"
               : head == "[ ]" ? "']'"
                               : fmt::format("the end of this '{}'", head));
    while (next() != Next::End) skip();
  }
  asked_.clear();
  if (peek_.brace) return close_at_brace();
  if (in_open_block()) return close_at_wall();
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
  Frame const* const block = this_block();
  return block != nullptr ? block->span : Span{};
}

ReaderImpl::Frame* ReaderImpl::this_block() {
  for (auto frame = frames_.rbegin(); frame != frames_.rend(); ++frame)
    if (frame->kind == Frame::Kind::Block) return &*frame;
  return nullptr;
}

bool* ReaderImpl::block_taint() {
  if (in_open_block()) return &open_blocks_.back().tainted;
  Frame* const block = this_block();
  return block != nullptr ? &block->tainted : nullptr;
}

ReaderImpl::Frame const& ReaderImpl::innermost_block() const {
  std::size_t i = frames_.size() - 1;
  while (i > 0 && !frames_[i].wall()) --i;
  return frames_[i];
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

} // namespace abbe::lang
