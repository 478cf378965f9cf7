// SPDX-License-Identifier: MIT
// Texts that are not whole: bodies read an item at a time, blocks whose '{' and '}' stand in
// different texts, heads of blocks that an #if chooses.
#include "lang/interpreter.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace abbe::lang {

/// Parsed once, however often the text is executed.
LooseItem const& ReaderImpl::loose_item(Span text) {
  bool const full = innermost_block().full;
  auto const [found, fresh] = loose_items_.try_emplace({text.source, text.begin, full});
  if (fresh) found->second = parse_loose(text, text.begin, full);
  return found->second;
}

/// @return false at the end of the text
bool ReaderImpl::next_of_text(Frame& frame) {
  LooseItem const& item = loose_item(frame.text);
  if (item.error) {
    Diagnostic const& error = *item.error;
    in_.report(error.severity, error.code, error.message, error.span, error.notes);
    in_.abort();
  }
  frame.text.begin = item.end;
  if (item.items.empty()) return false;
  frame.items = &item.items;
  frame.position = 0;
  return true;
}

ast::Item const* ReaderImpl::upcoming() {
  for (auto frame = frames_.rbegin(); frame != frames_.rend(); ++frame) {
    if (frame->position == frame->items->size() && frame->stream != nullptr
        && in_.streams.next(*frame->stream))
      frame->position = 0;
    if (frame->position < frame->items->size()) return &(*frame->items)[frame->position];
    if (frame->text.begin < frame->text.end) {
      LooseItem const& item = loose_item(frame->text);
      if (item.error) return nullptr;
      if (!item.items.empty()) return &item.items.front();
    }
    using Kind = Frame::Kind;
    bool const passes = frame->kind == Kind::Splice || frame->kind == Kind::Macro;
    if (!passes || frame->tail != nullptr) return nullptr;
  }
  return nullptr;
}

/// `#if (c) texture #else material #end { ... }`: the word that ends what an #if or a macro yields
/// is the head of the bare block behind it.
void ReaderImpl::look_for_block() {
  Frame const& frame = frames_.back();
  bool const last = frame.kind != Frame::Kind::Region && frame.kind != Frame::Kind::Block
                    && !frame.alone && frame.position + 1 == frame.items->size();
  if (!last || peek_.split != nullptr) return;
  ast::Item const& item = (*frame.items)[frame.position];
  Span const span = peek_.span;
  std::string_view const word = peek_.word;
  advance(frames_.back());
  settle_item();
  if (peek_.next == Next::End && frames_.back().falls) {
    fall();
    settle_item();
  }
  if (peek_.next == Next::Block && peek_.word.empty()) {
    peek_.word = word;
    peek_.span = span;
    return;
  }
  Frame alone;
  ast::Items& items = lone_words_[&item];
  items.assign(1, item);
  alone.items = &items;
  alone.alone = true;
  push(std::move(alone));
  settle_item();
}

/// A '}' comes next that no '{' of the same text belongs to: the innermost block ends.
void ReaderImpl::meet_brace(Span span) {
  Frame const& wall = innermost_block();
  bool const block = wall.kind == Frame::Kind::Block && wall.name != "[ ]";
  bool const closes = in_open_block() || block;
  set(closes ? Next::End : Next::Punctuation, span);
  peek_.symbol = '}';
  peek_.brace = closes;
}

void ReaderImpl::close_at_brace() {
  bool const open = in_open_block();
  Frame& frame = frames_.back();
  if (frame.position < frame.items->size()) {
    ++frame.position;
    peek_.ready = false;
  } else {
    pop();
  }
  if (open) {
    open_blocks_.pop_back();
    return;
  }
  // The '}' of the block itself is yet to come, and closes what lies around.
  std::size_t i = frames_.size() - 1;
  while (!frames_[i].wall()) --i;
  frames_[i].kind = Frame::Kind::Brace;
}

/// Where a list ends before the '}' of a block that was opened in it.
void ReaderImpl::close_at_wall() {
  OpenBlock const closed = open_blocks_.back();
  open_blocks_.pop_back();
  Frame const& wall = frames_.back();
  if (wall.kind == Frame::Kind::Block && wall.name != "[ ]") {
    // The '}' of the list closes the block that was opened last; the list itself goes on.
    OpenBlock around{0, wall.span, wall.name, wall.tainted};
    pop();
    around.frame = frames_.size();
    open_blocks_.push_back(around);
    return;
  }
  if (!closed.tainted)
    in_.report(Severity::Error, "E0111",
               fmt::format("expected '}}' to close the '{}', found the end", closed.head),
               wall.span.valid() ? Span{wall.span.source, wall.span.end, wall.span.end} : wall.span,
               {{closed.span, "the block is opened here"}});
  in_.abort();
}

/// The wall of the innermost region falls: what comes next is what it has left, then what stands
/// behind it.
void ReaderImpl::fall() {
  std::size_t i = frames_.size() - 1;
  while (!frames_[i].wall()) --i;
  if (frames_[i].position < frames_[i].items->size()) {
    frames_[i].kind = Frame::Kind::Splice;
  } else {
    frames_.erase(frames_.begin() + static_cast<std::ptrdiff_t>(i));
    for (OpenBlock& open : open_blocks_)
      if (open.frame > i) --open.frame;
  }
  std::find_if(entered_.rbegin(), entered_.rend(), [](Entered const& e) {
    return !e.fallen;
  })->fallen = true;
  peek_.ready = false;
}

} // namespace abbe::lang
