// SPDX-License-Identifier: MIT
#include "grammar/structure.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace abbe::grammar {
namespace {

/// What is open at some place of the text.
struct Frame {
  enum class Kind { Brace, Paren, Write, Tail, LooseTail, If, Body };
  Kind kind = Kind::Brace;
  Iterator at = nullptr; ///< the bracket or '#'
  // Of an If:
  int closed = 0; ///< brackets that the branch being read closes but did not open
  bool has_else = false;
  std::vector<int> balances{}; ///< opened minus closed of the branches before
  std::vector<Frame> opened{}; ///< what all branches left open; of a Tail: the blocks it continues
};
using Kind = Frame::Kind;
constexpr std::size_t max_open = 4000;

class Scanner {
public:
  Structure operator()(Iterator first, Iterator last) {
    bool write = false;
    for (Token token = next_token(first, last); token.kind != TokenKind::End;
         token = next_token(token.end, last)) {
      if (stack_.size() > max_open) break; // the parser stops sooner, and frames nest in each other
      if (token.kind == TokenKind::Directive) {
        std::string_view const word = directive_at(token.begin, last);
        directive(word, token.begin);
        write = word == "write";
      } else {
        if (token.kind == TokenKind::Punctuation && token.end - token.begin == 1)
          punctuation(*token.begin, token.begin, write);
        write = false;
      }
    }
    // Opened but closed nowhere: a forgotten '}', which the parser shall report at its place.
    if (!found_.close.empty()) found_.open.insert(loose_.begin(), loose_.end());
    return std::move(found_);
  }

private:
  bool top_is(Kind kind) const { return !stack_.empty() && stack_.back().kind == kind; }

  void punctuation(char mark, Iterator at, bool write) {
    if (mark == '{') stack_.push_back({Kind::Brace, at});
    if (mark == '(') stack_.push_back({write ? Kind::Write : Kind::Paren, at});
    if (mark == ')') {
      if (top_is(Kind::Paren) || top_is(Kind::Write))
        stack_.pop_back();
      else if (top_is(Kind::If))
        found_.close.insert(at);
    }
    if (mark != '}' || stack_.empty()) return;
    if (top_is(Kind::If)) {
      found_.close.insert(at);
      ++stack_.back().closed;
    } else if (top_is(Kind::Brace)) {
      stack_.pop_back();
    } else if (top_is(Kind::LooseTail)) {
      found_.close.insert(at);
      stack_.pop_back();
    } else if (top_is(Kind::Tail)) {
      found_.tails.insert(stack_.back().at);
      for (Frame const& block : stack_.back().opened) found_.open.insert(block.at);
      stack_.pop_back();
    }
  }

  void directive(std::string_view word, Iterator at) {
    if (word == "if" || word == "ifdef" || word == "ifndef")
      stack_.push_back({Kind::If, at});
    else if (word == "while" || word == "for" || word == "switch" || word == "macro")
      stack_.push_back({Kind::Body, at});
    else if (word == "else" || word == "elseif")
      end_branch(word == "else");
    else if (word == "end")
      end_body();
  }

  /// Takes what is open above the innermost directive off the stack.
  std::vector<Frame> take_open() {
    std::vector<Frame> taken;
    while (!stack_.empty() && !top_is(Kind::If) && !top_is(Kind::Body)) {
      taken.push_back(std::move(stack_.back()));
      stack_.pop_back();
    }
    return taken;
  }

  void end_branch(bool is_else) {
    std::vector<Frame> taken = take_open();
    if (!top_is(Kind::If)) return;
    Frame& frame = stack_.back();
    int opened = 0;
    for (Frame& block : taken) {
      if (block.kind == Kind::Paren) continue;
      if (block.kind != Kind::Write) ++opened;
      frame.opened.push_back(std::move(block));
    }
    frame.balances.push_back(opened - std::exchange(frame.closed, 0));
    frame.has_else |= is_else;
  }

  void end_body() {
    end_branch(false);
    take_open();
    if (stack_.empty()) return;
    Frame frame = std::move(stack_.back());
    stack_.pop_back();
    if (frame.kind != Kind::If) return;
    if (!frame.has_else) frame.balances.push_back(0);
    auto const [low, high] = std::minmax_element(frame.balances.begin(), frame.balances.end());
    bool const plain = std::all_of(frame.opened.begin(), frame.opened.end(),
                                   [](Frame const& f) { return f.kind == Kind::Brace; });
    if (*low == 1 && *high == 1 && plain && frame.opened.size() == frame.balances.size()) {
      stack_.push_back({Kind::Tail, frame.at});
      stack_.back().opened = std::move(frame.opened);
      return;
    }
    for (Frame const& block : frame.opened) make_loose(block);
    if (*low != *high) return; // then other branches close what these open
    for (int i = 0; i < *low; ++i) stack_.push_back({Kind::LooseTail, frame.at});
    for (int i = 0; i > *low && !stack_.empty() && !top_is(Kind::Body); --i) {
      if (top_is(Kind::If)) {
        stack_.back().closed += i - *low;
        return;
      }
      make_loose(stack_.back());
      stack_.pop_back();
    }
  }

  void make_loose(Frame const& block) {
    if (block.kind == Kind::Brace || block.kind == Kind::Write) loose_.insert(block.at);
    for (Frame const& inner : block.opened) make_loose(inner);
  }

  std::vector<Frame> stack_;
  std::unordered_set<Iterator> loose_;
  Structure found_;
};

} // namespace

Structure scan_structure(Iterator first, Iterator last) {
  return Scanner()(first, last);
}

} // namespace abbe::grammar
